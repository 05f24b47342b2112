#pragma once
// A panorama (latitude-longitude) of a clear sky with the sun above a plain.
//
// The sky is that of A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight",
// SIGGRAPH 1999, appendix A.2: Perez's distribution of luminance and chromaticity for a turbidity.

#include "imaging/image.h"

namespace candela {

struct ClearSky {
  double turbidity = 2.6;
  double sun_elevation = 0.5585; ///< radians
  double sun_azimuth = 1.0472;   ///< radians, to the right of the panorama's centre
  /// Radius of the sun's disc, radians. The real one is 0.0047; a larger disc has the same power.
  double sun_radius = 0.0175;
  glm::dvec3 ground{0.30, 0.26, 0.21}; ///< radiance straight down
};

/// Linear Rec. 709 with the mapping EnvironmentMapping::latlong (the centre is +z, the top +y), with the
/// zenith's luminance 1. Each pixel is the mean of subpixels^2 samples, so that the sun's edge is smooth.
Image clear_sky_panorama(const ClearSky& sky, int width, int height, int subpixels);

} // namespace candela
