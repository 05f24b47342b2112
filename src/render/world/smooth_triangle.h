#pragma once
// Triangles whose vertices' normals describe a curved surface.

#include "core/math.h"

#include <array>

namespace candela {

/// World space. Unit normals, on the side of the triangle's geometric normal as its shading normal is.
struct SmoothTriangle {
  std::array<vec3, 3> positions, normals;
  vec3 smooth_normal; ///< interpolated where the triangle was hit, not of unit length
};

/// How far the curved surface lies from the point `p` of the triangle: half the way to the point of Phong
/// tessellation (Boubekeur and Alexa 2008), the mean of p's projections onto the vertices' tangent planes by
/// its barycentric coordinates (u, v). The whole way overshoots: of a circle it ends as far outside as the
/// chord lies inside. Zero on a flat triangle whose normals are parallel, however they lean.
inline vec3 offset_to_smooth_surface(const SmoothTriangle& t, float u, float v, vec3 p) {
  const std::array<float, 3> b{1 - u - v, u, v};
  vec3 sum(0);
  for (std::size_t i = 0; i < 3; ++i) sum += b[i] * glm::dot(t.positions[i] - p, t.normals[i]) * t.normals[i];
  return 0.5f * sum;
}

} // namespace candela
