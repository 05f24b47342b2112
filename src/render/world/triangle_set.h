#pragma once
// Triangles with what shading needs of them, in whatever space.

#include "accel/accel.h"
#include "lights/triangle_light.h"
#include "render/world/emission_table.h"
#include "render/world/surface_tangents.h"
#include "render/world/triangle_point.h"

#include <vector>

namespace candela {

template <class T>
T interpolate(T a, T b, T c, float u, float v) {
  return (1 - u - v) * a + u * b + v * c;
}

/// Triangles in world space (small meshes, rectangles) or in the space of an object.
struct TriangleSet {
  std::vector<vec3> positions;
  std::vector<vec3> normals; ///< parallel to positions if not empty; a zero one means flat
  std::vector<vec2> uvs;     ///< parallel to positions if not empty
  std::vector<uvec3> triangles;
  std::vector<std::uint32_t> materials; ///< per triangle: a material, or a slot for objects

  TrianglePoint point(uvec3 t, float u, float v) const {
    return triangle_point(positions[t.x], positions[t.y], positions[t.z], u, v);
  }
  /// The vertices' normals at barycentric coordinates, not of unit length; zero where the triangle is flat,
  /// as it is if a vertex has none.
  vec3 smooth_normal(uvec3 t, float u, float v) const {
    if (normals.empty()) return vec3(0);
    vec3 n0 = normals[t.x], n1 = normals[t.y], n2 = normals[t.z];
    if (is_black(n0) || is_black(n1) || is_black(n2)) return vec3(0);
    return (1 - u - v) * n0 + u * n1 + v * n2;
  }
  /// (0, 0) where there are none.
  vec2 uv(const Hit& hit) const {
    if (uvs.empty()) return vec2(0);
    const uvec3 t = triangles[hit.primitive];
    return interpolate(uvs[t.x], uvs[t.y], uvs[t.z], hit.u, hit.v);
  }
  /// Of a triangle whose edges from its first vertex are these, in whatever space.
  SurfaceTangents tangents(uvec3 t, vec3 edge1, vec3 edge2) const {
    const vec3 normal = glm::normalize(glm::cross(edge1, edge2));
    if (uvs.empty()) return tangents_without_uv(normal);
    return tangents_from(edge1, edge2, uvs[t.y] - uvs[t.x], uvs[t.z] - uvs[t.x], normal);
  }
  /// At the point of the triangle's plane that is nearest to p.
  Hit hit_at(std::uint32_t triangle, vec3 p) const {
    const uvec3 t = triangles[triangle];
    const vec3 a = positions[t.x], e1 = positions[t.y] - a, e2 = positions[t.z] - a, d = p - a;
    const float a11 = glm::dot(e1, e1), a12 = glm::dot(e1, e2), a22 = glm::dot(e2, e2);
    const float d1 = glm::dot(d, e1), d2 = glm::dot(d, e2);
    const float det = a11 * a22 - a12 * a12;
    Hit hit;
    hit.kind = PrimitiveKind::triangle;
    hit.primitive = triangle;
    hit.u = det > 0 ? (a22 * d1 - a12 * d2) / det : 0;
    hit.v = det > 0 ? (a11 * d2 - a12 * d1) / det : 0;
    return hit;
  }

  std::size_t memory_bytes() const {
    return positions.size() * sizeof(vec3) + normals.size() * sizeof(vec3) + uvs.size() * sizeof(vec2) +
           triangles.size() * sizeof(uvec3) + materials.size() * sizeof(std::uint32_t);
  }
};

/// As SurfaceKind's for_each_light has it, of one triangle: nothing where it has no area, for no ray meets it
/// either. `outside`: a vector to its outside; `uv_at`: its coordinates by the barycentric ones of its second
/// and third corner.
template <class UvAt, class Add>
void add_triangle_light(std::uint64_t number, std::uint32_t material, vec3 p0, vec3 p1, vec3 p2, vec3 outside,
                        const UvAt& uv_at, Add& add) {
  const vec3 c = glm::cross(p1 - p0, p2 - p0);
  const float double_area = glm::length(c);
  if (!(double_area > 0)) return;
  vec3 n = c / double_area;
  if (glm::dot(n, outside) < 0) n = -n;
  add(number, 1, material, [&](const EmitterRadiance& radiance) {
    const LightRadiance sent = radiance.over_triangle(uv_at);
    return TriangleLight{p0, p1 - p0, p2 - p0, n, 0.5f * double_area, sent.mean, sent.two_sided};
  });
}

} // namespace candela
