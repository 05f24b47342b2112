#pragma once
// Maps of the unit square [0, 1)^2 to the domains that rendering samples, each with its density. They keep
// areas and are continuous but for seams, so that well-distributed points stay well distributed.

#include "core/math.h"

#include <span>

namespace candela {

/// Unit disc, density kInvPi per unit area. Concentric map (Shirley & Chiu 1997, "A Low Distortion Map
/// Between Disk and Square").
inline vec2 sample_uniform_disc(vec2 u) {
  vec2 p = 2.0f * u - 1.0f;
  bool wide = std::abs(p.x) > std::abs(p.y);
  float radius = select(wide, p.x, p.y);
  // Sine and cosine of r quarter turns, |r| <= 1/2, by minimax polynomials (error 4e-9): the same bits on
  // every machine, where libm picks variants with fused multiply-add at run time, and quicker.
  float r = 0.5f * (select(wide, p.y, p.x) / (radius == 0 ? 1 : radius));
  float r2 = r * r;
  float s = r * (1.5707963217f + r2 * (-0.6459634602f + r2 * (0.0796800328f + r2 * -0.0046016579f)));
  float c = 1 + r2 * (-1.2337005426f + r2 * (0.2536692260f + r2 * (-0.0208601651f + r2 * 0.0009037666f)));
  return radius * vec2(select(wide, c, s), select(wide, s, c));
}
/// Of each point, in place, side by side in the vector unit: 3 % of a Cornell sample's time less.
void sample_uniform_discs(std::span<vec2> u);
inline constexpr float kUniformDiscPdf = kInvPi;

/// Cap of the unit sphere about +z with cos(theta) > 1 - one_minus_cos_max, uniform in solid angle. It takes
/// 1 - cos(theta_max), in (0, 2], because a cosine has no digits left for a small angle. Lambert's azimuthal
/// equal-area projection of a point `d` of the unit disc.
inline vec3 uniform_cone_from_disc(vec2 d, float one_minus_cos_max) {
  float one_minus_cos = std::min(glm::dot(d, d), 1.0f) * one_minus_cos_max;
  return vec3(d * safe_sqrt(one_minus_cos_max * (2 - one_minus_cos)), 1 - one_minus_cos);
}
/// By the concentric disc.
inline vec3 sample_uniform_cone(vec2 u, float one_minus_cos_max) {
  return uniform_cone_from_disc(sample_uniform_disc(u), one_minus_cos_max);
}
/// In 1/sr.
inline float uniform_cone_pdf(float one_minus_cos_max) { return 1 / (2 * kPi * one_minus_cos_max); }
/// 1 - cos(theta) from sin^2(theta) without cancellation, theta in [0, pi/2].
inline float one_minus_cos_from_sin2(float sin2_theta) {
  return sin2_theta / (1 + safe_sqrt(1 - sin2_theta));
}

/// Unit sphere, uniform in solid angle.
inline vec3 sample_uniform_sphere(vec2 u) { return sample_uniform_cone(u, 2); }
inline constexpr float kUniformSpherePdf = 0.25f * kInvPi; ///< 1/sr

/// Upper (+z) half of the unit sphere, uniform in solid angle.
inline vec3 sample_uniform_hemisphere(vec2 u) { return sample_uniform_cone(u, 1); }
inline constexpr float kUniformHemispherePdf = 0.5f * kInvPi; ///< 1/sr

/// Upper half of the unit sphere in proportion to cos(theta), from a point of the unit disc (Malley's
/// method). Its edge gives cos(theta) = 0, so a pdf of 0.
inline vec3 cosine_hemisphere_from_disc(vec2 d) { return {d, safe_sqrt(1 - glm::dot(d, d))}; }
/// By the concentric disc.
inline vec3 sample_cosine_hemisphere(vec2 u) { return cosine_hemisphere_from_disc(sample_uniform_disc(u)); }
/// In 1/sr; 0 below the horizon.
inline float cosine_hemisphere_pdf(float cos_theta) { return std::max(cos_theta, 0.0f) * kInvPi; }

/// [0, 1), density linear from a at 0 to b at 1 but for a factor; a, b >= 0, not both 0 (pbrt-v4, section
/// A.5.1).
inline float sample_linear(float u, float a, float b) {
  const float divisor = a + std::sqrt(std::max(a * a + u * (b * b - a * a), 0.0f));
  return divisor > 0 ? std::min(u * (a + b) / divisor, kOneMinusEpsilon) : u;
}
/// [0, 1), density linear from a at 0 to b at 1/2 and on to c at 1 but for a factor.
inline float sample_linear(float u, float a, float b, float c) {
  const float left = a + b, right = b + c, share = u * (left + right);
  if (share < left) return 0.5f * sample_linear(share / left, a, b);
  if (!(right > 0)) return u;
  return std::min(0.5f + 0.5f * sample_linear(std::min((share - left) / right, kOneMinusEpsilon), b, c),
                  kOneMinusEpsilon);
}

/// Barycentric coordinates, uniform over a triangle's area; density per unit area is 1/area (Heitz 2019, "A
/// Low-Distortion Map Between Triangle and Square").
inline vec3 sample_uniform_triangle(vec2 u) {
  float b0, b1;
  if (u.y > u.x) {
    b0 = 0.5f * u.x;
    b1 = u.y - b0;
  } else {
    b1 = 0.5f * u.y;
    b0 = u.x - b1;
  }
  return {b0, b1, 1 - b0 - b1};
}

/// Box filter: offset in [-radius, radius), uniform.
inline float sample_box(float u, float radius) { return (2 * u - 1) * radius; }

/// Inverse error function for |x| < 1 (Giles 2010, "Approximating the erfinv Function", single precision),
/// relative error below 1e-6.
inline float erf_inv(float x) {
  float w = -std::log((1 - x) * (1 + x));
  float p;
  if (w < 5) {
    w -= 2.5f;
    p = 2.81022636e-08f;
    for (float c : {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 0.00021858087f, -0.00125372503f,
                    -0.00417768164f, 0.246640727f, 1.50140941f})
      p = c + p * w;
  } else {
    w = std::sqrt(w) - 3;
    p = -0.000200214257f;
    for (float c : {0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f, -0.0076224613f,
                    0.00943887047f, 1.00167406f, 2.83297682f})
      p = c + p * w;
  }
  return p * x;
}

/// Normal distribution about 0, cut off at +-radius and renormalised: a Gaussian reconstruction filter that
/// is importance-sampled per axis, so that every sample weighs the same.
class TruncatedGaussian {
public:
  TruncatedGaussian(float sigma, float radius)
      : sigma_(sigma), radius_(radius), mass_(std::erf(radius / (sigma * std::numbers::sqrt2_v<float>))) {}

  float sample(float u) const {
    float x =
        std::numbers::sqrt2_v<float> * sigma_ * erf_inv((2 * u - 1) * std::min(mass_, kOneMinusEpsilon));
    return std::clamp(x, -radius_, radius_);
  }
  /// Per unit length.
  float pdf(float x) const {
    if (std::abs(x) > radius_) return 0;
    return std::exp(-0.5f * sqr(x / sigma_)) / (sigma_ * mass_ * std::sqrt(2 * kPi));
  }

private:
  float sigma_, radius_;
  float mass_; ///< of the untruncated distribution within the radius
};

} // namespace candela
