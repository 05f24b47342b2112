#pragma once
// Rough surfaces as facets: how their normals are distributed, which of them are seen, and samples of those.

#include "bsdf/lobe_proxy.h"
#include "sampling/warp.h"

namespace candela {

enum class MicrofacetDistribution : int { ggx, beckmann };

/// Facets of a rough surface, under Smith's assumption that a facet's normal and height are independent.
/// Directions and normals are local, the surface's mean normal is +z; directions are above the surface.
///   Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces";
///   Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs".
struct Microfacets {
  MicrofacetDistribution distribution = MicrofacetDistribution::ggx;
  float alpha_x = 0.1f, alpha_y = 0.1f; ///< root mean square slope times sqrt(2), along x and y

  /// Below this a facet normal's float digits no longer resolve the lobe.
  static constexpr float kMinAlpha = 1e-3f;

  /// Of a roughness that is about linear to the eye, alpha = roughness^2, and an anisotropy in [-1, 1] that
  /// makes alpha_x / alpha_y 1 / (1 - 0.9 |anisotropy|), or its inverse (Burley 2012, "Physically Based
  /// Shading at Disney", section 5.4).
  static Microfacets of_roughness(float roughness, float anisotropy = 0,
                                  MicrofacetDistribution distribution = MicrofacetDistribution::ggx) {
    const float aspect = std::sqrt(1 - 0.9f * std::abs(anisotropy)), alpha = sqr(roughness);
    const float wide = std::max(alpha / aspect, kMinAlpha), narrow = std::max(alpha * aspect, kMinAlpha);
    return {distribution, anisotropy < 0 ? narrow : wide, anisotropy < 0 ? wide : narrow};
  }

  /// D(h): area of facets by normal, per area of the surface and sr; D(h) cos(theta_h) integrates to 1. By
  /// components instead of angles: no cancellation near the normal.
  float d(vec3 h) const {
    const float slope2 = sqr(h.x / alpha_x) + sqr(h.y / alpha_y), cos2 = sqr(h.z);
    if (distribution == MicrofacetDistribution::ggx)
      return 1 / (kPi * alpha_x * alpha_y * sqr(slope2 + cos2));
    return cos2 > 0 ? std::exp(-slope2 / cos2) / (kPi * alpha_x * alpha_y * sqr(cos2)) : 0;
  }

  /// Smith's Lambda: masked over visible area of the facets that face w.
  float lambda(vec3 w) const {
    const float projected2 = stretched2(w), cosine = std::abs(w.z);
    if (distribution == MicrofacetDistribution::ggx)
      // (sqrt(1 + a^2 tan^2) - 1) / 2, without the difference.
      return 0.5f * projected2 / (cosine * (cosine + std::sqrt(sqr(cosine) + projected2)));
    const float a = cosine / std::sqrt(projected2); // 1 / (alpha tan theta)
    // (erf(a) - 1) / 2 + exp(-a^2) / (2 a sqrt(pi)); beyond 4 less than float digits resolve.
    if (!(a < 4)) return 0;
    return std::max(std::exp(-sqr(a)) / (2 * a * kSqrtPi) - 0.5f * std::erfc(a), 0.0f);
  }
  /// Share of the facets' area towards w that is seen from there.
  float g1(vec3 w) const { return 1 / (1 + lambda(w)); }
  /// Seen from wo and from wi, both on one side: their heights correlate (Heitz 2014, eq. 99).
  float g2_reflection(vec3 wo, vec3 wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }
  /// Seen from wo on one side and from wi on the other: what is high from here is low from there, so that the
  /// share is Beta(1 + Lambda(wo), 1 + Lambda(wi)) (Heitz, Hanika, d'Eon & Dachsbacher 2016,
  /// "Multiple-Scattering Microfacet BSDFs with the Smith Model", section 6.2).
  float g2_transmission(vec3 wo, vec3 wi) const;

