#pragma once

#include "core/ray.h"
#include "core/spectrum.h"
#include "sampling/sampler.h"

namespace candela {

/// The same everywhere; absorbs, and neither scatters nor emits.
struct AbsorbingMedium {
  Spectrum sigma_a{0}; ///< absorption coefficient, 1/scene unit

  /// exp(-sigma_a distance), by Beer and Lambert.
  Spectrum transmittance(const Ray&, float distance, const Sampler&) const {
    const Spectrum depth = sigma_a * distance;
    Spectrum passes = glm::exp(-depth);
    for (int c = 0; c < 3; ++c)
      if (std::isnan(depth[c])) passes[c] = 1; // 0 x infinity: nothing is absorbed on an infinite way
    return passes;
  }
};

} // namespace candela
