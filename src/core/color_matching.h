#pragma once
// From spectra to colours: the CIE 1931 standard observer and the primaries of Rec. 709.

#include "core/math.h"

namespace candela {

/// The CIE 1931 2-degree colour matching functions at a wavelength in nanometres, by the piecewise Gaussian
/// fits of Wyman, Sloan and Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", eq. 4 (multi-lobe).
inline glm::dvec3 color_matching(double nanometres) {
  const auto lobe = [nanometres](double height, double centre, double below, double above) {
    const double x = (nanometres - centre) / (nanometres < centre ? below : above);
    return height * std::exp(-0.5 * x * x);
  };
  return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
          lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
          lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

/// Lumens per watt where the luminosity function is 1 (SI definition of the candela).
inline constexpr double kLuminousEfficacy = 683.002;

/// Linear Rec. 709 (primaries of ITU-R BT.709, white D65) from CIE XYZ. Its Y is that of luminance().
inline glm::dvec3 rec709_from_xyz(glm::dvec3 xyz) {
  return {3.240479 * xyz.x - 1.537150 * xyz.y - 0.498535 * xyz.z,
          -0.969256 * xyz.x + 1.875992 * xyz.y + 0.041556 * xyz.z,
          0.055648 * xyz.x - 0.204043 * xyz.y + 1.057311 * xyz.z};
}

} // namespace candela
