#include "media/draine_phase.h"

namespace candela {

/// With s^2 = 1 + g^2 - 2 g c of the cosine c, the integral of (1 + alpha c^2) / s^3 over c is
///     F(s) = (-1 / s + alpha / (4 g^2) (-(1 + g^2)^2 / s - 2 (1 + g^2) s + s^3 / 3)) / g.
Turn Draine::sample(float u, float) const {
  const double g = static_cast<double>(lobe_.g), alpha = static_cast<double>(alpha_);
  // The probability of less than v = 1 - c.
  auto share_below = [&](double v) {
    const double c = 1 - v;
    if (g == 0) return ((1 - c) + alpha * (1 - c * c * c) / 3) / (2 * (1 + alpha / 3));
    const double m = 1 + g * g;
    auto antiderivative = [&](double s) {
      return (-1 / s + alpha / (4 * g * g) * (-m * m / s - 2 * m * s + s * s * s / 3)) / g;
    };
    const double forward = antiderivative(1 - g), s = std::sqrt((1 - g) * (1 - g) + 2 * g * v);
    return (forward - antiderivative(s)) / (forward - antiderivative(1 + g));
  };
  const double wanted = static_cast<double>(u);
  double low = 0, high = 2, v = static_cast<double>(lobe_.sample(u, 0).forward);
  constexpr int kMostSteps = 60;
  for (int i = 0; i < kMostSteps && high - low > 1e-9 * high; ++i) {
    const double error = share_below(v) - wanted;
    (error < 0 ? low : high) = v;
    const double slope =
        2 * static_cast<double>(kPi) * static_cast<double>(eval(Turn::from_forward(static_cast<float>(v))));
    const double next = v - error / slope;
    if (std::abs(next - v) <= 1e-8 * v) break;
    v = next > low && next < high ? next : 0.5 * (low + high);
  }
  return Turn::from_forward(std::clamp(static_cast<float>(v), 0.0f, 2.0f));
}

} // namespace candela
