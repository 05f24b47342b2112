#pragma once
// Where on a triangle a ray met it. Inline and without branches, for one hit or for loops over many.

#include "core/math.h"

namespace candela {

struct TrianglePoint {
  vec3 position;
  vec3 error;  ///< absolute bound of the position, per axis
  vec3 normal; ///< unit, by the winding
};

/// (u, v): barycentric coordinates of the second and third vertex.
inline TrianglePoint triangle_point(vec3 p0, vec3 p1, vec3 p2, float u, float v) {
  vec3 a = (1 - u - v) * p0, b = u * p1, c = v * p2;
  vec3 error = gamma_bound(7) * (glm::abs(a) + glm::abs(b) + glm::abs(c)); // pbrt-v4, eq. 6.31
  // The test of the next ray against this triangle rounds t by the triangle's size in whatever direction,
  // also where the point itself has no error along the normal (a wall in a coordinate plane). The factor is
  // where self-intersections of well-shaped triangles ended when measured.
  vec3 x = p1 - p0, y = p2 - p0;
  error += gamma_bound(8) * max_component(glm::max(glm::abs(x), glm::abs(y)));
  return {a + b + c, error, glm::normalize(glm::cross(x, y))};
}

/// The unit normal to shade with: along `smooth`, turned to the side of the geometric one, or this itself
/// where `smooth` is zero.
inline vec3 shading_normal(vec3 smooth, vec3 geometric) {
  float length2 = length_squared(smooth);
  vec3 n = glm::normalize(smooth);
  n = select(glm::dot(n, geometric) < 0, -n, n);
  return select(length2 > 0, n, geometric);
}

} // namespace candela
