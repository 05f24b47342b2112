#pragma once

#include "bsdf/bsdf_sample.h"
#include "core/color.h"

namespace candela {

/// Blinn's lobe about the half vector (Blinn 1977, "Models of Light Reflection for Computer Synthesized
/// Pictures") in place of Phong's, normalised as Lafortune & Willems 1994 do that:
///     f = diffuse / pi + specular N cos(theta_h)^n,  N = (n + 2) (n + 4) / (8 pi (n + 2^(-n / 2))),
/// so that the lobe reflects `specular` of what falls on it along the normal, less from elsewhere.
/// Reciprocal, and it reflects no more than it gets where diffuse + specular <= 1. Sampled as a mixture of
/// its lobes (their pdf is the mixture's) that are chosen by luminance; the glossy lobe's directions below
/// the surface fail.
struct Blinn {
  Spectrum diffuse{0.5f};
  Spectrum specular{0};
  float exponent = 160; ///< n >= 0; some 4 times that of Phong's for a highlight as wide

  Spectrum eval(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).f_cos; }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    const float cos_i = std::abs(wi.z), p = specular_probability();
    const vec3 h(wo.x + wi.x, wo.y + wi.y, std::abs(wo.z) + cos_i);
    // 1 / cos^2 = 1 + tan^2, by the tangent for the digits of high powers.
    const float tan2 = (sqr(h.x) + sqr(h.y)) / sqr(h.z);
    const float power = std::exp(-0.5f * exponent * std::log1p(tan2));
    // Normals have a density of (n + 1) / (2 pi) cos^n; mirrored, 1 / (4 cos_d) of it, with 2 cos_d = |h|.
    const float density = (exponent + 1) * (0.25f * kInvPi) * power / glm::length(h);
    return {(diffuse * kInvPi + specular * (norm() * power)) * cos_i, (1 - p) * cos_i * kInvPi + p * density};
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    vec3 wi;
    if (u.lobe < specular_probability()) {
      // cos(theta_h) = (1 - v)^(1 / (n + 1)) with v = |disc point|^2 uniform.
      const float v = std::min(glm::dot(u.disc, u.disc), kOneMinusEpsilon);
      const float one_minus_cos = -std::expm1(std::log1p(-v) / (exponent + 1));
      const float scale = v > 0 ? safe_sqrt(one_minus_cos * (2 - one_minus_cos) / v) : 0;
      const vec3 h(u.disc * scale, 1 - one_minus_cos), w = to_side_of({0, 0, 1}, wo);
      wi = glm::normalize(2 * glm::dot(w, h) * h - w);
      if (!(wi.z > 0)) return std::nullopt;
      wi = to_side_of(wo, wi);
    } else {
      wi = to_side_of(wo, cosine_hemisphere_from_disc(u.disc));
    }
    const BsdfEval e = eval_pdf(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::diffuse | BsdfFlags::glossy; }
  /// cos(delta / 2)^n is about (1 + n / 8 (1 - cos delta))^-2 near the axis.
  LobeProxy lobe_proxy(vec3) const {
    return {(luminance(diffuse) + 0.02f * luminance(specular)) * kInvPi, luminance(specular) * norm(),
            0.125f * exponent};
  }
  Spectrum albedo() const { return diffuse + specular; }

  /// N, 1/sr.
  float norm() const {
    return (exponent + 2) * (exponent + 4) / (8 * kPi * (exponent + std::exp2(-0.5f * exponent)));
  }
  /// Of the glossy lobe's being sampled.
  float specular_probability() const {
    const float d = luminance(diffuse), s = luminance(specular);
    return s > 0 ? s / (d + s) : 0;
  }
};

} // namespace candela
