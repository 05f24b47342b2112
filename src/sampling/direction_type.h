#pragma once

namespace candela {

/// How a scattered direction is chosen (materials/direction_sampling.h); all have the same expectation.
enum class DirectionSampling : int {
  uniform, ///< uniform over the hemisphere
  cosine,  ///< proportional to the cosine with the shading normal
  bsdf,    ///< as the BSDF itself scatters
};

} // namespace candela
