#include "render/world/surface_place.h"

namespace candela {

namespace {

/// The colours of the triangle of a mesh that was hit. Baked triangles of mirrored instances are turned
/// round.
void set_colors(SurfacePlace& place, const Mesh& mesh, std::uint32_t triangle, float u, float v,
                bool turned_round) {
  if (!mesh.vertex_colors.empty()) {
    const uvec3 t = mesh.triangles[triangle];
    if (turned_round) std::swap(u, v);
    place.vertex_color =
        interpolate(mesh.vertex_colors[t.x], mesh.vertex_colors[t.y], mesh.vertex_colors[t.z], u, v);
  }
  if (!mesh.face_colors.empty()) place.face_color = mesh.face_colors[triangle];
}

} // namespace

SurfacePlace surface_place(const RenderScene& scene, const Ray& ray, const Hit& hit,
                           const SurfaceTangents& tangents) {
  const Geometry& geometry = scene.geometry();
  const Instance& instance = scene.instances()[geometry.instance_of(hit)];
  const SurfaceInteraction surface = geometry.surface(ray, hit);
  const mat4 placement = world_from_object(instance, ray.time), object_from_world = glm::inverse(placement);
  SurfacePlace place;
  place.position = transform_point(object_from_world, surface.position);
  // A normal is a gradient: it goes back by the transpose.
  const vec3 normal = glm::transpose(mat3(placement)) * surface.shading_normal;
  if (length_squared(normal) > 0) place.normal = glm::normalize(normal);
  place.dpdu = transform_vector(object_from_world, tangents.dpdu);
  place.dpdv = transform_vector(object_from_world, tangents.dpdv);
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape)) {
    const bool placed = hit.instance != kNoInstance;
    set_colors(place, **mesh, geometry.triangle_of_instance(hit), hit.u, hit.v,
               !placed && glm::determinant(mat3(instance.world_from_object)) < 0);
  }
  return place;
}

} // namespace candela
