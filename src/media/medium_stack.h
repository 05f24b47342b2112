#pragma once
// Which medium a point is in, where bodies of several lie in each other or overlap.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace candela {

/// A medium of a scene, by its place in the scene's list, and how it ranks where bodies overlap.
struct MediumId {
  static constexpr std::uint16_t kNone = 0xffff;

  std::uint16_t index = kNone;
  /// The higher one fills the place where bodies overlap. The surfaces of one that has any (> 0) are none
  /// inside of a higher one.
  std::int16_t priority = 0;

  explicit operator bool() const { return index != kNone; }
  friend bool operator==(MediumId, MediumId) = default;
};

/// The media on the two sides of a surface. None inside: the surface bounds no body that light enters. None
/// outside: whatever the body lies in.
struct MediumInterface {
  MediumId inside, outside;
};

/// The bodies that a point lies in, in the order in which they were entered, each by its medium. The one with
/// the highest priority fills the point; of equals, the one that was entered last (Schmidt & Budge 2002,
/// "Simple Nested Dielectrics in Ray Traced Images"). An eighth body makes it forget the first.
class MediumStack {
public:
  void enter(MediumId medium) {
    if (!medium) return;
    if (count_ == media_.size()) {
      std::shift_left(media_.begin(), media_.end(), 1);
      --count_;
    }
    media_[count_++] = medium;
  }
  /// Nothing where the point was not inside.
  void leave(MediumId medium) {
    for (std::size_t i = count_; i-- > 0;) {
      if (media_[i] != medium) continue;
      std::shift_left(media_.begin() + static_cast<std::ptrdiff_t>(i), media_.begin() + count_, 1);
      --count_;
      return;
    }
  }
  /// Through a surface, from its outside or from its inside.
  void cross(const MediumInterface& surface, bool from_outside) {
    leave(from_outside ? surface.outside : surface.inside);
    enter(from_outside ? surface.inside : surface.outside);
  }

  /// Whether the point lies inside of a body of higher priority than the one that the surface bounds: the
  /// surface is a false intersection, and nothing but the list of bodies changes there. The point lies on the
  /// surface's outside or on its inside. Of equal ones, which should not overlap, the one that was entered
  /// last is the higher.
  bool hides(const MediumInterface& surface, bool from_outside) const {
    if (surface.inside.priority <= 0) return false;
    const MediumId filling = current();
    if (!from_outside && contains(surface.inside)) return filling != surface.inside;
    return filling && filling.priority > surface.inside.priority;
  }
  /// What fills the outside of the surface, which the point lies on either side of.
  MediumId outside_of(const MediumInterface& surface, bool from_outside) const {
    if (from_outside) return current();
    MediumStack outside = *this;
    outside.cross(surface, false);
    return outside.current();
  }

  bool empty() const { return count_ == 0; }
  /// The medium of the point; none outside of all bodies.
  MediumId current() const {
    MediumId found;
    for (std::size_t i = 0; i < count_; ++i)
      if (!found || media_[i].priority >= found.priority) found = media_[i];
    return found;
  }

private:
  bool contains(MediumId medium) const {
    const auto end = media_.begin() + count_;
    return std::find(media_.begin(), end, medium) != end;
  }

  std::array<MediumId, 7> media_{};
  std::uint32_t count_ = 0;
};

} // namespace candela
