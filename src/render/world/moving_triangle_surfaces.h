#pragma once
// Meshes that deform while the shutter is open.

#include "render/world/smooth_triangle.h"
#include "render/world/surface_kind.h"
#include "render/world/triangle_set.h"

namespace candela {

/// A SurfaceKind: triangles whose vertices move on straight lines, with their normals. Surfaces are those at
/// the time of the ray.
///
/// What emits is not sampled as a light: only rays that meet it find it.
struct MovingTriangleSurfaces {
  using Primitives = primitives::MovingTriangles;

  TriangleSet set;                              ///< world space, at time 0
  std::vector<vec3> positions_end, normals_end; ///< at time 1, parallel to those of `set`
  std::vector<std::uint32_t> first_triangle_of; ///< sorted, parallel to triangle_instances
  std::vector<std::uint32_t> triangle_instances;

  /// Whether the instance is one, which is then added.
  bool add(const Instance& instance, std::uint32_t index);

  std::uint64_t count() const { return set.triangles.size(); }
  Primitives::Input input() const { return {set.positions, positions_end, set.triangles}; }
  std::size_t memory_bytes() const {
    return set.memory_bytes() + (positions_end.size() + normals_end.size()) * sizeof(vec3);
  }
  bool has_smooth() const { return !set.normals.empty(); }

  std::uint32_t material_of(const Hit& hit) const { return set.materials[hit.primitive]; }
  std::uint32_t instance_of(const Hit& hit) const { return triangle_instances[mesh_of(hit)]; }
  std::uint64_t number_of(const Hit& hit) const { return hit.primitive; }
  std::uint32_t triangle_of_instance(const Hit& hit) const {
    return hit.primitive - first_triangle_of[mesh_of(hit)];
  }

  void set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const;
  std::optional<SmoothTriangle> smooth_triangle(const Ray& ray, const Hit& hit) const;
  vec2 uv(const Ray&, const Hit& hit) const { return set.uv(hit); }
  SurfaceTangents tangents(const Ray& ray, const Hit& hit) const;
  /// As of time 0.
  Hit hit_at(std::uint64_t number, vec3 point) const;

  template <class Emits, class Add>
  void for_each_light(Emits, Add, const Progress*) const {}

private:
  std::size_t mesh_of(const Hit& hit) const;
  std::array<vec3, 3> corners(const Hit& hit, float time) const;
  std::optional<std::array<vec3, 3>> corner_normals(const Hit& hit, float time) const;
};

} // namespace candela
