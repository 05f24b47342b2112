#pragma once

#include "core/hash.h"
#include "core/ray.h"
#include "sampling/sampler.h"

namespace candela {

/// As many random numbers as tracking through a grid takes: SplitMix64 (Steele, Lea & Flood 2014), begun with
/// the sampler's numbers and the ray, so that rays of one bounce differ, and each can be traced again.
class TrackingRandom {
public:
  TrackingRandom(const Sampler& sampler, vec3 origin, vec3 direction) {
    const vec2 u = sampler.get_2d(Dimension::medium_tracking);
    state_ = hash_combine(bits(u.x), bits(u.y));
    for (int axis = 0; axis < 3; ++axis)
      state_ = hash_combine(state_,
                            (static_cast<std::uint64_t>(bits(origin[axis])) << 32) | bits(direction[axis]));
  }

  float next() { // in [0, 1)
    state_ += 0x9e3779b97f4a7c15ull;
    return to_unit_float(static_cast<std::uint32_t>(hash64(state_) >> 32));
  }
  /// An optical depth of density exp(-depth).
  float next_depth() { return -std::log(1 - next()); }

private:
  static std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

  std::uint64_t state_;
};

} // namespace candela
