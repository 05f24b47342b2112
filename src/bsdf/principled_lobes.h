#pragma once
// What Disney's models of solid and of thin surfaces share:
//   Burley 2012, "Physically Based Shading at Disney";
//   Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering".
// The formulas are those of Mitsuba 3's "principled" and "principledthin", so that their scenes look the
// same.

#include "bsdf/fresnel.h"
#include "bsdf/microfacets.h"
#include "core/color.h"

namespace candela {

struct PrincipledValues {
  Spectrum base_color{0.5f};
  float roughness = 0.5f; ///< alpha = roughness^2
  float anisotropic = 0;
  float metallic = 0;
  float spec_trans = 0; ///< how much of what is no metal is glass
  float eta = 1.5f;     ///< refractive index inside over outside, >= 1
  float spec_tint = 0;
  float sheen = 0, sheen_tint = 0;
  float flatness = 0;
  float clearcoat = 0, clearcoat_gloss = 0;
  bool thin = false;    ///< a sheet without inside: metallic and clearcoat are not asked, diff_trans is
  float diff_trans = 0; ///< in [0, 2]: 2 is nothing but diffuse transmission
};

namespace principled {

/// Schlick's (1 - cos)^5.
inline float grazing(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return sqr(sqr(m)) * m;
}
inline float lerp(float a, float b, float t) { return a + t * (b - a); }

/// The base colour at a luminance of 1.
inline Spectrum tint(Spectrum base_color) {
  const float y = luminance(base_color);
  return y > 0 ? base_color / y : Spectrum(1);
}

/// Reflectance of a dielectric, of which spec_tint is of the base colour's hue. That of normal incidence is
/// kept to 1, which matters only for saturated colours of high indices.
inline Spectrum dielectric_reflectance(const PrincipledValues& v, float cosine) {
  const float plain = fresnel_dielectric(cosine, v.eta);
  if (!(v.spec_tint > 0)) return Spectrum(plain);
  const Spectrum f0 = glm::min(tint(v.base_color) * sqr((v.eta - 1) / (v.eta + 1)), Spectrum(1));
  return (1 - v.spec_tint) * Spectrum(plain) + v.spec_tint * fresnel_schlick(f0, cosine);
}

/// f |cos theta_i| of diffuse reflection, without its sheen: Burley 2015, eq. 4, and as `flatness` grows
/// Burley 2012's "subsurface", which is after Hanrahan & Krueger. Both above the surface; h is half way
/// between.
inline Spectrum diffuse(const PrincipledValues& v, vec3 wo, vec3 wi, vec3 h) {
  const float fo = grazing(wo.z), fi = grazing(wi.z);
  const float retro = 2 * v.roughness * sqr(glm::dot(wi, h));
  float shape = (1 - 0.5f * fo) * (1 - 0.5f * fi) + retro * (fo + fi + fo * fi * (retro - 1));
  if (v.flatness > 0) {
    const float f90 = 0.5f * retro, f = lerp(1, f90, fo) * lerp(1, f90, fi);
    shape = lerp(shape, 1.25f * (f * (1 / (wo.z + wi.z) - 0.5f) + 0.5f), v.flatness);
  }
  return v.base_color * (shape * wi.z * kInvPi);
}

/// f |cos theta_i| of a sheen of 1: Burley 2012, section 5.5.
inline Spectrum sheen(const PrincipledValues& v, vec3 wi, vec3 h) {
  const Spectrum color = Spectrum(1 - v.sheen_tint) + v.sheen_tint * tint(v.base_color);
  return color * (grazing(glm::dot(wi, h)) * wi.z);
}
/// About how much of that there is for light from wo.
inline float sheen_albedo(float cosine) { return 1e-3f + 0.5f * sqr(sqr(1 - cosine)); }

/// The second specular lobe, of facets that are distributed by GTR1 (Burley 2012, appendix B.2). As in
/// Mitsuba there is no 1 / (4 cos_o cos_i) in it.
struct Clearcoat {
  float alpha;

  explicit Clearcoat(float gloss) : alpha(lerp(0.1f, 0.001f, gloss)) {}

  float d(vec3 h) const {
    const float a2 = sqr(alpha);
    return (1 - a2) / (-kPi * std::log(a2) * (sqr(h.x) + sqr(h.y) + a2 * sqr(h.z)));
  }
  /// f |cos theta_i| of a clearcoat of 1; both above the surface.
  float value(vec3 wo, vec3 wi, vec3 h) const {
    constexpr float kMaskingAlpha = 0.25f;
    const Microfacets masking{MicrofacetDistribution::ggx, kMaskingAlpha, kMaskingAlpha};
    const float reflectance = lerp(0.04f, 1, grazing(glm::dot(wo, h)));
    return 0.25f * reflectance * d(h) * masking.g1(wo) * masking.g1(wi) * wi.z;
  }
  /// About how much of that there is for light from wo.
  static float albedo(float cosine) { return 0.002f + lerp(0.04f, 1, grazing(cosine)) * cosine * cosine; }

  /// Normals in proportion to d cos theta.
  vec3 sample(vec2 disc) const {
    const float r2 = std::min(glm::dot(disc, disc), kOneMinusEpsilon), a2 = sqr(alpha);
    const float sine2 = a2 * std::expm1(-r2 * std::log(a2)) / (1 - a2);
    const float scale = r2 > 0 ? std::sqrt(sine2 / r2) : 0;
    return {disc * scale, safe_sqrt(1 - sine2)};
  }
  /// Of the direction that such a normal mirrors wo into.
  float pdf(vec3 wo, vec3 h) const { return d(h) * h.z / (4 * glm::dot(wo, h)); }
};

} // namespace principled

} // namespace candela
