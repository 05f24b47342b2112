#pragma once

#include "bsdf/bsdf_sample.h"
#include "bsdf/fresnel.h"
#include "core/color.h"

#include <array>

namespace candela {

/// exp(-x) I0(x) of the modified Bessel function of the first kind, x >= 0: its power series, or its
/// asymptotic series (Abramowitz & Stegun, eqs. 9.6.12 and 9.7.1). Relative error 2e-6.
inline float scaled_bessel_i0(float x) {
  if (x > 12) {
    const float y = 1 / (8 * x);
    return (1 + y * (1 + y * (4.5f + y * (37.5f + y * (459.375f + y * 7441.875f))))) / std::sqrt(2 * kPi * x);
  }
  const float quarter = 0.25f * sqr(x);
  float term = 1, sum = 1;
  for (float k = 1; term > 1e-8f * sum; ++k) sum += term *= quarter / sqr(k);
  return std::exp(-x) * sum;
}

/// 1 - exp(-x), x > 0; for x > 1 without the slower expm1.
inline float one_minus_exp(float x) { return x > 1 ? 1 - std::exp(-x) : -std::expm1(-x); }

/// Density over longitudinal angles, by sine and cosine on both sides: the integral of M cos(theta_i) d
/// theta_i is 1, its variance v (d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model"),
///     M = exp(-sin_i sin_o / v) I0(cos_i cos_o / v) / (2 v sinh(1 / v)),
/// with the large exponents taken out: their sum is (cos(theta_i + theta_o) - 1) / v.
struct HairLongitudinal {
  float inverse_v = 0, scale = 0;

  HairLongitudinal() = default;
  explicit HairLongitudinal(float v) : inverse_v(1 / v), scale(inverse_v / one_minus_exp(2 * inverse_v)) {}
  float density(float cos_i, float sin_i, float cos_o, float sin_o) const {
    const float distance2 = sqr(cos_i - cos_o) + sqr(sin_i + sin_o); // 2 - 2 cos(theta_i + theta_o)
    return scale * std::exp(-0.5f * distance2 * inverse_v) * scaled_bessel_i0(cos_i * cos_o * inverse_v);
  }
};

/// Logistic distribution of scale s, cut off at +-pi: Chiang et al. 2016. Its distribution function is
/// (1 + tanh(x / 2s) / tanh(pi / 2s)) / 2.
struct HairAzimuthal {
  float s = 1, limit = 1; ///< limit: tanh(pi / 2s)

  HairAzimuthal() = default;
  explicit HairAzimuthal(float scale) : s(scale), limit(std::tanh(0.5f * kPi / scale)) {}
  /// Of any angle, which is taken modulo 2 pi.
  float density(float angle) const {
    angle -= 2 * kPi * std::nearbyint(angle * (0.5f * kInvPi));
    const float x = std::exp(-std::abs(angle) / s);
    return x / (s * sqr(1 + x) * limit);
  }
  float sample(float u) const { return std::clamp(2 * s * std::atanh((2 * u - 1) * limit), -kPi, kPi); }
};

/// The lobes of a hair (bsdf/hair.h) for one wo.
class HairLobes {
public:
  static constexpr std::size_t kLobes = 4; ///< R, TT, TRT, and the rest

  HairLobes(vec3 wo, Spectrum sigma_a, float beta_m, float beta_n, float tilt, float ior, float h) {
    cos_o_ = std::sqrt(sqr(wo.y) + sqr(wo.z));
    const float sin_o = std::clamp(wo.x, -1.0f, 1.0f);
    if (cos_o_ > 0) axis_ = vec2(wo.y, wo.z) / cos_o_;
    attenuate(sigma_a, ior, h);

    // Roughness that is about linear to the eye, as a variance and as a scale (fits of Chiang et al.;
    // paths through the fibre are narrower, those with internal reflections wider).
    const float m = std::max(beta_m, 0.0f);
    const float v = sqr(0.726f * m + 0.812f * sqr(m) + 3.7f * power(m, 20));
    longitudinal_ = {HairLongitudinal(v), HairLongitudinal(0.25f * v), HairLongitudinal(4 * v)};
    azimuthal_ =
        HairAzimuthal(kSqrtPiOver8 * (0.265f * beta_n + 1.194f * sqr(beta_n) + 5.372f * power(beta_n, 22)));

    // The scales turn wo's angle by -2 tilt for R, by tilt for TT and by 4 tilt for TRT (Marschner, Jensen,
    // Cammarano, Worley & Hanrahan 2003, "Light Scattering from Human Hair Fibers"). A cone that is turned
    // beyond the fibre's direction comes out on the other side.
    for (std::size_t p = 0; p < kLobes; ++p) {
      constexpr std::array<float, kLobes> kTurns{-2, 1, 4, 0};
      const float s = std::sin(kTurns[p] * tilt), c = std::cos(kTurns[p] * tilt);
      sin_cone_[p] = sin_o * c + cos_o_ * s;
      cos_cone_[p] = std::abs(cos_o_ * c - sin_o * s);
    }
  }

