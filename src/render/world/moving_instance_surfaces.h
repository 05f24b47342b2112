#pragma once
// What moves as a whole while the shutter is open, of whatever shape.

#include "accel/accel.h"
#include "render/world/smooth_triangle.h"
#include "render/world/surface_kind.h"

#include <memory>

namespace candela {

class Geometry;

/// A SurfaceKind. Every moving instance is placed geometry of its own, in its space: the shape alone, as it
/// is rendered where it stands still. Surfaces are those at the time of the ray.
///
/// What emits is not sampled as a light: only rays that meet it find it.
struct MovingInstanceSurfaces {
  using Primitives = primitives::MovingInstances;
  struct Placed {
    std::uint32_t object; ///< index into objects
    MovingTransform placement;
    std::uint64_t first_number; ///< of its primitives, among those of all
    std::uint32_t instance;
  };

  std::vector<std::shared_ptr<const Geometry>> objects;
  std::vector<Placed> placed;
  std::uint64_t primitive_count = 0; ///< of all placed

  /// Places a shape's geometry; `objects` has it already if it is known.
  void place(std::uint32_t object, const Instance& instance, std::uint32_t index);

  std::uint64_t count() const { return primitive_count; }
  std::size_t memory_bytes() const;
  /// For the build of the tree. The objects' trees stay where they are.
  std::vector<MovingInstanceGeometry> geometries() const;
  bool has_smooth() const;

  std::uint32_t material_of(const Hit& hit) const;
  std::uint32_t instance_of(const Hit& hit) const { return of(hit).instance; }
  std::uint64_t number_of(const Hit& hit) const;
  std::uint32_t triangle_of_instance(const Hit& hit) const;

  void set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const;
  std::optional<SmoothTriangle> smooth_triangle(const Ray& ray, const Hit& hit) const;
  vec2 uv(const Ray& ray, const Hit& hit) const;
  SurfaceTangents tangents(const Ray& ray, const Hit& hit) const;
  /// As of time 0.
  Hit hit_at(std::uint64_t number, vec3 point) const;

  template <class Emits, class Add>
  void for_each_light(Emits, Add, const Progress*) const {}

private:
  const Placed& of(const Hit& hit) const { return placed[hit.instance & ~kMovingInstance]; }
};

} // namespace candela
