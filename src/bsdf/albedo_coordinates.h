#pragma once
// Coordinates in [0, 1] of the grids of albedos: evenly spaced in them, points are dense where albedos bend.

#include "bsdf/microfacets.h"

namespace candela {

/// Of an index of refraction of at least 1: the root of (twice) the amplitude of reflection at normal
/// incidence, for as the index comes to 1 all happens in grazing directions.
inline float eta_coordinate(float eta) { return std::sqrt(2 * std::max(eta - 1, 0.0f) / (eta + 1)); }
inline float eta_at(float coordinate) {
  const float amplitude = 0.5f * sqr(coordinate);
  return (1 + amplitude) / (1 - amplitude);
}

/// Of a roughness alpha: its root, from Microfacets::kMinAlpha to 1.
inline constexpr float kMinAlphaRoot = 0.0316227766f;
inline float alpha_coordinate(float alpha) {
  return (std::sqrt(alpha) - kMinAlphaRoot) / (1 - kMinAlphaRoot);
}
inline float alpha_at(float coordinate) { return sqr(kMinAlphaRoot + coordinate * (1 - kMinAlphaRoot)); }

} // namespace candela
