#include "bsdf/microfacets.h"

namespace candela {

namespace {

constexpr float kSqrtPi = 1.7724538509055160f;

/// The x slope of facets of alpha = 1 seen from (sin, 0, cos), cot = cos / sin > 0, at u in (0, 1).
float visible_slope(float cot, float u) {
  // In x = erf(slope), where the function is nearly straight. Slopes above cot face away.
  const float tan = 1 / cot, most = std::erf(cot);
  float wanted = u * (1 + most + tan * std::exp(-sqr(cot)) / kSqrtPi);
  float low = -kOneMinusEpsilon, high = std::min(most, kOneMinusEpsilon);
  float x = std::clamp(most - (most + 1) * std::erf(std::sqrt(-std::log(u))), low, high); // Jakob's beginning
  for (int i = 0; i < 20; ++i) {
    const float slope = erf_inv(x);
    const float miss = 1 + x + tan * std::exp(-sqr(slope)) / kSqrtPi - wanted;
    if (std::abs(miss) < 1e-6f * wanted) break;
    (miss > 0 ? high : low) = x;
    float next = x - miss / (1 - slope * tan);
    if (!(next > low && next < high)) next = 0.5f * (low + high);
    if (next == x) break;
    x = next;
  }
  return erf_inv(x);
}

/// ln Gamma(z) for z >= 1, to 1e-6: Stirling's series, three steps up. (std::lgamma writes a global
/// variable.)
double log_gamma(double z) {
  const double y = z + 3, inverse = 1 / y;
  return (y - 0.5) * std::log(y) - y + 0.91893853320467274 + inverse * (1.0 / 12 - inverse * inverse / 360) -
         std::log(z * (z + 1) * (z + 2));
}

} // namespace

float Microfacets::g2_transmission(vec3 wo, vec3 wi) const {
  const double a = 1 + static_cast<double>(lambda(wo)), b = 1 + static_cast<double>(lambda(wi));
  return static_cast<float>(std::exp(log_gamma(a) + log_gamma(b) - log_gamma(a + b)));
}

vec3 Microfacets::beckmann_visible_normal(vec3 w, vec2 disc) const {
  const vec3 stretched(alpha_x * w.x, alpha_y * w.y, w.z);
  const float across = std::sqrt(sqr(stretched.x) + sqr(stretched.y));
  // Two uniform numbers of the disc: the square of its radius, and its angle.
  const float u = std::clamp(glm::dot(disc, disc), 0x1p-25f, kOneMinusEpsilon);
  const float turn = std::atan2(disc.y, disc.x) * (0.5f * kInvPi);
  const float v = std::clamp(turn < 0 ? turn + 1 : turn, 0x1p-25f, kOneMinusEpsilon);
  const vec2 tilt = across > 0 ? vec2(stretched.x, stretched.y) / across : vec2(1, 0);
  const float cot = across > 0 ? stretched.z / across : kInfinity;
  // Without tilt both slopes are Gaussian.
  const float along = cot < 1e6f ? visible_slope(cot, u) : erf_inv(2 * u - 1);
  const float aside = erf_inv(2 * v - 1);
  const vec2 slope = along * tilt + aside * vec2(-tilt.y, tilt.x);
  return glm::normalize(vec3(-alpha_x * slope.x, -alpha_y * slope.y, 1));
}

} // namespace candela
