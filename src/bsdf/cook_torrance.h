#pragma once

#include "bsdf/blinn_facets.h"
#include "bsdf/bsdf_sample.h"
#include "bsdf/fresnel.h"
#include "bsdf/microfacets.h"
#include "core/color.h"

namespace candela {

enum class FacetNormals : int { ggx, beckmann, blinn };
enum class FacetMasking : int {
  smith,   ///< height-correlated (Heitz 2014, eq. 99), with the Lambda of the normals
  schlick, ///< k = alpha / 2, which fits Smith's of GGX (Karis 2013, "Real Shading in Unreal Engine 4")
  v_cavity ///< of long grooves (Torrance & Sparrow 1967, "Theory for Off-Specular Reflection from Roughened
           ///< Surfaces")
};
enum class FacetFresnel : int {
  exact,  ///< of the dielectric with that reflectance at normal incidence
  schlick ///< fresnel_schlick
};

/// Cook & Torrance 1982, "A Reflectance Model for Computer Graphics": a mirror at every facet, over a matte
/// base,
///     f = F(w.h) D(h) G(wo, wi) / (4 cos_o cos_i) + (1 - F(cos_o)) (1 - F(cos_i)) diffuse / pi,
/// each of D, G and F to choose. The paper has 1 / pi in place of 1 / 4, with a D that is normalised
/// otherwise; 1 / 4 is what conservation of energy asks (Walter et al. 2007, eq. 20). The base is lit by what
/// both interfaces let pass (as Shirley et al. 1997, "A Practitioners' Assessment of Light Reflection
/// Models", without their approximation of F), so that it darkens towards grazing angles.
///
/// Reciprocal, and no choice reflects more than it gets: Smith's G and the grooves' are exact for these
/// normals, and Schlick's is below Smith's. Light that meets a second facet is lost.
struct CookTorrance {
  Spectrum diffuse{0.5f}; ///< reflectance of the base
  Spectrum f0{0.04f};     ///< reflectance of a facet at normal incidence
  float alpha = 0.1f;     ///< of the facets, in [Microfacets::kMinAlpha, 1]
  FacetNormals normals = FacetNormals::ggx;
  FacetMasking masking = FacetMasking::smith;
  FacetFresnel fresnel = FacetFresnel::exact;

  /// F. The index of refraction follows from F0 = ((eta - 1) / (eta + 1))^2, as in the paper.
  Spectrum reflectance(float cosine) const {
    if (fresnel == FacetFresnel::schlick) return fresnel_schlick(f0, cosine);
    Spectrum r;
    for (int c = 0; c < 3; ++c) {
      const float root = std::min(std::sqrt(f0[c]), 0.99995f); // eta stays finite
      r[c] = fresnel_dielectric(std::min(cosine, 1.0f), (1 + root) / (1 - root));
    }
    return r;
  }
  /// D, 1/sr, of facets with normal h above the surface.
  float d(vec3 h) const { return normals == FacetNormals::blinn ? blinn().d(h) : facets().d(h); }
  /// G, of directions above the surface, their half vector and its cosine with either.
  float g(vec3 wo, vec3 wi, vec3 h, float cosine) const {
    if (masking == FacetMasking::v_cavity) return std::min(1.0f, 2 * h.z * std::min(wo.z, wi.z) / cosine);
    if (masking == FacetMasking::schlick) return schlick_g1(wo.z) * schlick_g1(wi.z);
    return 1 / (1 + lambda(wo) + lambda(wi));
  }

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    return above(wo, wi);
  }

  /// The facets' lobe by visible normals, of Blinn's facets by D cos; directions below the surface fail.
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    const vec3 w = to_side_of({0, 0, 1}, wo);
    vec3 wi;
    if (u.lobe < specular_probability(w.z)) {
      const vec3 h = normals == FacetNormals::blinn ? blinn().sample_normal(u.disc)
                                                    : facets().sample_reflecting_normal(w, u.disc);
      wi = 2 * glm::dot(w, h) * h - w;
    } else {
      wi = cosine_hemisphere_from_disc(u.disc);
    }
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = above(w, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(wo, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const {
    return BsdfFlags::reflection | BsdfFlags::glossy |
           (is_black(diffuse) ? BsdfFlags::none : BsdfFlags::diffuse);
  }
  LobeProxy lobe_proxy(vec3 wo) const {
    LobeProxy proxy =
        facet_lobe_proxy(facets(), wo, std::max(luminance(reflectance(std::abs(wo.z))), kLeastSpecular));
    proxy.diffuse += luminance(diffuse) * kInvPi;
    return proxy;
  }
  Spectrum albedo() const { return f0 + (Spectrum(1) - f0) * diffuse; }

  /// Of the facets' lobe being sampled; wo above the surface.
  float specular_probability(float cos_o) const {
    const Spectrum f = reflectance(cos_o);
    const float s = std::max(luminance(f), kLeastSpecular);
    const float base = luminance((Spectrum(1) - f) * diffuse);
    return base > 0 ? s / (s + base) : 1;
  }

private:
  /// Facets without reflectance at normal incidence may still reflect at grazing angles.
  static constexpr float kLeastSpecular = 0.02f;

  Microfacets facets() const {
    return {normals == FacetNormals::beckmann ? MicrofacetDistribution::beckmann
                                              : MicrofacetDistribution::ggx,
            alpha, alpha};
  }
  BlinnFacets blinn() const { return {alpha}; }
  float lambda(vec3 w) const {
    return normals == FacetNormals::blinn ? blinn().lambda(w) : facets().lambda(w);
  }
  float schlick_g1(float cosine) const {
    const float k = 0.5f * alpha;
    return cosine / (cosine * (1 - k) + k);
  }

  BsdfEval above(vec3 wo, vec3 wi) const {
    const float length = glm::length(wo + wi), cosine = 0.5f * length; // the same from both sides
    const vec3 h = (wo + wi) / length;
    Spectrum f_cos = reflectance(cosine) * (d(h) * g(wo, wi, h, cosine) / (4 * wo.z));
    if (!is_black(diffuse))
      f_cos +=
          (Spectrum(1) - reflectance(wo.z)) * (Spectrum(1) - reflectance(wi.z)) * diffuse * (wi.z * kInvPi);
    const float p = specular_probability(wo.z);
    const float specular =
        normals == FacetNormals::blinn ? blinn().reflection_pdf(h, cosine) : facets().reflection_pdf(wo, h);
    return {f_cos, p * specular + (1 - p) * wi.z * kInvPi};
  }
};

} // namespace candela
