#pragma once
// What the instances of a scene become: one acceleration structure and, per primitive, what shading needs. It
// depends on shapes, transforms and the materials' indices, not on the materials themselves, so edits of
// those keep it.

#include "render/world/surface_kinds.h"

namespace candela {

class Geometry {
public:
  using Object = MeshObject;
  using Placed = PlacedObject;
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
  /// Whether anything depends on the time of the ray.
  bool moves() const {
    return surfaces_.of<MovingInstanceSurfaces>().count() + surfaces_.of<MovingTriangleSurfaces>().count() >
           0;
  }
  /// Whether any triangle has vertices' normals.
  bool has_smooth_triangles() const { return has_smooth_triangles_; }
  /// The triangle of a hit of `ray`, if its vertices have normals.
  std::optional<SmoothTriangle> smooth_triangle(const Ray& ray, const Hit& hit) const;
  /// Material index of a hit, without the rest: what opacity needs. Most are triangles.
  std::uint32_t material_of(const Hit& hit) const {
    if (hit.kind == PrimitiveKind::triangle && hit.instance == kNoInstance)
      return world().materials[hit.primitive];
    return other_material_of(hit);
  }
  /// Number among all primitives, as SurfaceInteraction::emitter.
  std::uint64_t number_of(const Hit& hit) const;
  /// Of a hit of an instance of a mesh: the triangle's index among those of its instance.
  std::uint32_t triangle_of_instance(const Hit& hit) const;
  /// Index into the instances that were built from.
  std::uint32_t instance_of(const Hit& hit) const;

  Bounds3 bounds() const { return accel_.bounds(); }
  /// Without planes, which are endless: the size of what is looked at.
  Bounds3 finite_bounds() const { return finite_bounds_; }
  std::size_t memory_bytes() const;

  /// Every primitive that could emit has a number: world triangles, then spheres, discs, then triangles of
  /// instances, which may be more than 2^32, then segments of curves.
  std::uint64_t emitter_count() const { return surfaces_.count(); }
  /// The hit of a ray that starts at the point, which lies on the primitive of that number.
  Hit hit_at(std::uint64_t emitter, vec3 point) const;

  const SurfaceKinds& surfaces() const { return surfaces_; }
  const TriangleSet& world() const { return surfaces_.of<TriangleSurfaces>().set; }
  const std::vector<RectangleGeometry>& rectangles() const {
    return surfaces_.of<TriangleSurfaces>().rectangles;
  }
  const std::vector<SphereGeometry>& spheres() const { return surfaces_.of<SphereSurfaces>().spheres; }
  const std::vector<DiscGeometry>& discs() const { return surfaces_.of<DiscSurfaces>().discs; }
  const CurveSurfaces& curves() const { return surfaces_.of<CurveSurfaces>(); }
  const std::vector<Placed>& placed() const { return surfaces_.of<InstanceSurfaces>().placed; }
  const Objects& objects() const { return surfaces_.of<InstanceSurfaces>().objects; }

private:
  friend class GeometryBuilder;
  std::uint32_t other_material_of(const Hit& hit) const;

  SurfaceKinds surfaces_; ///< accel_ refers to the objects' trees
  BuildQuality quality_ = BuildQuality::high;
  Accel accel_;
  Bounds3 finite_bounds_;
  bool has_smooth_triangles_ = false;
};

} // namespace candela
