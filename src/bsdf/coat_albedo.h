#pragma once
// How much of the light that falls on the interface of a coat is reflected there, smooth or rough.

#include "bsdf/grid_table.h"
#include "bsdf/microfacets.h"

namespace candela {

/// Share of diffuse light that a smooth dielectric reflects, on the side of the lower refractive index; eta
/// >= 1 is that of the far side over it (Walsh 1926; Duntley 1942, "The Optical Properties of Diffusing
/// Materials"). 0.091778 of 1.5.
float diffuse_fresnel_reflectance(float eta);
/// What is reflected of diffuse light on the other side, of the higher index: what crosses the interface one
/// way is 1 / eta^2 of what crosses it the other way. 0.596346 of 1.5.
inline float internal_diffuse_reflectance(float outside, float eta) { return 1 - (1 - outside) / sqr(eta); }

/// The share that facets of a rough dielectric mirror out at once, of light from outside. What meets a second
/// facet is taken to pass, as most of it does.
class CoatAlbedo {
public:
  /// Computed at first use.
  static const CoatAlbedo& of(MicrofacetDistribution distribution);

  static constexpr float kMaxEta = 3;

  /// Of light from that angle; eta, from 1 to kMaxEta, is inside over outside. Error some 1e-3;
  /// of almost smooth coats in grazing directions up to 5e-3.
  float operator()(float alpha, float cosine, float eta) const;
  /// Of diffuse light.
  float mean(float alpha, float eta) const;

  explicit CoatAlbedo(MicrofacetDistribution distribution);

private:
  GridTable<3> table_;
  GridTable<2> mean_;
};

} // namespace candela
