#pragma once
// Strands of hair: tubes and ribbons along curves.

#include "render/world/emission_table.h"
#include "render/world/surface_kind.h"

namespace candela {

/// A SurfaceKind. Texture coordinates: u along the strand, from root to tip; v across it as the ray sees it,
/// 0 and 1 at its edges, growing along the cross product of the strand's direction and the ray's. So v tells
/// where a ray passes through a hair (Hair::h = 2 v - 1).
///
/// Curves that emit are not sampled as lights: only rays that meet them find them.
struct CurveSurfaces {
  using Primitives = primitives::Curves;
  struct Placed { ///< a shape
    std::uint32_t material, instance;
  };
  struct Part { ///< a segment's share of its strand
    float u_begin, u_end;
    std::uint32_t shape; ///< index into shapes
  };

  std::vector<CurveSegment> segments;
  std::vector<Part> parts; ///< parallel to segments
  std::vector<Placed> shapes;

  /// Whether the instance is one, which is then added. Widths grow with its transform by the cube root of its
  /// determinant: tubes stay round.
  bool add(const Instance& instance, std::uint32_t index);

  std::uint64_t count() const { return segments.size(); }
  Primitives::Input input() const { return {segments}; }
  std::size_t memory_bytes() const { return segments.size() * (sizeof(CurveSegment) + sizeof(Part)); }

  std::uint32_t material_of(const Hit& hit) const { return shapes[parts[hit.primitive].shape].material; }
  std::uint32_t instance_of(const Hit& hit) const { return shapes[parts[hit.primitive].shape].instance; }
  std::uint64_t number_of(const Hit& hit) const { return hit.primitive; }

  /// The normal of a tube is that of its surface, that of a ribbon faces the ray, across the strand.
  void set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const;
  vec2 uv(const Ray& ray, const Hit& hit) const;
  SurfaceTangents tangents(const Ray& ray, const Hit& hit) const;
  /// Near the point, along the chord of the segment.
  Hit hit_at(std::uint64_t number, vec3 point) const;

  template <class Emits, class Add>
  void for_each_light(Emits, Add, const Progress*) const {}
};

} // namespace candela
