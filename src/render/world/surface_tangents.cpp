// Tangents along the texture coordinates that Geometry::uv gives.

#include "core/basis.h"
#include "render/world/geometry.h"
#include "render/world/sphere_uv.h"

namespace candela {

namespace {

SurfaceTangents without_uv(vec3 normal) {
  const Basis basis = Basis::from_normal(normal);
  return {basis.s, basis.t, false};
}

/// Of a surface p(a, b) whose coordinates are uv(a, b), from the derivatives of both.
SurfaceTangents solve(vec3 dpda, vec3 dpdb, vec2 duv_da, vec2 duv_db, vec3 normal) {
  const float determinant = duv_da.x * duv_db.y - duv_da.y * duv_db.x;
  // Also where the coordinates fold onto a line but for rounding.
  constexpr float kRounding = 1e-6f;
  if (!(std::abs(determinant) > kRounding * glm::length(duv_da) * glm::length(duv_db)))
    return without_uv(normal);
  const vec3 dpdu = (duv_db.y * dpda - duv_da.y * dpdb) / determinant,
             dpdv = (duv_da.x * dpdb - duv_db.x * dpda) / determinant;
  return {dpdu, dpdv, true};
}

/// Change of sphere_uv(d) as d moves along `step`.
vec2 sphere_uv_derivative(vec3 d, vec3 step) {
  const float rho2 = d.x * d.x + d.y * d.y, rho = std::sqrt(rho2);
  const float step_rho = (d.x * step.x + d.y * step.y) / rho;
  return {(d.x * step.y - d.y * step.x) / rho2 * (0.5f * kInvPi),
          (rho * step.z - d.z * step_rho) / (rho2 + d.z * d.z) * kInvPi};
}

} // namespace

SurfaceTangents Geometry::tangents(const Ray& ray, const Hit& hit) const {
  if (hit.kind == PrimitiveKind::sphere) {
    const mat3& local_from_world = sphere_from_world_[hit.primitive]; // orthogonal
    const vec3 p = (ray.origin - spheres_[hit.primitive].center) + hit.t * ray.direction;
    const vec3 d = local_from_world * p;
    const float rho = std::sqrt(d.x * d.x + d.y * d.y);
    if (!(rho > 0)) return without_uv(glm::normalize(p));
    // Longitude 2 pi u about z, angle pi (1 - v) from +z.
    const vec3 dpdu = 2 * kPi * vec3(-d.y, d.x, 0),
               dpdv = kPi * vec3(-d.x * d.z / rho, -d.y * d.z / rho, rho);
    return {dpdu * local_from_world, dpdv * local_from_world, true};
  }
  if (hit.kind == PrimitiveKind::disc) {
    const DiscAxes& axes = disc_axes_[hit.primitive];
    return {2.0f * axes.x / length_squared(axes.x), 2.0f * axes.y / length_squared(axes.y), true};
  }
  const bool shared = hit.instance != kNoInstance;
  const TriangleSet& set = shared ? objects_[placed_[hit.instance].object]->set : world_;
  const uvec3 t = set.triangles[hit.primitive];
  vec3 edge1 = set.positions[t.y] - set.positions[t.x], edge2 = set.positions[t.z] - set.positions[t.x];
  if (shared) {
    const mat4& world_from_object = placed_[hit.instance].world_from_object;
    edge1 = transform_vector(world_from_object, edge1), edge2 = transform_vector(world_from_object, edge2);
  }
  const vec3 normal = glm::normalize(glm::cross(edge1, edge2));
  if (set.uvs.empty()) return without_uv(normal);
  const vec2 a = set.uvs[t.x], b = set.uvs[t.y], c = set.uvs[t.z];
  if (shared || !is_ellipsoid(hit.primitive)) return solve(edge1, edge2, b - a, c - a, normal);
  const vec3 da = sphere_direction(a), db = sphere_direction(b) - da, dc = sphere_direction(c) - da;
  const vec3 d = da + hit.u * db + hit.v * dc;
  return solve(edge1, edge2, sphere_uv_derivative(d, db), sphere_uv_derivative(d, dc), normal);
}

} // namespace candela
