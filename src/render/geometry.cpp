#include "render/geometry.h"

#include "core/basis.h"

namespace candela {

namespace {

vec2 interpolate(const std::vector<vec2>& values, uvec3 t, float u, float v) {
  return (1 - u - v) * values[t.x] + u * values[t.y] + v * values[t.z];
}

/// Object-space point, its error and normals of a triangle hit.
void set_triangle_surface(Surface& s, const TriangleSet& set, const Hit& hit) {
  uvec3 t = set.triangles[hit.primitive];
  vec3 p0 = set.positions[t.x], p1 = set.positions[t.y], p2 = set.positions[t.z];
  float w = 1 - hit.u - hit.v;
  vec3 a = w * p0, b = hit.u * p1, c = hit.v * p2;
  s.position = a + b + c;
  s.position_error = gamma_bound(7) * (glm::abs(a) + glm::abs(b) + glm::abs(c)); // pbrt-v4, eq. 6.31
  // The test of the next ray against this triangle rounds t by the triangle's size in whatever direction,
  // also where the point itself has no error along the normal (a wall in a coordinate plane). The factor is
  // where self-intersections of well-shaped triangles ended when measured.
  s.position_error += gamma_bound(8) * max_component(glm::max(glm::abs(p1 - p0), glm::abs(p2 - p0)));
  s.geometric_normal = glm::normalize(glm::cross(p1 - p0, p2 - p0));
  s.shading_normal = s.geometric_normal;
  if (!set.normals.empty()) {
    vec3 n0 = set.normals[t.x], n1 = set.normals[t.y], n2 = set.normals[t.z];
    // A vertex without a normal makes its triangle flat.
    if (!is_black(n0) && !is_black(n1) && !is_black(n2)) {
      vec3 n = w * n0 + hit.u * n1 + hit.v * n2;
      if (length_squared(n) > 0) s.shading_normal = n; // normalised by the caller, after its transform
    }
  }
  s.uv = set.uvs.empty() ? vec2(hit.u, hit.v) : interpolate(set.uvs, t, hit.u, hit.v);
}

} // namespace

Surface Geometry::surface(const Ray& ray, const Hit& hit) const {
  Surface s; // made where the caller wants it: copies of what has just been written by parts stall
  if (hit.kind == PrimitiveKind::triangle) {
    bool shared = hit.instance != kNoInstance;
    const TriangleSet& set = shared ? objects_[placed_[hit.instance].object]->set : world_;
    set_triangle_surface(s, set, hit);
    if (shared) {
      const Placed& p = placed_[hit.instance];
      const mat4& m = p.world_from_object;
      // The error of the object-space point, transformed, and that of transforming it (pbrt-v4,
      // section 6.8.4).
      mat3 abs_m(glm::abs(vec3(m[0])), glm::abs(vec3(m[1])), glm::abs(vec3(m[2])));
      s.position_error = (gamma_bound(3) + 1) * (abs_m * s.position_error) +
                         gamma_bound(3) * (abs_m * glm::abs(s.position) + glm::abs(vec3(m[3])));
      s.position = transform_point(m, s.position);
      s.geometric_normal = glm::normalize(p.normal_to_world * s.geometric_normal);
      s.shading_normal = set.normals.empty() ? s.geometric_normal : p.normal_to_world * s.shading_normal;
      s.material = p.slot_materials[set.materials[hit.primitive]];
      s.emitter = p.first_emitter + hit.primitive;
    } else {
      s.material = set.materials[hit.primitive];
      s.emitter = hit.primitive;
    }
    if (!set.normals.empty()) {
      s.shading_normal = glm::normalize(s.shading_normal);
      if (glm::dot(s.shading_normal, s.geometric_normal) < 0) s.shading_normal = -s.shading_normal;
    }
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
