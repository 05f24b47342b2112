#pragma once
// How much light rough surfaces scatter at the first facet, so that models which leave out the rest can give
// it back: Turquin 2019, "Practical multiple scattering compensation for microfacet models".

#include "bsdf/grid_table.h"
#include "bsdf/microfacets.h"
#include "core/spectrum.h"

namespace candela {

/// The share of light from w that facets which absorb nothing mirror out of the surface at once: in (0, 1].
/// What is missing to 1 meets another facet.
class FacetAlbedo {
public:
  /// For facets of that distribution, all as wide along x as along y or not; computed at first use.
  static const FacetAlbedo& of(MicrofacetDistribution distribution, bool anisotropic);

  /// Relative error some 1e-3, of anisotropic facets up to 1e-2.
  float operator()(const Microfacets& facets, vec3 w) const;

  FacetAlbedo(MicrofacetDistribution distribution, bool anisotropic);

private:
  GridTable<4> table_;
  bool anisotropic_;
};

/// The share that facets of a dielectric mirror or refract away at once.
class InterfaceAlbedo {
public:
  /// Computed at first use.
  static const InterfaceAlbedo& of(MicrofacetDistribution distribution);

  /// eta, from 1/3 to 3, is the refractive index of the far side over that of w's. Facets wider along one
  /// axis are taken for round ones of the same area.
  float operator()(const Microfacets& facets, vec3 w, float eta) const;

  explicit InterfaceAlbedo(MicrofacetDistribution distribution);

private:
  GridTable<3> table_;
};

/// The factor by which a reflecting lobe grows, given facet_albedo and the reflectance at normal incidence:
/// what is scattered twice and more is given the same shape (Turquin 2019, eq. 16). Not reciprocal.
inline Spectrum multiple_scattering_gain(float albedo, Spectrum f0) {
  return Spectrum(1) + f0 * ((1 - albedo) / albedo);
}

} // namespace candela
