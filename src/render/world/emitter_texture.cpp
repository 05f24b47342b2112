#include "render/world/emitter_texture.h"

namespace candela {

namespace {

/// Barycentric weights of the second and third corner, of the point of the plane that is nearest to p.
vec2 barycentric(vec3 a, vec3 b, vec3 c, vec3 p) {
  const vec3 e1 = b - a, e2 = c - a, d = p - a;
  const float a11 = glm::dot(e1, e1), a12 = glm::dot(e1, e2), a22 = glm::dot(e2, e2);
  const float d1 = glm::dot(d, e1), d2 = glm::dot(d, e2);
  const float det = a11 * a22 - a12 * a12;
  if (!(det > 0)) return vec2(0);
  return {(a22 * d1 - a12 * d2) / det, (a11 * d2 - a12 * d1) / det};
}

} // namespace

vec2 emitter_uv(const Geometry& geometry, std::uint64_t emitter, vec3 point) {
  const Ray at_point{point, 0, {0, 0, 1}, kInfinity};
  Hit hit;
  hit.t = 0;
  auto on_triangle = [&](const TriangleSet& set, std::uint32_t primitive, vec3 p) {
    const uvec3 t = set.triangles[primitive];
    const vec2 weights = barycentric(set.positions[t.x], set.positions[t.y], set.positions[t.z], p);
    hit.kind = PrimitiveKind::triangle;
    hit.primitive = primitive;
    hit.u = weights.x;
    hit.v = weights.y;
  };
  const std::uint64_t triangles = geometry.world().triangles.size(), spheres = geometry.spheres().size(),
                      discs = geometry.discs().size();
  if (emitter < triangles) {
    on_triangle(geometry.world(), static_cast<std::uint32_t>(emitter), point);
  } else if (emitter < triangles + spheres) {
    hit.kind = PrimitiveKind::sphere;
    hit.primitive = static_cast<std::uint32_t>(emitter - triangles);
  } else if (emitter < triangles + spheres + discs) {
    hit.kind = PrimitiveKind::disc;
    hit.primitive = static_cast<std::uint32_t>(emitter - triangles - spheres);
  } else {
    // The last instance that begins at or before the number.
    const auto& placed = geometry.placed();
    const auto next = std::ranges::upper_bound(placed, emitter, {}, &Geometry::Placed::first_emitter);
    const auto index = static_cast<std::size_t>(next - placed.begin()) - 1;
    hit.instance = static_cast<std::uint32_t>(index);
    on_triangle(geometry.objects()[placed[index].object]->set,
                static_cast<std::uint32_t>(emitter - placed[index].first_emitter),
                transform_point(placed[index].object_from_world, point));
  }
  return geometry.uv(at_point, hit);
}

} // namespace candela
