#pragma once
// Discs that are no triangles: those that their transform keeps round.

#include "lights/disc_light.h"
#include "render/world/emission_table.h"
#include "render/world/surface_kind.h"

namespace candela {

/// A SurfaceKind.
struct DiscSurfaces {
  using Primitives = primitives::Discs;
  struct Axes { ///< where its x and y lie in the world, divided by the square of its radius
    vec3 x, y;
  };

  std::vector<DiscGeometry> discs;
  std::vector<Axes> axes;
  std::vector<std::uint32_t> materials, instances;

  /// Whether the instance is one, which is then added.
  bool add(const Instance& instance, std::uint32_t index) {
    if (!std::holds_alternative<DiscShape>(instance.shape)) return false;
    const mat4& m = instance.world_from_object;
    const vec3 x(m[0]), y(m[1]);
    const float a = length_squared(x);
    const bool round = std::abs(length_squared(y) - a) <= 1e-5f * a && std::abs(glm::dot(x, y)) <= 1e-5f * a;
    if (!round) return false;
    vec3 normal = glm::normalize(glm::cross(x, y));
    if (glm::dot(normal, vec3(m[2])) < 0) normal = -normal; // the image of +z, also of a mirroring transform
    discs.push_back({vec3(m[3]), glm::length(x), normal});
    axes.push_back({x / length_squared(x), y / length_squared(y)});
    materials.push_back(static_cast<std::uint32_t>(instance.materials[0]));
    instances.push_back(index);
    return true;
  }

  std::uint64_t count() const { return discs.size(); }
  Primitives::Input input() const { return {discs}; }
  std::size_t memory_bytes() const {
    return discs.size() * (sizeof(DiscGeometry) + sizeof(Axes) + 2 * sizeof(std::uint32_t));
  }

  std::uint32_t material_of(const Hit& hit) const { return materials[hit.primitive]; }
  std::uint32_t instance_of(const Hit& hit) const { return instances[hit.primitive]; }
  std::uint64_t number_of(const Hit& hit) const { return hit.primitive; }

  void set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const {
    const DiscGeometry& disc = discs[hit.primitive];
    s.geometric_normal = s.shading_normal = disc.normal;
    vec3 p = ray.at(hit.t);
    s.position = p - disc.normal * glm::dot(p - disc.center, disc.normal); // into the plane
    s.position_error = gamma_bound(8) * (glm::abs(s.position) + glm::abs(disc.center) + disc.radius);
  }
  vec2 uv(const Ray& ray, const Hit& hit) const {
    // Relative to the centre before the point is far from the origin: both ends of the ray's way are exact,
    // their sum is not.
    const vec3 p = (ray.origin - discs[hit.primitive].center) + hit.t * ray.direction;
    const Axes& a = axes[hit.primitive];
    return 0.5f * vec2(glm::dot(p, a.x), glm::dot(p, a.y)) + 0.5f;
  }
  SurfaceTangents tangents(const Ray&, const Hit& hit) const {
    const Axes& a = axes[hit.primitive];
    return {2.0f * a.x / length_squared(a.x), 2.0f * a.y / length_squared(a.y), true};
  }
  Hit hit_at(std::uint64_t number, vec3) const {
    Hit hit;
    hit.kind = PrimitiveKind::disc;
    hit.primitive = static_cast<std::uint32_t>(number);
    return hit;
  }

  template <class Emits, class Add>
  void for_each_light(Emits emits, Add add, const Progress*) const {
    for (std::size_t i = 0; i < discs.size(); ++i)
      if (emits(materials[i]))
        add(i, 1, materials[i], [&](const EmitterRadiance& radiance) {
          const LightRadiance sent = radiance.over_chart(EmissionChart::disc);
          DiscLight light{discs[i].center, discs[i].normal, discs[i].radius, sent.mean, sent.two_sided};
          light.set_picture(sent.picture, glm::normalize(axes[i].x), glm::normalize(axes[i].y));
          return light;
        });
  }
};

} // namespace candela
