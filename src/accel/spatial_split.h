#pragma once
// Splits of space rather than of a list: primitives that reach across are referenced on both sides, each with
// the box of its part there (Stich, Friedrich & Dietrich 2009, "Spatial Splits in Bounding Volume
// Hierarchies").

#include "accel/split.h"

namespace candela::accel_detail {

/// The boxes of what lies below and above a plane.
struct Parts {
  BuildBox below, above; ///< empty where nothing does
};

/// What as many refs cost to test, over their area; see packs().
inline float packs_of(std::uint32_t count) {
  const auto packs = (count + kWidth - 1) / kWidth;
  return static_cast<float>(packs);
}

inline bool is_empty(const BuildBox& box) {
  simd::Vec4 d = box.v.lower() + box.v.upper(); // lower minus upper corner
  return d[0] > 0 || d[1] > 0 || d[2] > 0;
}

/// Whether primitives of the kind can be cut: those of others are referenced on one side of a split only.
inline bool cuttable(PrimitiveKind kind) {
  static constexpr PerKind<bool> kCuttable = [] {
    PerKind<bool> table{};
    PrimitiveKinds::for_each(
        [&]<class Kind>() { table[number(PrimitiveKinds::kind_of<Kind>)] = CuttableKind<Kind>; });
    return table;
  }();
  return kCuttable[number(kind)];
}
inline bool can_cut(const AccelInput& input) {
  bool any = false;
  PrimitiveKinds::for_each([&]<class Kind>() { any |= CuttableKind<Kind> && Kind::count(input) > 0; });
  return any;
}

/// Knows the primitives behind the refs.
class Cutter {
public:
  explicit Cutter(const AccelInput& input) : input_(input) {
    PrimitiveKinds::for_each(
        [&]<class Kind>() { cuts_all_ &= CuttableKind<Kind> || Kind::count(input) == 0; });
  }

  /// Whether the primitive, or any, can be cut.
  bool cuts(const BuildRef& ref) const { return cuts_all_ || cuttable(ref.kind()); }
  bool cuts_all() const { return cuts_all_; }

  /// Of a primitive of a cuttable kind, within the ref's box.
  Parts cut(const BuildRef& ref, const BuildBox& box, std::size_t axis, float plane) const {
    Parts parts;
    auto below = [&](simd::Vec4 lo, simd::Vec4 hi) { parts.below.grow(joined(lo, -hi)); };
    auto above = [&](simd::Vec4 lo, simd::Vec4 hi) { parts.above.grow(joined(lo, -hi)); };
    PrimitiveKinds::visit(ref.kind(), [&]<class Kind>() {
      if constexpr (CuttableKind<Kind>) Kind::cut(input_, ref.index(), axis, plane, below, above);
      return CuttableKind<Kind>;
    });
    parts.below.v = max(parts.below.v, box.v);
    parts.above.v = max(parts.above.v, box.v);
    return parts;
  }

private:
  static simd::Float8 joined(simd::Vec4 lower, simd::Vec4 upper) {
    alignas(32) std::array<float, 8> v;
    for (int i = 0; i < 4; ++i) {
      v[static_cast<std::size_t>(i)] = lower[i];
      v[static_cast<std::size_t>(i) + 4] = upper[i];
    }
    return simd::Float8::load(v.data());
  }

  const AccelInput& input_;
  bool cuts_all_ = true;
};

/// Bins of equal width over the box of a range, along one axis.
class SpatialBins {
public:
  SpatialBins(const Cutter& cutter, const BuildBox& box, std::size_t axis)
      : cutter_(cutter), axis_(axis), origin_(box.lo()[static_cast<int>(axis)]) {
    const float extent = box.hi()[static_cast<int>(axis)] - origin_;
    width_ = extent / kBins;
    scale_ = kBins / extent;
    usable_ = std::isfinite(extent) && std::isfinite(scale_) && origin_ + width_ > origin_;
    begins_.fill(0), ends_.fill(0);
  }
  bool usable() const { return usable_; }
  /// Where bin i begins.
  float plane(int i) const { return origin_ + static_cast<float>(i) * width_; }

  /// The bins that a ref reaches from and to; of what cannot be cut, that of its centre.
  int first_bin(const BuildRef& ref) const {
    return cutter_.cuts(ref) ? bin(ref.lo[axis_]) : bin(0.5f * (ref.lo[axis_] - ref.negated_hi[axis_]));
  }
  int last_bin(const BuildRef& ref) const {
    return cutter_.cuts(ref) ? last_bin(bin(ref.lo[axis_]), -ref.negated_hi[axis_]) : first_bin(ref);
  }

  /// Borders of bins that refs reach across.
  std::size_t crossings(const BuildRef* from, const BuildRef* to) const {
    std::size_t sum = 0;
    if (cutter_.cuts_all()) { // without a look at their kinds the loop is made of vectors
      for (; from != to; ++from) {
        const int first = bin(from->lo[axis_]);
        sum += static_cast<std::size_t>(last_bin(first, -from->negated_hi[axis_]) - first);
      }
      return sum;
    }
    for (; from != to; ++from) sum += static_cast<std::size_t>(last_bin(*from) - first_bin(*from));
    return sum;
  }

  void fill(const BuildRef* from, const BuildRef* to) {
    for (; from != to; ++from) {
      const int first = first_bin(*from), last = last_bin(*from);
      ++begins_[static_cast<std::size_t>(first)];
      ++ends_[static_cast<std::size_t>(last)];
      BuildBox rest{from->box()};
      for (int b = first; b < last; ++b) {
        const Parts parts = cutter_.cut(*from, rest, axis_, plane(b + 1));
        if (!is_empty(parts.below)) box_[static_cast<std::size_t>(b)].grow(parts.below);
        rest = parts.above;
      }
      if (!is_empty(rest)) box_[static_cast<std::size_t>(last)].grow(rest);
    }
  }

  /// `position` is the first bin above.
  Split best_split() const {
    std::array<float, kBins> above_cost;
    BuildBox side;
    int count = 0;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      side.grow(box_[i]);
      count += ends_[i];
      above_cost[i] = count > 0 ? side.half_area() * packs_of(static_cast<std::uint32_t>(count)) : kInfinity;
    }
    side = {}, count = 0;
    Split split;
    for (std::size_t i = 1; i < kBins; ++i) {
      side.grow(box_[i - 1]);
      count += begins_[i - 1];
      if (count == 0) continue;
      const float cost = side.half_area() * packs_of(static_cast<std::uint32_t>(count)) + above_cost[i];
      if (cost < split.cost) split = {cost, static_cast<int>(axis_), static_cast<int>(i)};
    }
    return split;
  }
  int count_below(int position) const {
    int sum = 0;
    for (int i = 0; i < position; ++i) sum += begins_[static_cast<std::size_t>(i)];
    return sum;
  }
  int count_above(int position) const {
    int sum = 0;
    for (int i = position; i < kBins; ++i) sum += ends_[static_cast<std::size_t>(i)];
    return sum;
  }

private:
  /// What ends where a bin begins does not reach into it.
  int last_bin(int first, float hi) const {
    const int last = bin(hi);
    return last > first && plane(last) >= hi ? last - 1 : last;
  }
  int bin(float x) const { return std::clamp(static_cast<int>((x - origin_) * scale_), 0, kBins - 1); }

  const Cutter& cutter_;
  std::size_t axis_;
  float origin_, width_, scale_;
  bool usable_;
  std::array<BuildBox, kBins> box_;
  std::array<int, kBins> begins_, ends_; ///< refs whose first, last bin it is
};

} // namespace candela::accel_detail
