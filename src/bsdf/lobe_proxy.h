#pragma once
// A rough, cheap approximation of a BSDF for light selection.

#include "core/math.h"

namespace candela {

/// f |cos theta_i| (1/sr, in luminance) as about
///     diffuse cos theta_i + peak / (1 + sharpness (1 - cos delta))^2,
/// with delta between wi and the mirror image of wo. Default: Lambertian, of any reflectance, for only ratios
/// between lights count. It must not be 0 where the BSDF is not.
struct LobeProxy {
  float diffuse = 1;
  float peak = 0;
  float sharpness = 0;

  /// Of the lobe, integrated over all directions.
  float lobe_albedo() const { return 2 * kPi * peak / (1 + sharpness); }
};

} // namespace candela
