#pragma once
// How much light layers reflect before it reaches what is below them: tables, computed at first use.

#include "bsdf/grid_table.h"
#include "bsdf/microfacets.h"
#include "core/spectrum.h"

namespace candela {

/// The share of light from w that GGX facets which absorb nothing mirror out of the surface at once: not less
/// than it is, by the error of FacetAlbedo, so that whatever is divided by it does not grow too much.
float lossless_share(const Microfacets& facets, vec3 w);

/// The share of light from w that GGX facets of a dielectric mirror out of the surface at once; eta, from 1
/// to 3, is the refractive index below over that above. Not less than it is, so that the rest may be given to
/// another layer: 2 to 5 % more, of anisotropic facets 5 to 15 %.
float layer_albedo(const Microfacets& facets, vec3 w, float eta);

/// The same of any reflectance that is a function of the angle between a facet's normal and w.
class ReflectedShares {
public:
  static constexpr int kNodes = 15;
  static float cosine(int node) { return sqr(static_cast<float>(node) / (kNodes - 1)); }

  /// For reflectance(cosine), in [0, 1]: interpolated between the nodes, and what that may be wrong is added.
  template <class Reflectance>
  static Spectrum albedo(const Microfacets& facets, vec3 w, Reflectance reflectance) {
    std::array<Spectrum, kNodes> at;
    for (int i = 0; i < kNodes; ++i) at[static_cast<std::size_t>(i)] = reflectance(cosine(i));
    Spectrum mean(0);
    for (int i = 0; i < kNodes; ++i) {
      // A parabola is within an eighth of its second difference of its chord; fringes may be a little more.
      const auto middle = static_cast<std::size_t>(std::clamp(i, 1, kNodes - 2));
      const Spectrum bend = at[middle - 1] - 2.0f * at[middle] + at[middle + 1];
      mean += share(facets, w, i) * (at[static_cast<std::size_t>(i)] + 0.3f * glm::abs(bend));
    }
    return lossless_share(facets, w) * glm::min(mean, Spectrum(1));
  }

private:
  static float share(const Microfacets& facets, vec3 w, int node);
};

/// Mean reflectance of a smooth dielectric for light from everywhere: 2 int F(mu) mu dmu.
float mean_fresnel(float eta);

} // namespace candela
