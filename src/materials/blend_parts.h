#pragma once
// Where the parts of mixtures are kept.

#include "materials/bsdf.h"

#include <memory>
#include <span>
#include <vector>

namespace candela {

struct BlendPart {
  Bsdf bsdf;
  float weight = 0;
};

/// Of one mixture, those of nested ones included.
inline constexpr std::size_t kMostBlendParts = 8;

/// Memory for parts, which keep their place until clear().
class BlendArena {
public:
  /// `count` is at most kMostBlendParts.
  std::span<BlendPart> allocate(std::size_t count) {
    if (used_ + count > kMostBlendParts) ++block_, used_ = 0;
    if (block_ >= blocks_.size()) blocks_.push_back(std::make_unique<BlendPart[]>(kMostBlendParts));
    const std::span<BlendPart> parts(blocks_[block_].get() + used_, count);
    used_ += count;
    return parts;
  }
  /// Keeps the memory for the next parts.
  void clear() { block_ = used_ = 0; }
  std::size_t memory_bytes() const { return blocks_.size() * kMostBlendParts * sizeof(BlendPart); }

private:
  std::vector<std::unique_ptr<BlendPart[]>> blocks_;
  std::size_t block_ = 0, used_ = 0; ///< the next part's place
};

} // namespace candela