  BsdfEval eval_pdf(vec3 wi) const {
    const float cos_i = std::sqrt(sqr(wi.y) + sqr(wi.z));
    const float azimuth = std::atan2(axis_.x * wi.z - axis_.y * wi.y, axis_.x * wi.y + axis_.y * wi.z);
    BsdfEval e{Spectrum(0), 0};
    for (std::size_t p = 0; p < kLobes; ++p) {
      if (!(choice_[p] > 0)) continue;
      float density = longitudinal(p).density(cos_i, wi.x, cos_cone_[p], sin_cone_[p]);
      density *= p < kLobes - 1 ? azimuthal_.density(azimuth - turn_[p]) : 0.5f * kInvPi;
      e.f_cos += attenuation_[p] * density;
      e.pdf += choice_[p] * density;
    }
    return e;
  }

  /// Nothing where all is absorbed.
  std::optional<vec3> sample(BsdfU u) const {
    std::size_t p = 0;
    while (p + 1 < kLobes && !(u.lobe < choice_[p])) u.lobe -= choice_[p++];
    while (p > 0 && !(choice_[p] > 0)) --p; // rounding
    if (!(choice_[p] > 0)) return std::nullopt;
    const float rest = std::clamp(u.lobe / choice_[p], 0.0f, kOneMinusEpsilon);

    // Around the cone's direction (sin_cone, cos_cone): d'Eon, Marschner & Hanika 2013, "Importance Sampling
    // for Physically-Based Hair Fiber Models".
    const HairLongitudinal& m = longitudinal(p);
    const float radius2 = std::min(glm::dot(u.disc, u.disc), 1.0f);
    const float off = std::min(-std::log(radius2 + (1 - radius2) * std::exp(-2 * m.inverse_v)) / m.inverse_v,
                               2.0f); // 1 - cos
    const float sine = safe_sqrt(off * (2 - off));
    const float cos_turn = radius2 > 0 ? u.disc.x / std::sqrt(radius2) : 1;
    const float sin_i = std::clamp(-(1 - off) * sin_cone_[p] + sine * cos_turn * cos_cone_[p], -1.0f, 1.0f);
    const float cos_i = safe_sqrt(1 - sqr(sin_i));

    const float azimuth = p < kLobes - 1 ? turn_[p] + azimuthal_.sample(rest) : 2 * kPi * rest;
    const float c = std::cos(azimuth), s = std::sin(azimuth);
    return vec3(sin_i, cos_i * (axis_.x * c - axis_.y * s), cos_i * (axis_.y * c + axis_.x * s));
  }

  /// A_p, the share of light that takes path p.
  const std::array<Spectrum, kLobes>& attenuation() const { return attenuation_; }

private:
  static constexpr float kSqrtPiOver8 = 0.62665706865775f;

  /// M_p: the paths with more reflections have that of TRT.
  const HairLongitudinal& longitudinal(std::size_t p) const {
    return longitudinal_[std::min(p, longitudinal_.size() - 1)];
  }

  static float power(float x, int n) {
    float y = 1;
    for (; n > 0; n >>= 1, x *= x) y *= (n & 1) != 0 ? x : 1;
    return y;
  }

  /// A_p as d'Eon et al. 2011, the rest of the series summed as Chiang et al. do, the azimuth of each path,
  /// and the probabilities of their choice.
  void attenuate(Spectrum sigma_a, float ior, float h) {
    const float sin_gamma = std::clamp(h, -1.0f, 1.0f), cos_gamma = safe_sqrt(1 - sqr(sin_gamma));
    // Inside, with the projected index sqrt(ior^2 - sin^2) / cos (Marschner et al. 2003). The
    // difference without its cancellation; an ior of 1 has nothing under the root along the fibre.
    const float under_root = std::sqrt(std::max((ior - 1) * (ior + 1) + sqr(cos_o_), 1e-12f));
    const float sin_inside = std::clamp(sin_gamma * cos_o_ / under_root, -1.0f, 1.0f);
    const float path = 2 * safe_sqrt(1 - sqr(sin_inside)) * ior / under_root; // 2 cos gamma_t / cos theta_t
    const Spectrum passes = glm::exp(-sigma_a * path);
    const float f = fresnel_dielectric(cos_o_ * cos_gamma, ior);
    attenuation_[0] = Spectrum(f);
    attenuation_[1] = sqr(1 - f) * passes;
    attenuation_[2] = attenuation_[1] * passes * f;
    attenuation_[3] = attenuation_[2] * passes * f / glm::max(Spectrum(1) - passes * f, Spectrum(1e-12f));

    const float outer = std::asin(sin_gamma), inner = std::asin(sin_inside);
    for (std::size_t p = 0; p + 1 < kLobes; ++p) {
      const auto bounces = static_cast<float>(p);
      turn_[p] = 2 * bounces * inner - 2 * outer + bounces * kPi;
    }
    float total = 0;
    for (std::size_t p = 0; p < kLobes; ++p) total += choice_[p] = luminance(attenuation_[p]);
    for (float& share : choice_) share = total > 0 ? share / total : 0;
  }

  float cos_o_;     ///< of the angle to the plane across the fibre
  vec2 axis_{0, 1}; ///< wo's direction in that plane
  HairAzimuthal azimuthal_;
  std::array<HairLongitudinal, kLobes - 1> longitudinal_;
  std::array<Spectrum, kLobes> attenuation_;
  std::array<float, kLobes> choice_, sin_cone_, cos_cone_;
  std::array<float, kLobes - 1> turn_; ///< of the azimuth, from wo's
};

} // namespace candela
