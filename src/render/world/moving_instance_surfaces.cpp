#include "render/world/moving_instance_surfaces.h"

#include "render/world/geometry.h"
#include "render/world/triangle_point.h"

namespace candela {

namespace {

/// A hit as the object's geometry has it.
Hit hit_of_object(Hit hit) {
  hit.instance = kNoInstance;
  return hit;
}

/// The object as the ray finds it.
struct ObjectAtTime {
  const Geometry& geometry;
  mat4 world_from_object;
  mat3 normal_to_world; ///< inverse transpose: it maps outward to outward, mirrored or not
  Ray ray;              ///< in the object's space; its t is that of the world
  Hit hit;

  ObjectAtTime(const Geometry& object, const MovingTransform& placement, const Ray& world_ray,
               const Hit& world_hit)
      : geometry(object), world_from_object(placement.at(static_cast<double>(world_ray.time))),
        hit(hit_of_object(world_hit)) {
    const glm::mat4x3 m = accel_detail::object_from_world(placement, world_ray.time);
    normal_to_world = glm::transpose(mat3(m));
    ray = accel_detail::ray_in_object(m, world_ray, world_ray.t_max);
  }
};

} // namespace

void MovingInstanceSurfaces::place(std::uint32_t object, const Instance& instance, std::uint32_t index) {
  placed.push_back({object, placement_of(instance), primitive_count, index});
  primitive_count += objects[object]->emitter_count();
}

std::size_t MovingInstanceSurfaces::memory_bytes() const {
  std::size_t bytes = placed.size() * sizeof(Placed);
  for (const auto& object : objects) bytes += object->memory_bytes();
  return bytes;
}

std::vector<MovingInstanceGeometry> MovingInstanceSurfaces::geometries() const {
  std::vector<MovingInstanceGeometry> out;
  for (const Placed& p : placed) out.push_back({&objects[p.object]->accel(), p.placement});
  return out;
}

bool MovingInstanceSurfaces::has_smooth() const {
  return std::ranges::any_of(objects, [](const auto& object) { return object->has_smooth_triangles(); });
}

std::uint32_t MovingInstanceSurfaces::material_of(const Hit& hit) const {
  return objects[of(hit).object]->material_of(hit_of_object(hit));
}

std::uint64_t MovingInstanceSurfaces::number_of(const Hit& hit) const {
  return of(hit).first_number + objects[of(hit).object]->number_of(hit_of_object(hit));
}

std::uint32_t MovingInstanceSurfaces::triangle_of_instance(const Hit& hit) const {
  return objects[of(hit).object]->triangle_of_instance(hit_of_object(hit));
}

void MovingInstanceSurfaces::set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const {
  const ObjectAtTime o(*objects[of(hit).object], of(hit).placement, ray, hit);
  const SurfaceInteraction local = o.geometry.surface(o.ray, o.hit);
  const mat4& m = o.world_from_object;
  // The error of the object-space point, transformed, and that of transforming it (pbrt-v4, section 6.8.4).
  const mat3 abs_m(glm::abs(vec3(m[0])), glm::abs(vec3(m[1])), glm::abs(vec3(m[2])));
  s.position_error = (gamma_bound(3) + 1) * (abs_m * local.position_error) +
                     gamma_bound(3) * (abs_m * glm::abs(local.position) + glm::abs(vec3(m[3])));
  s.position = transform_point(m, local.position);
  s.geometric_normal = glm::normalize(o.normal_to_world * local.geometric_normal);
  s.shading_normal = shading_normal(o.normal_to_world * local.shading_normal, s.geometric_normal);
}

std::optional<SmoothTriangle> MovingInstanceSurfaces::smooth_triangle(const Ray& ray, const Hit& hit) const {
  const ObjectAtTime o(*objects[of(hit).object], of(hit).placement, ray, hit);
  std::optional<SmoothTriangle> t = o.geometry.smooth_triangle(o.ray, o.hit);
  if (!t) return t;
  for (vec3& p : t->positions) p = transform_point(o.world_from_object, p);
  for (vec3& n : t->normals) n = glm::normalize(o.normal_to_world * n);
  t->smooth_normal = o.normal_to_world * t->smooth_normal;
  return t;
}

vec2 MovingInstanceSurfaces::uv(const Ray& ray, const Hit& hit) const {
  const ObjectAtTime o(*objects[of(hit).object], of(hit).placement, ray, hit);
  return o.geometry.uv(o.ray, o.hit);
}

SurfaceTangents MovingInstanceSurfaces::tangents(const Ray& ray, const Hit& hit) const {
  const ObjectAtTime o(*objects[of(hit).object], of(hit).placement, ray, hit);
  const SurfaceTangents local = o.geometry.tangents(o.ray, o.hit);
  const vec3 dpdu = transform_vector(o.world_from_object, local.dpdu),
             dpdv = transform_vector(o.world_from_object, local.dpdv);
  if (local.has_uv) return {dpdu, dpdv, true};
  return tangents_without_uv(glm::normalize(o.normal_to_world * glm::cross(local.dpdu, local.dpdv)));
}

Hit MovingInstanceSurfaces::hit_at(std::uint64_t number, vec3 point) const {
  // The last instance that begins at or before the number.
  const auto next = std::ranges::upper_bound(placed, number, {}, &Placed::first_number);
  const Placed& p = *std::prev(next);
  const vec3 local(glm::inverse(p.placement.at(0)) * glm::dvec4(point, 1));
  Hit hit = objects[p.object]->hit_at(number - p.first_number, local);
  hit.instance = static_cast<std::uint32_t>(&p - placed.data()) | kMovingInstance;
  return hit;
}

} // namespace candela
