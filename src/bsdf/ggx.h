#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/fresnel.h"
#include "core/color.h"

namespace candela {

/// Rough conductor: isotropic GGX microfacets (Walter et al. 2007, "Microfacet Models for Refraction through
/// Rough Surfaces") with Schlick's Fresnel term and Smith's height-correlated masking and shadowing (Heitz
/// 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", eq. 99):
///     f = F D G2 / (4 cos_o cos_i).
/// Multiple scattering between facets is ignored, so rough surfaces are slightly too dark.
///
/// Half vectors are sampled from the visible normals by spherical caps (Dupuy & Benyoub 2023, "Sampling
/// Visible GGX Normals with Spherical Caps"), the cap being cut to what can reflect upwards (Eto & Tokuyoshi
/// 2023, "Bounded VNDF Sampling for Smith-GGX Reflections").
struct Ggx {
  Spectrum specular{0.9f}; ///< reflectance at normal incidence, F0
  float roughness = 0.3f;  ///< alpha = roughness^2, which is about linear to the eye

  /// Below this, floats of facet normals cannot resolve the lobe.
  static constexpr float kMinAlpha = 1e-3f;
  float alpha() const { return std::max(sqr(roughness), kMinAlpha); }

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    float a = alpha();
    vec3 h = glm::normalize(wo + wi);
    float cos_o = std::abs(wo.z), cos_i = std::abs(wi.z);
    float d = distribution(h, a);
    // G1(w) = 2 cos / (cos + projected(w)), and G2 / (4 cos_o cos_i) = 1 / (2 (cos_o projected(i) + cos_i
    // projected(o))).
    float projected_o = projected_area(wo, a), projected_i = projected_area(wi, a);
    Spectrum f_cos = fresnel_schlick(specular, glm::dot(wo, h)) *
                     (0.5f * d * cos_i / (cos_o * projected_i + cos_i * projected_o));
    return {f_cos, d / (2 * (cap_scale(wo, a) * cos_o + projected_o))};
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    float a = alpha();
    vec3 w = to_side_of({0, 0, 1}, wo);
    // In the space where the surface is a hemisphere: the cap of directions that it mirrors w into.
    vec3 w_std = glm::normalize(vec3(a * w.x, a * w.y, w.z));
    vec3 mirrored = uniform_cone_from_disc(u.disc, 1 + cap_scale(w, a) * w_std.z);
    vec3 h_std = w_std + mirrored;
    vec3 h = glm::normalize(vec3(a * h_std.x, a * h_std.y, std::max(h_std.z, 0.0f)));
    vec3 wi = 2 * glm::dot(w, h) * h - w;
    if (!(wi.z > 0)) return std::nullopt;
    BsdfEval e = eval_pdf(w, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(wo, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::glossy; }
  /// With the half vector at delta / 2, as it is in the plane of wo and the normal. A little of the peak is
  /// given to all directions, for the lobe's tails are longer than the proxy's.
  LobeProxy lobe_proxy(vec3 wo) const {
    const float a = alpha(), reflectance = luminance(specular);
    const float peak = reflectance * distribution({0, 0, 1}, a) / (4 * std::max(projected_area(wo, a), a));
    return {0.02f * reflectance * kInvPi, peak, 0.5f / sqr(a)};
  }
  Spectrum albedo() const { return specular; }

  /// D(h): area of facets by normal, per area and sr; D(h) |cos theta_h| integrates to 1. By components
  /// instead of angles: no cancellation near the normal.
  static float distribution(vec3 h, float a) {
    float e = (sqr(h.x) + sqr(h.y)) / sqr(a) + sqr(h.z);
    return 1 / (kPi * sqr(a) * sqr(e));
  }
  /// sqrt(a^2 sin^2 + cos^2), of w.
  static float projected_area(vec3 w, float a) {
    return std::sqrt(sqr(a) * (sqr(w.x) + sqr(w.y)) + sqr(w.z));
  }
  /// Eto & Tokuyoshi's k, in (0, 1]: the cap of mirrored directions ends at z = -k z(w). 1 is the whole of
  /// the visible normals.
  static float cap_scale(vec3 w, float a) {
    a = std::min(a, 1.0f);
    float s2 = sqr(1 + std::sqrt(sqr(w.x) + sqr(w.y)));
    return (1 - sqr(a)) * s2 / (s2 + sqr(a) * sqr(w.z));
  }
};

} // namespace candela
