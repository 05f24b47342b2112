#pragma once
// Where spheres have which texture coordinates: longitude and latitude about their own z axis, as in Mitsuba,
// so that pictures stand upright seen from outside with +z up. u grows from +x by +y from 0 to 1; v is 0 at
// -z and 1 at +z, which is the top row of a picture.

#include "core/math.h"

namespace candela {

/// Of a direction from the centre, of any length. Exact to rounding at the poles, too, where acos(z) is not.
inline vec2 sphere_uv(vec3 d) {
  const float turn = std::atan2(d.y, d.x) * (0.5f * kInvPi);
  return {turn < 0 ? turn + 1 : turn, 1 - std::atan2(glm::length(vec2(d)), d.z) * kInvPi};
}

/// Change of sphere_uv(d) as d moves along `step`.
inline vec2 sphere_uv_derivative(vec3 d, vec3 step) {
  const float rho2 = d.x * d.x + d.y * d.y, rho = std::sqrt(rho2);
  const float step_rho = (d.x * step.x + d.y * step.y) / rho;
  return {(d.x * step.y - d.y * step.x) / rho2 * (0.5f * kInvPi),
          (rho * step.z - d.z * step_rho) / (rho2 + d.z * d.z) * kInvPi};
}

/// The unit direction that has them.
inline vec3 sphere_direction(vec2 uv) {
  const float phi = 2 * kPi * uv.x, theta = kPi * (1 - uv.y), sine = std::sin(theta);
  return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)};
}

} // namespace candela
