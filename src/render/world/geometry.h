#pragma once
// What the instances of a scene become: one acceleration structure and, per primitive, what shading needs. It
// depends on shapes, transforms and the materials' indices, not on the materials themselves, so edits of
// those keep it.

#include "accel/accel.h"
#include "render/world/surface_interaction.h"
#include "scene/scene_desc.h"

namespace candela {

/// Triangles in world space (small meshes, rectangles) or in the space of an object.
struct TriangleSet {
  std::vector<vec3> positions;
  std::vector<vec3> normals; ///< parallel to positions if not empty; a zero one means flat
  std::vector<vec2> uvs;     ///< parallel to positions if not empty
  std::vector<uvec3> triangles;
  std::vector<std::uint32_t> materials; ///< per triangle: a material, or a slot for objects

  /// The vertices' normals at barycentric coordinates, not of unit length; zero where the triangle is flat,
  /// as it is if a vertex has none.
  vec3 smooth_normal(uvec3 t, float u, float v) const {
    if (normals.empty()) return vec3(0);
    vec3 n0 = normals[t.x], n1 = normals[t.y], n2 = normals[t.z];
    if (is_black(n0) || is_black(n1) || is_black(n2)) return vec3(0);
    return (1 - u - v) * n0 + u * n1 + v * n2;
  }
};

/// A placed rectangle, as a light samples it whole rather than as its two triangles.
struct RectangleGeometry {
  vec3 corner, edge_x, edge_y;  ///< edge_x x edge_y points along the normal
  std::uint32_t first_triangle; ///< of two
};

class Geometry {
public:
  /// A mesh with a tree of its own: it stays as it is while its instances move.
  struct Object {
    std::shared_ptr<const Mesh> mesh; ///< what it was made of
    TriangleSet set;
    Accel accel;
  };
  using Objects = std::vector<std::shared_ptr<const Object>>;

  /// Bakes and builds. Spheres and discs that their transform would make ellipsoids are made of triangles, as
  /// are all shapes of render/world/shape_mesh.h. Objects of `known` are taken over rather than built. Fast:
  /// where it saves much, meshes become objects though they are placed once, so that moving known ones takes
  /// milliseconds; but then rays take longer, and what they meet is rounded differently. Throws Cancelled
  /// soon after `progress` is told to end; it may be null.
  static std::shared_ptr<const Geometry> build(const std::vector<Instance>& instances,
                                               BuildQuality quality = BuildQuality::high,
                                               Progress* progress = nullptr, const Objects& known = {});

  /// Fast only where that made a difference.
  BuildQuality quality() const { return quality_; }
  const Accel& accel() const { return accel_; }
  /// Fills in the rest of what is known about a hit of `ray`.
  SurfaceInteraction surface(const Ray& ray, const Hit& hit) const;
  /// Texture coordinates of a hit of `ray`, in the shape's own space: they go wherever its transform takes
  /// it. (0, 0) on meshes that have none. Apart from the rest, which most surfaces are content with.
  vec2 uv(const Ray& ray, const Hit& hit) const;
  /// How the texture coordinates of uv() change about a hit of `ray`: apart from the rest likewise.
  SurfaceTangents tangents(const Ray& ray, const Hit& hit) const;
  /// Material index of a hit, without the rest: what opacity needs.
  std::uint32_t material_of(const Hit& hit) const;
  /// Index into the instances that were built from.
  std::uint32_t instance_of(const Hit& hit) const;

  Bounds3 bounds() const { return accel_.bounds(); }
  /// Without planes, which are endless: the size of what is looked at.
  Bounds3 finite_bounds() const { return finite_bounds_; }
  std::size_t memory_bytes() const;

  /// Every primitive that could emit has a number: world triangles, then spheres, discs, then triangles of
  /// instances, which may be more than 2^32.
  std::uint64_t emitter_count() const { return emitter_count_; }
  std::uint64_t sphere_emitter(std::size_t i) const { return world_.triangles.size() + i; }
  std::uint64_t disc_emitter(std::size_t i) const { return sphere_emitter(spheres_.size()) + i; }

  struct Placed { ///< an instance of an object
    std::uint32_t object;
    mat4 world_from_object, object_from_world;
    mat3 normal_to_world; ///< inverse transpose
    std::vector<std::uint32_t> slot_materials;
    std::uint64_t first_emitter;
    std::uint32_t instance;
  };
  const TriangleSet& world() const { return world_; }
  const std::vector<SphereGeometry>& spheres() const { return spheres_; }
  const std::vector<DiscGeometry>& discs() const { return discs_; }
  const std::vector<std::uint32_t>& sphere_materials() const { return sphere_materials_; }
  const std::vector<std::uint32_t>& disc_materials() const { return disc_materials_; }
  const std::vector<RectangleGeometry>& rectangles() const { return rectangles_; }
  const std::vector<Placed>& placed() const { return placed_; }
  const Objects& objects() const { return objects_; }

private:
  friend class GeometryBuilder;
  struct DiscAxes { ///< where its x and y lie in the world, divided by the square of its radius
    vec3 x, y;
  };
  struct TriangleRange {
    std::uint32_t begin, end;
  };
  bool is_ellipsoid(std::uint32_t world_triangle) const;

  TriangleSet world_;
  std::vector<std::uint32_t> first_triangle_of_; ///< sorted, parallel to triangle_instances_
  std::vector<std::uint32_t> triangle_instances_;
  std::vector<SphereGeometry> spheres_;
  std::vector<DiscGeometry> discs_;
  std::vector<std::uint32_t> sphere_materials_, disc_materials_, sphere_instances_, disc_instances_;
  std::vector<mat3> sphere_from_world_;   ///< turns (and mirrors) directions, parallel to spheres_
  std::vector<DiscAxes> disc_axes_;       ///< parallel to discs_
  std::vector<TriangleRange> ellipsoids_; ///< spheres that are world triangles, sorted
  std::vector<RectangleGeometry> rectangles_;
  Objects objects_; ///< accel_ refers to theirs
  std::vector<Placed> placed_;
  std::uint64_t emitter_count_ = 0;
  BuildQuality quality_ = BuildQuality::high;
  Accel accel_;
  Bounds3 finite_bounds_;
};

} // namespace candela
