#pragma once
// Gradient noise for the models of `candela bench scale`: the same numbers on every machine.

#include "core/math.h"

#include <cstdint>

namespace candela {

struct NoiseSample {
  double value = 0; ///< about -1..1, mean 0
  glm::dvec2 gradient{0};
};

/// K. Perlin, "Improving Noise", SIGGRAPH 2002: gradients at the points of the integer lattice, blended by a
/// polynomial of the fifth degree, so that the second derivative is continuous.
NoiseSample gradient_noise(glm::dvec2 p, std::uint32_t seed);
double gradient_noise(glm::dvec3 p, std::uint32_t seed);

/// A sum of octaves, each of half the wavelength and half the amplitude.
double fractal_noise(glm::dvec2 p, int octaves, std::uint32_t seed);
double fractal_noise(glm::dvec3 p, int octaves, std::uint32_t seed);

/// A random number in [0, 1) for an index.
double hashed_unit(std::uint32_t index, std::uint32_t seed);

} // namespace candela
