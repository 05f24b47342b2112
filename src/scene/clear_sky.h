#pragma once
// A clear sky with its sun over a plain, as a latitude-longitude panorama.
//
// The sky is that of A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight",
// SIGGRAPH 1999, appendix A.2: Perez's distribution of luminance and chromaticity for a turbidity.

#include "imaging/image.h"

namespace candela {

struct ClearSky {
  double turbidity = 2.6;
  double sun_elevation = 0.5585; ///< radians
  double sun_azimuth = 1.0472;   ///< radians, to the right of the panorama's centre
  /// Of the disc, radians. The sun's own is 0.0047; drawn wider, it sends as much light.
  double sun_radius = 0.0175;
  glm::dvec3 ground{0.30, 0.26, 0.21}; ///< radiance below the horizon, where it is nearest
};

/// Linear Rec. 709, mapped as EnvironmentMapping::latlong has it (the centre is +z, the top +y), the
/// luminance of the zenith 1. Each pixel is the mean of subpixels^2 samples, so that the sun's rim is smooth.
Image clear_sky_panorama(const ClearSky& sky, int width, int height, int subpixels);

} // namespace candela
