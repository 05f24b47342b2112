#pragma once
// The colour of what glows.

#include "core/color.h"
#include "core/color_matching.h"

namespace candela {

/// Planck's law: the spectral radiance of a black body, W/(m^2 sr nm).
inline double planck_radiance(double nanometres, double kelvin) {
  constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23; // SI, exact since 2019
  const double metres = nanometres * 1e-9;
  const double exponent = h * c / (metres * k * kelvin);
  return 2 * h * c * c / std::pow(metres, 5) / std::expm1(exponent) * 1e-9;
}

/// CIE XYZ of a black body relative to its Y, which is 1.
inline glm::dvec3 blackbody_xyz(double kelvin) {
  // The radiance is taken relative to 560 nm, as that of a cold body underflows. The integrand vanishes
  // smoothly at both ends: the sum over even steps converges fast.
  constexpr double kFirst = 360, kLast = 830, kStep = 5, kMiddle = 560;
  const double scale = 1.4387768775e7; // h c / k, nm K
  glm::dvec3 sum(0);
  for (double nm = kFirst; nm <= kLast; nm += kStep) {
    const double x = scale / (nm * kelvin), m = scale / (kMiddle * kelvin);
    // exp(m) - 1 over exp(x) - 1 without overflow.
    const double ratio = std::exp(m - x) * std::expm1(-m) / std::expm1(-x);
    sum += std::pow(kMiddle / nm, 5) * ratio * color_matching(nm);
  }
  return sum / sum.y;
}

/// The range of temperatures that lights offer: from a glow that is hardly seen to the bluest stars.
inline constexpr double kCoolestKelvin = 800, kHottestKelvin = 40000;

/// Linear Rec. 709 of a black body whose luminance is 1. Below about 1900 K its blue would be negative: it is
/// 0 there, and the rest is scaled to the luminance. Temperatures out of range are taken for the next in it.
inline vec3 blackbody_color(float kelvin) {
  const double in_range =
      kelvin > kCoolestKelvin ? std::min(static_cast<double>(kelvin), kHottestKelvin) : kCoolestKelvin;
  const vec3 rgb(glm::max(rec709_from_xyz(blackbody_xyz(in_range)), glm::dvec3(0)));
  return rgb / luminance(rgb);
}

} // namespace candela
