#pragma once
// Placed copies of meshes that have a tree of their own.

#include "render/world/smooth_triangle.h"
#include "render/world/surface_kind.h"
#include "render/world/triangle_set.h"

#include <algorithm>
#include <memory>

namespace candela {

/// A mesh with a tree of its own: it stays as it is while its instances move.
struct MeshObject {
  std::shared_ptr<const Mesh> mesh; ///< what it was made of
  TriangleSet set;
  Accel accel;
};

/// An instance of an object.
struct PlacedObject {
  std::uint32_t object;
  mat4 world_from_object, object_from_world;
  mat3 normal_to_world; ///< inverse transpose
  std::vector<std::uint32_t> slot_materials;
  std::uint64_t first_number; ///< of its triangles, among those of all instances
  std::uint32_t instance;
};

/// A SurfaceKind. Its hits are triangles of an instance.
struct InstanceSurfaces {
  using Primitives = primitives::Instances;

  std::vector<std::shared_ptr<const MeshObject>> objects;
  std::vector<PlacedObject> placed;
  std::uint64_t triangle_count = 0; ///< of all instances

  std::uint64_t count() const { return triangle_count; }
  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& object : objects) bytes += object->set.memory_bytes() + object->accel.memory_bytes();
    return bytes;
  }

  const TriangleSet& set_of(const Hit& hit) const { return objects[placed[hit.instance].object]->set; }
  std::uint32_t material_of(const Hit& hit) const {
    return placed[hit.instance].slot_materials[set_of(hit).materials[hit.primitive]];
  }
  std::uint32_t instance_of(const Hit& hit) const { return placed[hit.instance].instance; }
  std::uint64_t number_of(const Hit& hit) const { return placed[hit.instance].first_number + hit.primitive; }

  void set_surface(const Ray&, const Hit& hit, SurfaceInteraction& s) const {
    const PlacedObject& p = placed[hit.instance];
    const TriangleSet& set = set_of(hit);
    const uvec3 t = set.triangles[hit.primitive];
    const TrianglePoint local = set.point(t, hit.u, hit.v);
    const mat4& m = p.world_from_object;
    // The error of the object-space point, transformed, and that of transforming it (pbrt-v4, section 6.8.4).
    mat3 abs_m(glm::abs(vec3(m[0])), glm::abs(vec3(m[1])), glm::abs(vec3(m[2])));
    s.position_error = (gamma_bound(3) + 1) * (abs_m * local.error) +
                       gamma_bound(3) * (abs_m * glm::abs(local.position) + glm::abs(vec3(m[3])));
    s.position = transform_point(m, local.position);
    s.geometric_normal = glm::normalize(p.normal_to_world * local.normal);
    s.shading_normal =
        shading_normal(p.normal_to_world * set.smooth_normal(t, hit.u, hit.v), s.geometric_normal);
  }
  bool has_smooth() const {
    return std::ranges::any_of(objects, [](const auto& object) { return !object->set.normals.empty(); });
  }
  std::optional<SmoothTriangle> smooth_triangle(const Ray&, const Hit& hit) const {
    const PlacedObject& p = placed[hit.instance];
    const TriangleSet& set = set_of(hit);
    const uvec3 t = set.triangles[hit.primitive];
    const vec3 smooth = set.smooth_normal(t, hit.u, hit.v);
    if (is_black(smooth)) return std::nullopt;
    SmoothTriangle s;
    for (int i = 0; i < 3; ++i) {
      const auto corner = static_cast<std::size_t>(i);
      s.positions[corner] = transform_point(p.world_from_object, set.positions[t[i]]);
      s.normals[corner] = glm::normalize(p.normal_to_world * set.normals[t[i]]);
    }
    s.smooth_normal = p.normal_to_world * smooth;
    return s;
  }
  vec2 uv(const Ray&, const Hit& hit) const { return set_of(hit).uv(hit); }
  SurfaceTangents tangents(const Ray&, const Hit& hit) const {
    const TriangleSet& set = set_of(hit);
    const uvec3 t = set.triangles[hit.primitive];
    const mat4& m = placed[hit.instance].world_from_object;
    return set.tangents(t, transform_vector(m, set.positions[t.y] - set.positions[t.x]),
                        transform_vector(m, set.positions[t.z] - set.positions[t.x]));
  }
  Hit hit_at(std::uint64_t number, vec3 point) const {
    // The last instance that begins at or before the number.
    const auto next = std::ranges::upper_bound(placed, number, {}, &PlacedObject::first_number);
    const PlacedObject& p = *std::prev(next);
    Hit hit = objects[p.object]->set.hit_at(static_cast<std::uint32_t>(number - p.first_number),
                                            transform_point(p.object_from_world, point));
    hit.instance = static_cast<std::uint32_t>(&p - placed.data());
    return hit;
  }

  template <class Emits, class Add>
  void for_each_light(Emits emits, Add add, const Progress* progress) const {
    for (const PlacedObject& p : placed) {
      if (std::ranges::none_of(p.slot_materials, emits)) continue;
      const TriangleSet& set = objects[p.object]->set;
      for (std::uint32_t i = 0; i < set.triangles.size(); ++i) {
        check_now_and_then(progress, i);
        const std::uint32_t material = p.slot_materials[set.materials[i]];
        if (!emits(material)) continue;
        const uvec3 t = set.triangles[i];
        const vec3 p0 = set.positions[t.x], p1 = set.positions[t.y], p2 = set.positions[t.z];
        const mat4& w = p.world_from_object;
        auto uv_at = [&](vec2 barycentric) {
          Hit hit;
          hit.kind = PrimitiveKind::triangle, hit.primitive = i;
          hit.u = barycentric.x, hit.v = barycentric.y;
          return set.uv(hit);
        };
        add_triangle_light(p.first_number + i, material, transform_point(w, p0), transform_point(w, p1),
                           transform_point(w, p2), p.normal_to_world * glm::cross(p1 - p0, p2 - p0), uv_at,
                           add);
      }
    }
  }
};

} // namespace candela
