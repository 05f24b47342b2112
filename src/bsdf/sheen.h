#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/grid_table.h"
#include "core/color.h"

namespace candela {

/// Cloth: fibres that stand out of the surface, over a Lambertian base. Estevez & Kulla 2017, "Production
/// Friendly Microfacet Sheen BRDF": their distribution of normals, most of them horizontal, and the
/// visibility of Ashikhmin & Premoze 2007, "Distribution-based BRDFs", which needs no fitted numbers:
///     f = sheen D / (4 (cos_o + cos_i - cos_o cos_i)) + base scale(wo, wi) / pi,
///     D = (2 + 1 / r) sin(theta_h)^(1 / r) / (2 pi).
/// The base gets what the lobe leaves, scale = 1 - sheen max(E(wo), E(wi)), with E the lobe's albedo and
/// sheen's greatest component: reciprocal, and no more is reflected than was received. Not lossless.
class SheenAlbedo {
public:
  /// Computed at first use.
  static const SheenAlbedo& table();

  static constexpr float kMinRoughness = 0.05f; ///< below it only grazing light would see the lobe

  /// The share of light from that angle that the lobe reflects, at a sheen of 1 and before `scale`.
  float operator()(float roughness, float cosine) const;
  /// By which the lobe is multiplied lest it reflect more than all; 1 where it does not.
  float scale(float roughness) const;

  SheenAlbedo();

private:
  GridTable<2> albedo_;
  GridTable<1> greatest_;
};

/// The lobe at a sheen of 1, in 1/sr; both directions above the surface.
inline float sheen_lobe(vec3 wo, vec3 wi, float roughness) {
  const vec3 h = wo + wi;
  const float sin2 = (sqr(h.x) + sqr(h.y)) / length_squared(h), inverse = 1 / roughness;
  const float d = (2 + inverse) * (0.5f * kInvPi) * std::pow(std::min(sin2, 1.0f), 0.5f * inverse);
  return d / (4 * (wo.z + wi.z - wo.z * wi.z));
}

/// See above. Sampled as a mixture of a uniform lobe, for the sheen (as the paper does), and of the
/// cosine.
struct Sheen {
  Spectrum diffuse{0.5f}; ///< of the base
  Spectrum sheen{0.5f};
  float roughness = 0.3f; ///< r, from SheenAlbedo::kMinRoughness to 1
  const SheenAlbedo* albedo_table = &SheenAlbedo::table();

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    const float scale = albedo_table->scale(roughness), albedo_o = lobe_albedo(wo.z);
    const float left = 1 - max_component(sheen) * std::max(albedo_o, lobe_albedo(wi.z));
    const float p = sheen_probability(albedo_o), cosine_pdf = wi.z * kInvPi;
    return {diffuse * (left * cosine_pdf) + sheen * (scale * sheen_lobe(wo, wi, roughness) * wi.z),
            p * kUniformHemispherePdf + (1 - p) * cosine_pdf};
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    const bool uniform = u.lobe < sheen_probability(lobe_albedo(std::abs(wo.z)));
    const vec3 wi =
        to_side_of(wo, uniform ? uniform_cone_from_disc(u.disc, 1) : cosine_hemisphere_from_disc(u.disc));
    const BsdfEval e = eval_pdf(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::diffuse | BsdfFlags::glossy; }
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const {
    const float typical = lobe_albedo(0.5f);
    return diffuse * (1 - max_component(sheen) * typical) + sheen * typical;
  }

private:
  float lobe_albedo(float cosine) const {
    return std::min((*albedo_table)(roughness, cosine) * albedo_table->scale(roughness), 1.0f);
  }
  /// Of the uniform lobe, by what each reflects of light from wo.
  float sheen_probability(float lobe) const {
    const float top = luminance(sheen) * lobe, base = luminance(diffuse) * (1 - max_component(sheen) * lobe);
    return top > 0 ? top / (top + base) : 0;
  }
};

} // namespace candela
