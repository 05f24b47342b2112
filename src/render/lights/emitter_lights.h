#pragma once
// Maps primitives to lights. Of the billions of triangles in instances, few emit.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace candela {

inline constexpr std::uint32_t kNoLight = 0xffffffffu;

/// A table in pages, of which only those exist that hold a light: a lamp among a thousand instances of a
/// large mesh takes no number for each of their triangles.
class EmitterLights {
public:
  /// Forgets all; for emitters numbered from 0 below `emitters` (Geometry::emitter_count).
  void reset(std::uint64_t emitters) {
    page_of_.assign(static_cast<std::size_t>((emitters + kPage - 1) / kPage), kNoPage);
    lights_.clear();
  }

  /// The light's index, or kNoLight; before the first reset() for every emitter.
  std::uint32_t operator[](std::uint64_t emitter) const {
    if (page_of_.empty()) return kNoLight;
    const std::uint32_t page = page_of_[emitter / kPage];
    return page == kNoPage ? kNoLight : lights_[page * kPage + emitter % kPage];
  }

  void set(std::uint64_t emitter, std::uint32_t light) {
    std::uint32_t& page = page_of_[emitter / kPage];
    if (page == kNoPage) {
      page = static_cast<std::uint32_t>(lights_.size() / kPage);
      lights_.resize(lights_.size() + kPage, kNoLight);
    }
    lights_[page * kPage + emitter % kPage] = light;
  }

  std::size_t memory_bytes() const { return (page_of_.size() + lights_.size()) * sizeof(std::uint32_t); }

private:
  static constexpr std::size_t kPage = 4096; ///< emitters
  static constexpr std::uint32_t kNoPage = 0xffffffffu;
  std::vector<std::uint32_t> page_of_;
  std::vector<std::uint32_t> lights_; ///< page by page
};

} // namespace candela
