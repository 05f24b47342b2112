#pragma once
// Triangles that lie in the world: small meshes, rectangles, and what other shapes are tessellated to.

#include "lights/rectangle_light.h"
#include "lights/triangle_light.h"
#include "render/world/smooth_triangle.h"
#include "render/world/sphere_uv.h"
#include "render/world/surface_kind.h"
#include "render/world/triangle_set.h"

#include <algorithm>

namespace candela {

/// A placed rectangle, as a light samples it whole rather than as its two triangles.
struct RectangleGeometry {
  vec3 corner, edge_x, edge_y;  ///< edge_x x edge_y points along the normal
  std::uint32_t first_triangle; ///< of two

  /// Sheared ones are left to their triangles.
  bool is_light() const {
    const float lengths = glm::length(edge_x) * glm::length(edge_y);
    return !(std::abs(glm::dot(edge_x, edge_y)) > 1e-6f * lengths) &&
           length_squared(glm::cross(edge_x, edge_y)) > 0;
  }
};

/// A SurfaceKind.
struct TriangleSurfaces {
  using Primitives = primitives::Triangles;
  struct Range {
    std::uint32_t begin, end;
  };

  TriangleSet set; ///< world space
  std::vector<RectangleGeometry> rectangles;
  std::vector<Range> ellipsoids;                ///< spheres that are triangles, sorted
  std::vector<std::uint32_t> first_triangle_of; ///< sorted, parallel to triangle_instances
  std::vector<std::uint32_t> triangle_instances;

  std::uint64_t count() const { return set.triangles.size(); }
  Primitives::Input input() const { return {set.positions, set.triangles}; }
  std::size_t memory_bytes() const { return set.memory_bytes(); }

  std::uint32_t material_of(const Hit& hit) const { return set.materials[hit.primitive]; }
  std::uint32_t instance_of(const Hit& hit) const {
    const auto next = std::upper_bound(first_triangle_of.begin(), first_triangle_of.end(), hit.primitive);
    return triangle_instances[static_cast<std::size_t>(next - first_triangle_of.begin()) - 1];
  }
  std::uint64_t number_of(const Hit& hit) const { return hit.primitive; }
  /// The number of a triangle among those of its instance.
  std::uint32_t triangle_of_instance(const Hit& hit) const {
    return hit.primitive - *std::prev(std::ranges::upper_bound(first_triangle_of, hit.primitive));
  }

  void set_surface(const Ray&, const Hit& hit, SurfaceInteraction& s) const {
    const uvec3 t = set.triangles[hit.primitive];
    const TrianglePoint p = set.point(t, hit.u, hit.v);
    s.position = p.position;
    s.position_error = p.error;
    s.geometric_normal = p.normal;
    s.shading_normal = shading_normal(set.smooth_normal(t, hit.u, hit.v), p.normal);
  }
  bool has_smooth() const { return !set.normals.empty(); }
  std::optional<SmoothTriangle> smooth_triangle(const Ray&, const Hit& hit) const {
    const uvec3 t = set.triangles[hit.primitive];
    const vec3 smooth = set.smooth_normal(t, hit.u, hit.v);
    if (is_black(smooth)) return std::nullopt;
    return SmoothTriangle{{set.positions[t.x], set.positions[t.y], set.positions[t.z]},
                          {set.normals[t.x], set.normals[t.y], set.normals[t.z]},
                          smooth};
  }
  vec2 uv(const Ray&, const Hit& hit) const {
    if (!is_ellipsoid(hit.primitive)) return set.uv(hit);
    const uvec3 t = set.triangles[hit.primitive]; // not linear in them: the same as on a sphere
    auto direction = [&](std::uint32_t vertex) { return sphere_direction(set.uvs[vertex]); };
    return sphere_uv(interpolate(direction(t.x), direction(t.y), direction(t.z), hit.u, hit.v));
  }
  SurfaceTangents tangents(const Ray&, const Hit& hit) const {
    const uvec3 t = set.triangles[hit.primitive];
    const vec3 edge1 = set.positions[t.y] - set.positions[t.x],
               edge2 = set.positions[t.z] - set.positions[t.x];
    if (!is_ellipsoid(hit.primitive)) return set.tangents(t, edge1, edge2);
    const vec3 da = sphere_direction(set.uvs[t.x]), db = sphere_direction(set.uvs[t.y]) - da,
               dc = sphere_direction(set.uvs[t.z]) - da;
    const vec3 d = da + hit.u * db + hit.v * dc;
    return tangents_from(edge1, edge2, sphere_uv_derivative(d, db), sphere_uv_derivative(d, dc),
                         glm::normalize(glm::cross(edge1, edge2)));
  }
  Hit hit_at(std::uint64_t number, vec3 point) const {
    return set.hit_at(static_cast<std::uint32_t>(number), point);
  }

  /// Rectangles first, each as one light.
  template <class Emits, class Add>
  void for_each_light(Emits emits, Add add, const Progress* progress) const {
    for (const RectangleGeometry& r : rectangles) {
      const std::uint32_t material = set.materials[r.first_triangle];
      if (!emits(material) || !r.is_light()) continue;
      add(r.first_triangle, 2, material, [&](const EmitterRadiance& radiance) {
        const bool mirrored = set.uvs[set.triangles[r.first_triangle].x].x > 0.5f;
        const LightRadiance sent =
            radiance.over_chart(mirrored ? EmissionChart::mirrored_rectangle : EmissionChart::rectangle);
        return RectangleLight(r.corner, r.edge_x, r.edge_y, sent.mean, sent.two_sided, sent.picture);
      });
    }
    auto rectangle = rectangles.begin(); // they are sorted
    for (std::uint32_t i = 0; i < set.triangles.size(); ++i) {
      check_now_and_then(progress, i);
      while (rectangle != rectangles.end() && rectangle->first_triangle + 2 <= i) ++rectangle;
      const std::uint32_t material = set.materials[i];
      if (!emits(material)) continue;
      if (rectangle != rectangles.end() && rectangle->first_triangle <= i && rectangle->is_light()) continue;
      const uvec3 t = set.triangles[i];
      const vec3 p0 = set.positions[t.x], p1 = set.positions[t.y], p2 = set.positions[t.z];
      auto uv_at = [&](vec2 barycentric) {
        Hit hit;
        hit.kind = PrimitiveKind::triangle, hit.primitive = i, hit.u = barycentric.x, hit.v = barycentric.y;
        return uv({}, hit);
      };
      add_triangle_light(i, material, p0, p1, p2, glm::cross(p1 - p0, p2 - p0), uv_at, add);
    }
  }

private:
  bool is_ellipsoid(std::uint32_t triangle) const {
    const auto next = std::ranges::upper_bound(ellipsoids, triangle, {}, &Range::begin);
    return next != ellipsoids.begin() && triangle < std::prev(next)->end;
  }
};

} // namespace candela
