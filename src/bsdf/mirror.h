#pragma once

#include "bsdf/bsdf_sample.h"
#include "core/color.h"

namespace candela {

/// Ideal mirror with an additional Lambertian lobe if `diffuse` is not 0; the lobe is selected by luminance.
struct Mirror {
  Spectrum specular{0.9f};
  Spectrum diffuse{0};

  Spectrum eval(vec3 wo, vec3 wi) const {
    return same_hemisphere(wo, wi) ? diffuse * (std::abs(wi.z) * kInvPi) : Spectrum(0);
  }
  float pdf(vec3 wo, vec3 wi) const {
    return same_hemisphere(wo, wi) ? (1 - delta_probability(wo)) * std::abs(wi.z) * kInvPi : 0;
  }
  BsdfEval eval_pdf(vec3 wo, vec3 wi) const { return {eval(wo, wi), pdf(wo, wi)}; }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    float p = delta_probability(wo);
    if (u.lobe < p) {
      if (is_black(specular)) return std::nullopt;
      return BsdfSample{reflect_about_normal(wo), specular / p, p, true};
    }
    vec3 wi = to_side_of(wo, cosine_hemisphere_from_disc(u.disc));
    float density = pdf(wo, wi);
    if (!(density > 0)) return std::nullopt;
    return BsdfSample{wi, diffuse / (1 - p), density, false};
  }
  /// 1 where there is no diffuse lobe, even if all is black.
  float delta_probability(vec3) const {
    float d = luminance(diffuse);
    return d > 0 ? luminance(specular) / (luminance(specular) + d) : 1;
  }
  BsdfFlags flags() const {
    const BsdfFlags beside = luminance(diffuse) > 0 ? BsdfFlags::diffuse : BsdfFlags::none;
    return BsdfFlags::reflection | BsdfFlags::delta | beside;
  }
  /// Of the Lambertian lobe: no light sample finds the other.
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const { return specular + diffuse; }
};

} // namespace candela
