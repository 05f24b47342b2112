#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/facet_albedo.h"
#include "bsdf/fresnel.h"
#include "core/color.h"

namespace candela {

/// Metal of a complex index of refraction, smooth or rough: the Fresnel equations at every facet,
///     f = F(w.h) D G2 / (4 cos_o cos_i)
/// (Walter et al. 2007; Heitz 2014, eq. 99).
struct Conductor {
  Spectrum eta{0.2f}, k{3.0f}; ///< index of refraction over that of the outside: eta + i k
  Spectrum tint{1};            ///< factor of the reflectance, 1 for a measured metal
  Microfacets facets;
  bool smooth = false; ///< a mirror: facets are not asked
  /// Gives back light that is scattered more than once between facets; null: it is lost.
  const FacetAlbedo* compensation = nullptr;

  Spectrum reflectance(float cosine) const { return tint * fresnel_conductor(cosine, eta, k); }

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (smooth || !same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    return above(wo, wi, glm::normalize(wo + wi));
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    if (smooth) {
      const Spectrum weight = reflectance(std::abs(wo.z));
      if (is_black(weight)) return std::nullopt;
      return BsdfSample{reflect_about_normal(wo), weight, 1, true};
    }
    const vec3 w = to_side_of({0, 0, 1}, wo);
    const vec3 h = facets.sample_reflecting_normal(w, u.disc);
    const vec3 wi = 2 * glm::dot(w, h) * h - w;
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = above(w, wi, glm::normalize(w + wi));
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(wo, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  bool is_isotropic() const { return smooth || facets.alpha_x == facets.alpha_y; }
  float delta_probability(vec3) const { return smooth ? 1 : 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | (smooth ? BsdfFlags::delta : BsdfFlags::glossy); }
  LobeProxy lobe_proxy(vec3 wo) const {
    return smooth ? LobeProxy{} : facet_lobe_proxy(facets, wo, luminance(albedo()));
  }
  Spectrum albedo() const { return reflectance(1); }

private:
  BsdfEval above(vec3 wo, vec3 wi, vec3 h) const {
    const float d = facets.d(h), cosine = glm::dot(wo, h);
    Spectrum f_cos = reflectance(cosine) * (d * facets.g2_reflection(wo, wi) / (4 * wo.z));
    if (compensation != nullptr) f_cos *= multiple_scattering_gain((*compensation)(facets, wo), albedo());
    return {f_cos, facets.reflection_pdf(wo, h)};
  }
};

} // namespace candela
