#pragma once
// Spheres that are no triangles: those that their transform keeps round.

#include "lights/sphere_light.h"
#include "render/world/emission_table.h"
#include "render/world/sphere_uv.h"
#include "render/world/surface_kind.h"
#include "render/world/surface_tangents.h"

namespace candela {

/// A SurfaceKind.
struct SphereSurfaces {
  using Primitives = primitives::Spheres;

  std::vector<SphereGeometry> spheres;
  std::vector<mat3> local_from_world; ///< turns (and mirrors) directions; orthogonal
  std::vector<std::uint32_t> materials, instances;

  /// Whether the instance is one, which is then added.
  bool add(const Instance& instance, std::uint32_t index) {
    const auto* sphere = std::get_if<SphereShape>(&instance.shape);
    const mat4& m = instance.world_from_object;
    if (sphere == nullptr || !is_similarity(m)) return false;
    spheres.push_back({vec3(m[3]), sphere->radius * glm::length(vec3(m[0]))});
    local_from_world.push_back(glm::transpose(mat3(m)) / glm::length(vec3(m[0])));
    materials.push_back(static_cast<std::uint32_t>(instance.materials[0]));
    instances.push_back(index);
    return true;
  }

  std::uint64_t count() const { return spheres.size(); }
  Primitives::Input input() const { return {spheres}; }
  std::size_t memory_bytes() const {
    return spheres.size() * (sizeof(SphereGeometry) + sizeof(mat3) + 2 * sizeof(std::uint32_t));
  }

  std::uint32_t material_of(const Hit& hit) const { return materials[hit.primitive]; }
  std::uint32_t instance_of(const Hit& hit) const { return instances[hit.primitive]; }
  std::uint64_t number_of(const Hit& hit) const { return hit.primitive; }

  void set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const {
    const SphereGeometry& sphere = spheres[hit.primitive];
    s.geometric_normal = glm::normalize(ray.at(hit.t) - sphere.center);
    vec3 offset = s.geometric_normal * sphere.radius; // on the sphere again, whatever t had of error
    s.position = sphere.center + offset;
    s.position_error = gamma_bound(6) * (glm::abs(sphere.center) + glm::abs(offset));
    s.shading_normal = s.geometric_normal;
  }
  vec2 uv(const Ray& ray, const Hit& hit) const {
    return sphere_uv(local_from_world[hit.primitive] * from_center(ray, hit));
  }
  SurfaceTangents tangents(const Ray& ray, const Hit& hit) const {
    const mat3& local = local_from_world[hit.primitive];
    const vec3 p = from_center(ray, hit), d = local * p;
    const float rho = std::sqrt(d.x * d.x + d.y * d.y);
    if (!(rho > 0)) return tangents_without_uv(glm::normalize(p));
    // Longitude 2 pi u about z, angle pi (1 - v) from +z.
    const vec3 dpdu = 2 * kPi * vec3(-d.y, d.x, 0),
               dpdv = kPi * vec3(-d.x * d.z / rho, -d.y * d.z / rho, rho);
    return {dpdu * local, dpdv * local, true};
  }
  Hit hit_at(std::uint64_t number, vec3) const {
    Hit hit;
    hit.kind = PrimitiveKind::sphere;
    hit.primitive = static_cast<std::uint32_t>(number);
    return hit;
  }

  template <class Emits, class Add>
  void for_each_light(Emits emits, Add add, const Progress*) const {
    for (std::size_t i = 0; i < spheres.size(); ++i)
      if (emits(materials[i]))
        add(i, 1, materials[i], [&](const EmitterRadiance& radiance) {
          const LightRadiance sent = radiance.over_chart(EmissionChart::sphere);
          SphereLight light{spheres[i].center, spheres[i].radius, sent.mean, sent.two_sided};
          light.set_picture(sent.picture, local_from_world[i]);
          return light;
        });
  }

private:
  /// Before the point is far from the origin: both ends of the ray's way are exact, their sum is not.
  vec3 from_center(const Ray& ray, const Hit& hit) const {
    return (ray.origin - spheres[hit.primitive].center) + hit.t * ray.direction;
  }
  /// A similarity keeps spheres round: all columns of one length and perpendicular, to float precision.
  static bool is_similarity(const mat4& m) {
    vec3 x(m[0]), y(m[1]), z(m[2]);
    float a = length_squared(x), tolerance = 1e-5f * a;
    return std::abs(length_squared(y) - a) <= tolerance && std::abs(length_squared(z) - a) <= tolerance &&
           std::abs(glm::dot(x, y)) <= tolerance && std::abs(glm::dot(y, z)) <= tolerance &&
           std::abs(glm::dot(z, x)) <= tolerance;
  }
};

} // namespace candela
