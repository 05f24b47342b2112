#pragma once
// A ray and the offset that keeps a spawned one off its own surface.

#include "core/math.h"

#include <bit>

namespace candela {

/// Points origin + t * direction for t in (t_min, t_max); direction need not be of unit length.
struct Ray {
  vec3 origin{0};
  float t_min = 0;
  vec3 direction{0, 0, 1};
  float t_max = kInfinity;

  vec3 at(float t) const { return origin + t * direction; }
};

inline float next_float_up(float x) {
  if (std::isinf(x) && x > 0) return x;
  if (x == 0) x = 0.0f;
  auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>(x >= 0 ? bits + 1 : bits - 1);
}
inline float next_float_down(float x) { return -next_float_up(-x); }

/// Moves p, known to within +-p_error, along the geometric normal n to the side of w, just far enough that a
/// ray from there towards w cannot meet the surface it leaves (pbrt-v4, section 6.8.6).
inline vec3 offset_ray_origin(vec3 p, vec3 p_error, vec3 n, vec3 w) {
  float d = glm::dot(glm::abs(n), p_error);
  vec3 offset = d * n;
  if (glm::dot(w, n) < 0) offset = -offset;
  vec3 po = p + offset;
  for (int i = 0; i < 3; ++i) { // round away from the surface
    if (offset[i] > 0)
      po[i] = next_float_up(po[i]);
    else if (offset[i] < 0)
      po[i] = next_float_down(po[i]);
  }
  return po;
}

} // namespace candela
