#pragma once

#include "core/math.h"

namespace candela {

/// Quantities that depend on the wavelength: radiance, throughput, reflectance, transmittance, absorption
/// coefficients. Three values, for the linear Rec. 709 primaries (core/color.h). Points, directions and
/// normals are vec3.
using Spectrum = vec3;

} // namespace candela
