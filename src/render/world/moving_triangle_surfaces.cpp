#include "render/world/moving_triangle_surfaces.h"

#include <algorithm>

namespace candela {

bool MovingTriangleSurfaces::add(const Instance& instance, std::uint32_t index) {
  const auto* shape = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
  if (shape == nullptr || !(*shape)->deforms()) return false;
  const Mesh& mesh = **shape;
  const mat4& m = instance.world_from_object;
  const mat3 normal_to_world = glm::transpose(glm::inverse(mat3(m)));
  first_triangle_of.push_back(static_cast<std::uint32_t>(set.triangles.size()));
  triangle_instances.push_back(index);
  const std::size_t base = set.positions.size(), n = base + mesh.positions.size();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    set.positions.push_back(transform_point(m, mesh.positions[i]));
    positions_end.push_back(transform_point(m, mesh.positions_end[i]));
  }
  // Where only some of the meshes have an attribute, the others have zeros.
  auto add_normals = [&](const std::vector<vec3>& from, std::vector<vec3>& to) {
    if (from.empty() && to.empty()) return;
    to.resize(base, vec3(0));
    for (const vec3 normal : from) {
      const vec3 w = normal_to_world * normal;
      to.push_back(length_squared(w) > 0 ? glm::normalize(w) : vec3(0));
    }
    to.resize(n, vec3(0));
  };
  add_normals(mesh.normals, set.normals);
  add_normals(mesh.normals_end, normals_end);
  if (!mesh.uvs.empty() || !set.uvs.empty()) {
    set.uvs.resize(base, vec2(0));
    set.uvs.insert(set.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    set.uvs.resize(n, vec2(0));
  }
  // A mirroring transform turns the winding around; turn it back so that outside stays outside.
  const bool mirrored = glm::determinant(mat3(m)) < 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    uvec3 t = mesh.triangles[i] + static_cast<std::uint32_t>(base);
    if (mirrored) std::swap(t.y, t.z);
    set.triangles.push_back(t);
    const std::size_t slot = mesh.material_slots.empty() ? 0 : mesh.material_slots[i];
    set.materials.push_back(static_cast<std::uint32_t>(instance.materials[slot]));
  }
  return true;
}

std::size_t MovingTriangleSurfaces::mesh_of(const Hit& hit) const {
  const auto next = std::ranges::upper_bound(first_triangle_of, hit.primitive);
  return static_cast<std::size_t>(next - first_triangle_of.begin()) - 1;
}

std::array<vec3, 3> MovingTriangleSurfaces::corners(const Hit& hit, float time) const {
  const uvec3 t = set.triangles[hit.primitive];
  std::array<vec3, 3> p;
  for (int k = 0; k < 3; ++k)
    p[static_cast<std::size_t>(k)] = at_time(set.positions[t[k]], positions_end[t[k]], time);
  return p;
}

/// Of unit length, as those of a mesh that stands still. Nothing where the triangle is flat, as
/// TriangleSet::smooth_normal has it.
std::optional<std::array<vec3, 3>> MovingTriangleSurfaces::corner_normals(const Hit& hit, float time) const {
  if (set.normals.empty()) return std::nullopt;
  const uvec3 t = set.triangles[hit.primitive];
  std::array<vec3, 3> n;
  for (int k = 0; k < 3; ++k) {
    if (is_black(set.normals[t[k]]) || is_black(normals_end[t[k]])) return std::nullopt;
    const vec3 normal = at_time(set.normals[t[k]], normals_end[t[k]], time);
    if (!(length_squared(normal) > 0)) return std::nullopt;
    n[static_cast<std::size_t>(k)] = glm::normalize(normal);
  }
  return n;
}

void MovingTriangleSurfaces::set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const {
  const auto p = corners(hit, ray.time);
  const TrianglePoint point = triangle_point(p[0], p[1], p[2], hit.u, hit.v);
  s.position = point.position;
  s.position_error = point.error;
  s.geometric_normal = point.normal;
  const auto n = corner_normals(hit, ray.time);
  s.shading_normal =
      n ? shading_normal(interpolate((*n)[0], (*n)[1], (*n)[2], hit.u, hit.v), point.normal) : point.normal;
}

std::optional<SmoothTriangle> MovingTriangleSurfaces::smooth_triangle(const Ray& ray, const Hit& hit) const {
  const auto n = corner_normals(hit, ray.time);
  if (!n) return std::nullopt;
  const vec3 smooth = interpolate((*n)[0], (*n)[1], (*n)[2], hit.u, hit.v);
  if (is_black(smooth)) return std::nullopt;
  return SmoothTriangle{corners(hit, ray.time), *n, smooth};
}

SurfaceTangents MovingTriangleSurfaces::tangents(const Ray& ray, const Hit& hit) const {
  const auto p = corners(hit, ray.time);
  return set.tangents(set.triangles[hit.primitive], p[1] - p[0], p[2] - p[0]);
}

Hit MovingTriangleSurfaces::hit_at(std::uint64_t number, vec3 point) const {
  Hit hit = set.hit_at(static_cast<std::uint32_t>(number), point);
  hit.kind = PrimitiveKind::moving_triangle;
  return hit;
}

} // namespace candela
