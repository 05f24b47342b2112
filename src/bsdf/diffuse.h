#pragma once

#include "bsdf/bsdf_sample.h"

namespace candela {

/// Lambertian reflection: f = reflectance / pi.
struct Diffuse {
  Spectrum reflectance{0.5f};

  Spectrum eval(vec3 wo, vec3 wi) const {
    return same_hemisphere(wo, wi) ? reflectance * (std::abs(wi.z) * kInvPi) : Spectrum(0);
  }
  float pdf(vec3 wo, vec3 wi) const { return same_hemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0; }
  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    float cosine_pdf = pdf(wo, wi);
    return {reflectance * cosine_pdf, cosine_pdf};
  }
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    vec3 wi = to_side_of(wo, cosine_hemisphere_from_disc(u.disc));
    float cosine_pdf = pdf(wo, wi);
    if (!(cosine_pdf > 0)) return std::nullopt;
    return BsdfSample{wi, reflectance, cosine_pdf, false};
  }
  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::diffuse; }
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const { return reflectance; }
};

} // namespace candela
