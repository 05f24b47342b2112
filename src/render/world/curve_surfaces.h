#pragma once
// Strands of hair: tubes and ribbons along curves.

#include "lights/curve_light.h"
#include "render/world/emission_table.h"
#include "render/world/surface_kind.h"

namespace candela {

/// A SurfaceKind. Texture coordinates: u along the strand, from root to tip; v across it as the ray sees it,
/// 0 and 1 at its edges, growing along the cross product of the strand's direction and the ray's. So v tells
/// where a ray passes through a hair (Hair::h = 2 v - 1).
///
/// Each piece of a curve that emits evenly is a light. Neighbours overlap, so that there is no gap between
/// them, and where strands have a corner both have the ball there: such a place counts as that of one of
/// them.
struct CurveSurfaces final : CurvePieces {
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
  std::uint64_t number_of(const Hit& hit) const { return owner(hit.primitive, hit.u); }

  /// The normal of a tube is that of its surface, that of a ribbon faces the ray, across the strand.
  void set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const;
  vec2 uv(const Ray& ray, const Hit& hit) const;
  SurfaceTangents tangents(const Ray& ray, const Hit& hit) const;
  /// Near the point, along the chord of the segment.
  Hit hit_at(std::uint64_t number, vec3 point) const;

  std::optional<Meeting> meet(std::uint32_t piece, vec3 from, vec3 direction) const override;
  /// Not of curves whose radiance or opacity a texture gives, for what it gives depends on the ray, nor of
  /// those that let light through, for behind its first point the ray may meet the same piece again: only
  /// rays that meet them find them.
  template <class Emits, class Add>
  void for_each_light(Emits emits, Add add, const Progress* progress) const {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      check_now_and_then(progress, i);
      const std::uint32_t material = shapes[parts[i].shape].material;
      if (emits(material))
        add(i, 1, material, [&](const EmitterRadiance& radiance) { return light_of_piece(i, radiance); });
    }
  }

private:
  /// The piece that a place counts as, by what meets it and where.
  std::uint32_t owner(std::uint32_t piece, float u) const {
    const bool first = parts[piece].u_begin == 0, last = parts[piece].u_end == 1;
    if (u > 1 && !last) return piece + 1;
    if (u < 0 && !first) return piece - 1;
    const bool corner = u == 0 && !first && (segments[piece].flags & CurveSegment::closed_start);
    return corner ? piece - 1 : piece;
  }
  std::optional<CurveLight> light_of_piece(std::size_t piece, const EmitterRadiance& radiance) const;
};

} // namespace candela
