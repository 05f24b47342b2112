#pragma once
// A ray and the offset that keeps a spawned one off its own surface.

#include "core/math.h"

namespace candela {

/// Points origin + t * direction for t in (t_min, t_max); direction need not be of unit length.
struct Ray {
  vec3 origin{0};
  float t_min = 0;
  vec3 direction{0, 0, 1};
  float t_max = kInfinity;
  float time = 0; ///< of the scene, in [0, 1]: where it meets what moves

  vec3 at(float t) const { return origin + t * direction; }
};

/// Moves p, known to within +-p_error, along the geometric normal n to the side of w, just far enough that a
/// ray from there towards w cannot hit the surface that it leaves (pbrt-v4, section 6.8.6).
inline vec3 offset_ray_origin(vec3 p, vec3 p_error, vec3 n, vec3 w) {
  float d = glm::dot(glm::abs(n), p_error);
  float side = glm::dot(w, n) < 0 ? -d : d;
  // Round away from the surface: by at least the distance to the next float, and without branches, for the
  // signs of a normal cannot be predicted.
  auto away = [](float from, float offset) {
    float moved = from + offset;
    float step = std::abs(moved) * std::numeric_limits<float>::epsilon() + std::numeric_limits<float>::min();
    return moved + (offset == 0 ? 0.0f : std::copysign(step, offset));
  };
  return {away(p.x, side * n.x), away(p.y, side * n.y), away(p.z, side * n.z)};
}

} // namespace candela
