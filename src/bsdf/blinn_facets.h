#pragma once

#include "sampling/warp.h"

namespace candela {

/// Facets whose normals are distributed as a power of the cosine (Blinn 1977, "Models of Light Reflection for
/// Computer Synthesized Pictures"), normalised:
///     D(h) = (n + 2) / (2 pi) cos(theta_h)^n,   n = 2 / alpha^2 - 2,
/// so that n fits alpha as in Walter et al. 2007, section 5.2. Directions are above the surface.
struct BlinnFacets {
  float alpha = 0.1f; ///< in (0, 1]: n >= 0

  /// By components: cos(theta)^n would lose its digits near the normal.
  float d(vec3 h) const {
    const float sin2 = std::min(sqr(h.x) + sqr(h.y), 1.0f), n = 2 / sqr(alpha) - 2;
    const float power = n > 0 ? std::exp(0.5f * n * std::log1p(-sin2)) : 1;
    return power / (kPi * sqr(alpha));
  }

  /// Smith's Lambda, exactly. The slope of facets along a line has Student's distribution of n + 2 degrees of
  /// freedom; the mean of slope - cot(theta) over slopes beyond cot(theta), by cot(theta), is, with
  /// a = 1 / alpha^2 and c = Gamma(a + 1/2) / (sqrt(pi) Gamma(a)),
  ///     c sin^2a / ((2 a - 1) cos) - tail,   tail = c * integral of (1 - z^2)^(a - 1) from cos to 1.
  float lambda(vec3 w) const {
    const float a = 1 / sqr(alpha), cosine = std::abs(w.z);
    const float sin2 = std::min(sqr(w.x) + sqr(w.y), 1.0f), cos2 = std::min(sqr(cosine), 1.0f);
    if (!(a * cos2 < 16 * sin2) && a > 16) return 0; // less than float digits resolve
    if (sin2 == 0) return 0;
    const float c = gamma_ratio(a) / kSqrtPi;
    const float power = std::exp(a * std::log1p(-cos2)); // sin^2a
    const float mean = c * power / ((2 * a - 1) * cosine);
    // The integral by a series of positive terms (Gauss's hypergeometric function), from 1 or from 0.
    if (sin2 < 0.5f) {
      const float tail = 0.5f * c / a * power * cosine * series(a + 0.5f, a + 1, sin2);
      return std::max(mean - tail, 0.0f);
    }
    const float head = c * power * cosine * series(a + 0.5f, 1.5f, cos2);
    return std::max(mean - (0.5f - head), 0.0f);
  }

  /// A normal in proportion to D(h) cos(theta_h); `disc` is uniform on the unit disc. cos = (1 - v)^(1 / (n +
  /// 2)) with v = |disc|^2.
  vec3 sample_normal(vec2 disc) const {
    const float v = std::min(glm::dot(disc, disc), kOneMinusEpsilon);
    const float sin2 = -std::expm1(sqr(alpha) * std::log1p(-v));
    return {disc * (v > 0 ? std::sqrt(sin2 / v) : 0), safe_sqrt(1 - sin2)};
  }
  /// The density in 1/sr of the direction that h mirrors one into that has that cosine with it.
  float reflection_pdf(vec3 h, float cosine) const { return d(h) * h.z / (4 * cosine); }

private:
  static constexpr float kSqrtPi = 1.7724538509055160f;

  /// Gamma(a + 1/2) / Gamma(a), a >= 1: its asymptotic series, four steps up.
  static float gamma_ratio(float a) {
    const float y = 1 / (a + 4);
    float ratio = std::sqrt(a + 4) * (1 - y * (0.125f - y * (0.0078125f + y * 0.0048828125f)));
    for (int step = 0; step < 4; ++step) {
      const auto k = static_cast<float>(step);
      ratio *= (a + k) / (a + k + 0.5f);
    }
    return ratio;
  }
  /// 1 + p/q x + p (p + 1) / (q (q + 1)) x^2 + ...
  static float series(float p, float q, float x) {
    float term = 1, sum = 1;
    for (int step = 0; step < 200; ++step) {
      const auto k = static_cast<float>(step);
      const float ratio = x * (p + k) / (q + k);
      term *= ratio;
      sum += term;
      if (ratio < 0.9f && term < 1e-7f * sum) break;
    }
    return sum;
  }
};

} // namespace candela
