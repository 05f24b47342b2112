#pragma once

#include "bsdf/bsdf_sample.h"

namespace candela {

enum class OrenNayarModel : int {
  eon,         ///< Fujii's, and what it loses is given back
  fujii,       ///< Fujii's "improved" model, scaled to reflect no more than it gets
  qualitative, ///< Oren & Nayar 1994, "Generalization of Lambert's Reflectance Model", the qualitative model
};

/// Rough matte surfaces of V-cavities with Lambertian walls. With
///     s = dot(wo, wi) - cos_o cos_i,  t = max(cos_o, cos_i) where s > 0,
/// f is reflectance / pi times
///     A + B max(s, 0) / t                    of Oren & Nayar; A, B are functions of sigma,
///     A_F (1 + r s / t), t = 1 where s < 0   of Fujii,
///     the same + multiple scattering         of Portsmouth, Kutz & Hill 2025, "EON: A practical
///                                            energy-preserving rough diffuse BRDF".
/// sigma, the standard deviation of the walls' slope angle, is the roughness in radians, as MaterialX has it.
///
/// All are reciprocal. EON loses nothing at a reflectance of 1. The qualitative model has no such bound: with
/// a reflectance of 1 it gives back up to 1.6 % too much in grazing directions.
///
/// Sampled as EON's authors do for theirs: by a uniform lobe and by a linearly transformed cosine that is
/// clipped to the upper hemisphere. The others' shape is much the same.
struct OrenNayar {
  Spectrum reflectance{0.5f};
  float roughness = 0.5f; ///< in [0, 1]; 0: Lambertian
  OrenNayarModel model = OrenNayarModel::eon;

  Spectrum eval(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return Spectrum(0);
    return value(up(wo), up(wi)) * std::abs(wi.z);
  }
  float pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return 0;
    return Sampling(up(wo), roughness).pdf(up(wi));
  }
  BsdfEval eval_pdf(vec3 wo, vec3 wi) const { return {eval(wo, wi), pdf(wo, wi)}; }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    const vec3 w = up(wo);
    const Sampling sampling(w, roughness);
    const vec3 wi = sampling.sample(u);
    if (!(wi.z > 0)) return std::nullopt;
    const float density = sampling.pdf(wi);
    if (!(density > 0)) return std::nullopt;
    return BsdfSample{to_side_of(wo, wi), value(w, wi) * (wi.z / density), density, false};
  }

  float delta_probability(vec3) const { return 0; }
  BsdfFlags flags() const { return BsdfFlags::reflection | BsdfFlags::diffuse | BsdfFlags::glossy; }
  LobeProxy lobe_proxy(vec3) const { return {}; }
  Spectrum albedo() const { return reflectance; }

  /// Share of light from a direction that Fujii's model scatters at a reflectance of 1: it is
  /// A_F (1 + r G / pi).
  static float fujii_albedo(float sine, float cosine, float roughness) {
    return fujii_a(roughness) * (1 + roughness * g_over_pi(sine, cosine));
  }

