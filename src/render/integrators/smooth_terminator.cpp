#include "render/integrators/smooth_terminator.h"

namespace candela {

namespace {

/// A point that rays of one side may leave, and its unit normal, for a viewer at wo.
struct LeavingPoint {
  vec3 position, normal;
};

std::optional<LeavingPoint> leaving_point(const Geometry& geometry, const Ray& ray, const Hit& hit,
                                          vec3 position, vec3 position_error, vec3 geometric_normal, vec3 wo,
                                          float side) {
  const auto triangle = geometry.smooth_triangle(ray, hit);
  if (!triangle) return std::nullopt;
  const vec3 offset = offset_to_smooth_surface(*triangle, hit.u, hit.v, position);
  const vec3 outwards = side > 0 ? geometric_normal : -geometric_normal;
  // Not where it lies on the other side, nor where rounding alone makes it one.
  if (!(glm::dot(offset, outwards) > glm::dot(glm::abs(outwards), position_error))) return std::nullopt;
  // Clear of the triangle before it is left, for a direction may point through it.
  const vec3 clear = offset_ray_origin(position, position_error, outwards, outwards);
  const vec3 smooth = shading_normal(triangle->smooth_normal, geometric_normal);
  return LeavingPoint{clear + offset, visible_normal(smooth, wo, side)};
}

bool only_reflects(const Bsdf& bsdf) { return !has_any(bsdf_flags(bsdf), BsdfFlags::transmission); }

} // namespace

void smooth_terminator(VertexLanes& v, const Geometry& geometry, std::span<const Ray* const> rays,
                       std::span<const Hit> hits) {
  for (std::size_t i = 0; i < v.count; ++i) {
    if (!v.scatters(i) || !only_reflects(v.bsdf(i))) continue;
    const vec3 wo = Basis::from_normal(v.normal[i]).to_world(v.wo_local[i]);
    const auto leaving = leaving_point(geometry, *rays[i], hits[i], v.position[i], v.position_error[i],
                                       v.geometric_normal[i], wo, v.side[i]);
    if (!leaving) continue;
    v.position.set(i, leaving->position);
    v.geometric_normal.set(i, leaving->normal);
    v.side[i] = glm::dot(wo, leaving->normal);
    v.light_context[i].position = leaving->position;
    v.light_context[i].normal = v.side[i] > 0 ? leaving->normal : -leaving->normal;
  }
}

void smooth_terminator(Vertex& v, const Bsdf& bsdf, const Geometry& geometry, const Ray& ray,
                       const Hit& hit) {
  if (!only_reflects(bsdf)) return;
  SurfaceInteraction& s = v.surface;
  const auto leaving =
      leaving_point(geometry, ray, hit, s.position, s.position_error, s.geometric_normal, v.wo, v.side);
  if (!leaving) return;
  s.position = leaving->position;
  s.geometric_normal = leaving->normal;
  v.side = glm::dot(v.wo, leaving->normal);
  v.light_context.position = leaving->position;
  v.light_context.normal = v.side > 0 ? leaving->normal : -leaving->normal;
}

} // namespace candela
