#include "sampling/sampler.h"

namespace candela {

void Sampler::make_sobol_points() {
  std::uint64_t key = bounce_key_;
  std::uint32_t reversed_sample = reversed_sample_;
  for (std::uint32_t d = 0; d < kDimensions; ++d) {
    vec2 p = sobol_point(key, reversed_sample, d);
    x_[d] = p.x;
    y_[d] = p.y;
  }
}

} // namespace candela
