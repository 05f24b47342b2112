#pragma once

#include "bsdf/bsdf_sample.h"
#include "core/basis.h"
#include "core/color.h"

namespace candela {

/// The modified Phong model of Lafortune & Willems 1994, "Using the Modified Phong Reflectance Model for
/// Physically Based Rendering": reciprocal, and energy conserving if diffuse + specular <= 1.
///     f = diffuse / pi + specular (n + 2) / (2 pi) max(0, cos alpha)^n,
/// with alpha between wi and the mirror image of wo. Sampled as a mixture of its lobes (their pdf is the
/// mixture's) that are chosen by luminance; the glossy lobe's directions below the surface fail.
struct Phong {
  Spectrum diffuse{0.5f};
  Spectrum specular{0};
  float exponent = 40; ///< n >= 0

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    float cos_alpha = std::max(glm::dot(reflect_about_normal(wo), wi), 0.0f);
    float lobe =
        cos_alpha > 0 ? std::pow(std::min(cos_alpha, 1.0f), exponent) * (0.5f * kInvPi) : 0; // 0^0 is 0 here
    float cos_theta_i = std::abs(wi.z);
    float p = specular_probability();
    Spectrum f = diffuse * kInvPi + specular * ((exponent + 2) * lobe);
    return {f * cos_theta_i, (1 - p) * cos_theta_i * kInvPi + p * (exponent + 1) * lobe};
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    vec3 wi;
    if (u.lobe < specular_probability()) {
      // cos alpha = (1 - v)^(1 / (n + 1)) with v = |disc point|^2 uniform.
      float v = std::min(glm::dot(u.disc, u.disc), kOneMinusEpsilon);
      float one_minus_cos = -std::expm1(std::log1p(-v) / (exponent + 1));
      float scale = v > 0 ? safe_sqrt(one_minus_cos * (2 - one_minus_cos) / v) : 0;
      wi = Basis::from_normal(reflect_about_normal(wo)).to_world({u.disc * scale, 1 - one_minus_cos});
    } else {
      wi = to_side_of(wo, cosine_hemisphere_from_disc(u.disc));
    }
    BsdfEval e = eval_pdf(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::diffuse | BsdfFlags::glossy; }
  /// cos^n is about (1 + n / 2 (1 - cos))^-2 near the axis.
  LobeProxy lobe_proxy(vec3) const {
    return {luminance(diffuse) * kInvPi, luminance(specular) * (exponent + 2) * (0.5f * kInvPi),
            0.5f * exponent};
  }
  Spectrum albedo() const { return diffuse + specular; }

  /// Of the glossy lobe's being sampled.
  float specular_probability() const {
    float d = luminance(diffuse), s = luminance(specular);
    return s > 0 ? s / (d + s) : 0;
  }
};

} // namespace candela
