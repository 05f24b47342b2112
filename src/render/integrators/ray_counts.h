#pragma once

#include <cstdint>

namespace candela {

/// Ray and path counts; summed per tile, so that counting costs no atomic per ray.
struct RayCounts {
  std::uint64_t samples = 0; ///< camera paths
  std::uint64_t closest = 0; ///< closest-hit rays
  std::uint64_t shadow = 0;  ///< any-hit rays

  RayCounts& operator+=(const RayCounts& o) {
    samples += o.samples, closest += o.closest, shadow += o.shadow;
    return *this;
  }
};

} // namespace candela