  /// A normal of a facet that w sees, in proportion to its projected area; `disc` is uniform on the unit
  /// disc.
  vec3 sample_visible_normal(vec3 w, vec2 disc) const {
    return distribution == MicrofacetDistribution::ggx ? ggx_visible_normal(w, disc, 1)
                                                       : beckmann_visible_normal(w, disc);
  }
  /// Its density in 1/sr of normals.
  float visible_normal_pdf(vec3 w, vec3 h) const {
    return g1(w) * std::max(glm::dot(w, h), 0.0f) * d(h) / std::abs(w.z);
  }

  /// As sample_visible_normal, for those who mirror w in it and need what arrives above the surface. For GGX
  /// the normals that cannot do that are mostly left out (Eto & Tokuyoshi 2023, "Bounded VNDF Sampling for
  /// Smith-GGX Reflections").
  vec3 sample_reflecting_normal(vec3 w, vec2 disc) const {
    return distribution == MicrofacetDistribution::ggx ? ggx_visible_normal(w, disc, cap_scale(w))
                                                       : beckmann_visible_normal(w, disc);
  }
  /// The density in 1/sr of the direction that h mirrors w into.
  float reflection_pdf(vec3 w, vec3 h) const {
    if (distribution == MicrofacetDistribution::ggx) {
      const float projected = std::sqrt(stretched2(w) + sqr(w.z));
      return d(h) / (2 * (cap_scale(w) * w.z + projected));
    }
    return g1(w) * d(h) / (4 * w.z);
  }

  /// Square of w's part in the surface, stretched by both alphas.
  float stretched2(vec3 w) const { return sqr(alpha_x * w.x) + sqr(alpha_y * w.y); }

private:
  static constexpr float kSqrtPi = 1.7724538509055160f;

  /// Eto & Tokuyoshi's k, in (0, 1]: the cap of mirrored directions ends at z = -k z(w).
  float cap_scale(vec3 w) const {
    const float a2 = sqr(std::min({alpha_x, alpha_y, 1.0f}));
    const float s2 = sqr(1 + std::sqrt(sqr(w.x) + sqr(w.y)));
    return (1 - a2) * s2 / (s2 + a2 * sqr(w.z));
  }

  /// In the space where the surface is a hemisphere, visible normals are half way between w and a uniform
  /// spherical cap of directions (Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
  vec3 ggx_visible_normal(vec3 w, vec2 disc, float scale) const {
    const vec3 w_std = glm::normalize(vec3(alpha_x * w.x, alpha_y * w.y, w.z));
    const vec3 h_std = w_std + uniform_cone_from_disc(disc, 1 + scale * w_std.z);
    return glm::normalize(vec3(alpha_x * h_std.x, alpha_y * h_std.y, std::max(h_std.z, 0.0f)));
  }

  /// By slopes, stretched to alpha = 1 and turned so that w lies in the plane of x: y's slope is Gaussian,
  /// x's has the distribution function
  ///     (1 + erf(s) + tan exp(-s^2) / sqrt(pi)) / norm   for s < cot,
  /// inverted by Newton's method within brackets (Heitz & d'Eon 2014, "Importance Sampling Microfacet-Based
  /// BSDFs using the Distribution of Visible Normals", supplemental; Jakob 2014, "An Improved Visible Normal
  /// Sampling Routine for the Beckmann Distribution").
  vec3 beckmann_visible_normal(vec3 w, vec2 disc) const;
};

/// Of a lobe of facets with that reflectance. With the half vector at delta / 2, as it is in the plane of wo
/// and the normal. A little of the peak is given to all directions, for the lobe's tails are longer than the
/// proxy's.
inline LobeProxy facet_lobe_proxy(const Microfacets& facets, vec3 wo, float reflectance) {
  const float wide = std::max(facets.alpha_x, facets.alpha_y);
  const float projected = std::sqrt(facets.stretched2(wo) + sqr(wo.z));
  const float peak = reflectance * facets.d({0, 0, 1}) / (4 * std::max(projected, wide));
  return {0.02f * reflectance * kInvPi, peak, 0.5f / sqr(wide)};
}

} // namespace candela
