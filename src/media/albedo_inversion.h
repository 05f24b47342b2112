#pragma once
// What a body is made of, from the colour that it should have.

#include "bsdf/coat_albedo.h"
#include "core/spectrum.h"

namespace candela {

/// Share of diffuse light that a half space of a medium reflects through an index-matched surface, of
/// isotropic scattering with the albedo 1 - s^2 of a collision:
///     A = (1 - s) (1 - 0.139 s) / (1 + 1.17 s)
/// (van de Hulst 1980, "Multiple Light Scattering", section 14.6). Against Chandrasekhar's solution the error
/// is at most 2.1e-3, and none towards 0 and 1.
inline float half_space_albedo(float single_scattering_albedo) {
  const float s = std::sqrt(std::clamp(1 - single_scattering_albedo, 0.0f, 1.0f));
  return (1 - s) * (1 - 0.139f * s) / (1 + 1.17f * s);
}

/// The inverse, exactly: the albedo of a collision in a medium whose half space reflects the share A of
/// diffuse light. The fit of Chiang, Kutz & Burley 2016, "Practical and Controllable Subsurface Scattering
/// for Production Path Tracing", 1 - exp(-5.09406 A + 2.61188 A^2 - 4.31805 A^3), is within 5e-3 of that up
/// to A = 0.8, but returns 0.04 too little for A = 0.93 and never reaches 1.
inline float single_scattering_albedo(float half_space_albedo) {
  const float a = std::clamp(half_space_albedo, 0.0f, 1.0f);
  // The smaller root of 0.139 s^2 - b s + 1 - A = 0, in the form that loses no digits.
  const float b = 1.139f + 1.17f * a;
  const float s = 2 * (1 - a) / (b + std::sqrt(sqr(b) - 4 * 0.139f * (1 - a)));
  return 1 - sqr(s);
}

/// What the half space has to reflect at its bare surface for the share `color` of the diffuse light that
/// enters it through a smooth interface to leave it again. Of what comes up from inside the interface throws
/// the share R back, diffuse as it is: color = (1 - R) A / (1 - R A) (Saunderson 1942, "Calculation of the
/// Color of Pigmented Plastics"). ior >= 1 is inside over outside.
inline float albedo_below_interface(float color, float ior) {
  const float inside = internal_diffuse_reflectance(diffuse_fresnel_reflectance(ior), ior);
  return color / (1 - inside + inside * color);
}

} // namespace candela