private:
  static constexpr float kC1 = 0.5f - 2 / (3 * kPi);          ///< G / pi of grazing light
  static constexpr float kC2 = 2.0f / 3.0f - 28 / (15 * kPi); ///< mean of G / pi, weighted by the cosine

  static vec3 up(vec3 w) { return {w.x, w.y, std::abs(w.z)}; }
  static float sine(vec3 w) { return std::sqrt(sqr(w.x) + sqr(w.y)); }

  static float fujii_a(float r) { return 1 / (1 + kC1 * r); }
  /// G = sin (theta - sin cos) + 2/3 (tan (1 - sin^3) - sin), the second term without differences.
  static float g_over_pi(float sine, float cosine) {
    const float theta = std::atan2(sine, cosine);
    const float tan_one_minus_sin3 = sine * cosine * (1 + sine + sqr(sine)) / (1 + sine);
    return kInvPi * (sine * (theta - sine * cosine) + (2.0f / 3.0f) * (tan_one_minus_sin3 - sine));
  }

  /// f in 1/sr; both above the surface.
  Spectrum value(vec3 wo, vec3 wi) const {
    const float s = wo.x * wi.x + wo.y * wi.y, larger = std::max(wo.z, wi.z), r = roughness;
    if (model == OrenNayarModel::qualitative) {
      const float sigma2 = sqr(r);
      const float a = 1 - 0.5f * sigma2 / (sigma2 + 0.33f), b = 0.45f * sigma2 / (sigma2 + 0.09f);
      return reflectance * (kInvPi * (a + (s > 0 ? b * s / larger : 0)));
    }
    const float a = fujii_a(r);
    // s is at least -1, and r at most 1.
    const Spectrum once = reflectance * (kInvPi * a * std::max(1 + r * (s > 0 ? s / larger : s), 0.0f));
    if (model == OrenNayarModel::fujii) return once;
    // What is lost of light from a direction is A_F r (c1 - G / pi), on average A_F r (c1 - c2).
    const float mean = a * (1 + kC2 * r);
    const Spectrum gain = reflectance * reflectance * mean / (Spectrum(1) - reflectance * (1 - mean));
    const float lost_o = std::max(kC1 - g_over_pi(sine(wo), wo.z), 0.0f);
    const float lost_i = std::max(kC1 - g_over_pi(sine(wi), wi.z), 0.0f);
    return once + gain * (kInvPi * a * r * lost_o * lost_i / (kC1 - kC2));
  }

  /// As Portsmouth et al. do it: a uniform lobe, and "clipped linearly transformed cosines". In a frame whose
  /// x is below wo, M = (a 0 b; 0 c 0; d 0 1) maps cosine-distributed directions to about the lobe; those
  /// that it would map below the surface are left out, half an ellipse of the disc. The numbers are the fits
  /// that they give for M and for the uniform lobe; they decide the noise alone.
  class Sampling {
  public:
    Sampling(vec3 wo, float r) {
      const float mu = wo.z, length = sine(wo);
      axis_ = length > 0 ? vec2(wo.x, wo.y) / length : vec2(1, 0);
      a_ = 1 + r * (0.303392f + mu * (-0.518982f + 0.111709f * mu) + r * (-0.276266f + 0.335918f * mu));
      b_ = r * (-1.16407f + 1.15859f * mu + r * (0.150815f - 0.150105f * mu)) / (mu * mu * mu - 1.43545f);
      c_ = 1 + r * (0.20013f + mu * (-0.506373f + 0.261777f * mu));
      d_ = r * (0.540852f + mu * (-1.01625f + 0.475392f * mu)) / (-1.0743f + mu * (0.0725628f + mu));
      kept_ = 0.5f * (1 + 1 / std::sqrt(1 + sqr(d_)));
      uniform_ =
          std::clamp(std::pow(r, 0.1f) * (0.162925f + mu * (-0.372058f + mu * (0.538233f - 0.290822f * mu))),
                     0.0f, 1.0f);
    }

    vec3 sample(BsdfU u) const {
      if (u.lobe < uniform_) return uniform_cone_from_disc(u.disc, 1);
      // Each chord of the disc along x is shortened to the part that is kept.
      const float y = u.disc.y, chord = safe_sqrt(1 - sqr(y));
      const float x = side() * (chord * (1 - kept_) + u.disc.x * kept_);
      const float z = safe_sqrt(1 - sqr(x) - sqr(y));
      const vec3 local(a_ * x + b_ * z, c_ * y, d_ * x + z);
      return glm::normalize(
          vec3(local.x * axis_.x - local.y * axis_.y, local.x * axis_.y + local.y * axis_.x, local.z));
    }

    float pdf(vec3 wi) const {
      const float x = wi.x * axis_.x + wi.y * axis_.y, y = wi.y * axis_.x - wi.x * axis_.y;
      // M's adjugate of wi: its determinant times the inverse.
      const float minor = a_ - b_ * d_, determinant = c_ * minor;
      const vec3 before(c_ * (x - b_ * wi.z), minor * y, c_ * (a_ * wi.z - d_ * x));
      const float jacobian = sqr(determinant / length_squared(before));
      return uniform_ * kUniformHemispherePdf +
             (1 - uniform_) * jacobian * std::max(before.z, 0.0f) * kInvPi / kept_;
    }

  private:
    /// Of x, on which nothing is clipped.
    float side() const { return d_ < 0 ? -1.0f : 1.0f; }

    vec2 axis_;
    float a_, b_, c_, d_;
    float kept_;    ///< share of the disc
    float uniform_; ///< probability of the uniform lobe
  };
};

} // namespace candela
