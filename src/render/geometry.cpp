#include "render/geometry.h"

#include "core/basis.h"
#include "render/triangle_point.h"

namespace candela {

namespace {

vec2 interpolate(const std::vector<vec2>& values, uvec3 t, float u, float v) {
  return (1 - u - v) * values[t.x] + u * values[t.y] + v * values[t.z];
}

} // namespace

Surface Geometry::surface(const Ray& ray, const Hit& hit) const {
  Surface s; // made where the caller wants it: copies of what has just been written by parts stall
  if (hit.kind == PrimitiveKind::triangle) {
    const bool shared = hit.instance != kNoInstance;
    const TriangleSet& set = shared ? objects_[placed_[hit.instance].object]->set : world_;
    const uvec3 t = set.triangles[hit.primitive];
    TrianglePoint p =
        triangle_point(set.positions[t.x], set.positions[t.y], set.positions[t.z], hit.u, hit.v);
    vec3 smooth = set.smooth_normal(t, hit.u, hit.v);
    if (shared) {
      const Placed& placed = placed_[hit.instance];
      const mat4& m = placed.world_from_object;
      // The error of the object-space point, transformed, and that of transforming it (pbrt-v4,
      // section 6.8.4).
      mat3 abs_m(glm::abs(vec3(m[0])), glm::abs(vec3(m[1])), glm::abs(vec3(m[2])));
      p.error = (gamma_bound(3) + 1) * (abs_m * p.error) +
                gamma_bound(3) * (abs_m * glm::abs(p.position) + glm::abs(vec3(m[3])));
      p.position = transform_point(m, p.position);
      p.normal = glm::normalize(placed.normal_to_world * p.normal);
      smooth = placed.normal_to_world * smooth;
      s.material = placed.slot_materials[set.materials[hit.primitive]];
      s.emitter = placed.first_emitter + hit.primitive;
    } else {
      s.material = set.materials[hit.primitive];
      s.emitter = hit.primitive;
    }
    s.position = p.position;
    s.position_error = p.error;
    s.geometric_normal = p.normal;
    s.shading_normal = shading_normal(smooth, p.normal);
    s.uv = set.uvs.empty() ? vec2(hit.u, hit.v) : interpolate(set.uvs, t, hit.u, hit.v);
    return s;
  }
  if (hit.kind == PrimitiveKind::sphere) {
    const SphereGeometry& sphere = spheres_[hit.primitive];
    s.geometric_normal = glm::normalize(ray.at(hit.t) - sphere.center);
    vec3 offset = s.geometric_normal * sphere.radius; // on the sphere again, whatever t had of error
    s.position = sphere.center + offset;
    s.position_error = gamma_bound(6) * (glm::abs(sphere.center) + glm::abs(offset));
    s.uv = vec2(std::atan2(s.geometric_normal.y, s.geometric_normal.x) * (0.5f * kInvPi) + 0.5f,
                std::acos(glm::clamp(s.geometric_normal.z, -1.0f, 1.0f)) * kInvPi);
    s.material = sphere_materials_[hit.primitive];
    s.emitter = sphere_emitter(hit.primitive);
  } else {
    const DiscGeometry& disc = discs_[hit.primitive];
    s.geometric_normal = disc.normal;
    vec3 p = ray.at(hit.t);
    s.position = p - disc.normal * glm::dot(p - disc.center, disc.normal); // into the plane
    s.position_error = gamma_bound(8) * (glm::abs(s.position) + glm::abs(disc.center) + disc.radius);
    Basis frame = Basis::from_normal(disc.normal);
    vec3 local = frame.to_local(s.position - disc.center) / disc.radius;
    s.uv = 0.5f * vec2(local) + 0.5f;
    s.material = disc_materials_[hit.primitive];
    s.emitter = disc_emitter(hit.primitive);
  }
  s.shading_normal = s.geometric_normal;
  return s;
}

std::uint32_t Geometry::material_of(const Hit& hit) const {
  switch (hit.kind) {
  case PrimitiveKind::sphere: return sphere_materials_[hit.primitive];
  case PrimitiveKind::disc: return disc_materials_[hit.primitive];
  case PrimitiveKind::triangle: break;
  }
  if (hit.instance == kNoInstance) return world_.materials[hit.primitive];
  const Placed& p = placed_[hit.instance];
  return p.slot_materials[objects_[p.object]->set.materials[hit.primitive]];
}

std::uint32_t Geometry::instance_of(const Hit& hit) const {
  switch (hit.kind) {
  case PrimitiveKind::sphere: return sphere_instances_[hit.primitive];
  case PrimitiveKind::disc: return disc_instances_[hit.primitive];
  case PrimitiveKind::triangle: break;
  }
  if (hit.instance != kNoInstance) return placed_[hit.instance].instance;
  auto next = std::upper_bound(first_triangle_of_.begin(), first_triangle_of_.end(), hit.primitive);
  return triangle_instances_[static_cast<std::size_t>(next - first_triangle_of_.begin()) - 1];
}

std::size_t Geometry::memory_bytes() const {
  auto set_bytes = [](const TriangleSet& s) {
    return s.positions.size() * sizeof(vec3) + s.normals.size() * sizeof(vec3) + s.uvs.size() * sizeof(vec2) +
           s.triangles.size() * sizeof(uvec3) + s.materials.size() * sizeof(std::uint32_t);
  };
  std::size_t bytes = set_bytes(world_) + accel_.memory_bytes();
  for (const auto& object : objects_) bytes += set_bytes(object->set) + object->accel.memory_bytes();
  return bytes;
}

} // namespace candela
