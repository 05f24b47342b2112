#include "render/world/geometry.h"

#include "render/world/sphere_uv.h"
#include "render/world/triangle_point.h"

namespace candela {

namespace {

template <class T>
T interpolate(T a, T b, T c, float u, float v) {
  return (1 - u - v) * a + u * b + v * c;
}

} // namespace

SurfaceInteraction Geometry::surface(const Ray& ray, const Hit& hit) const {
  SurfaceInteraction s; // made where the caller wants it: copies of what has just been written by parts stall
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
    return s;
  }
  if (hit.kind == PrimitiveKind::sphere) {
    const SphereGeometry& sphere = spheres_[hit.primitive];
    s.geometric_normal = glm::normalize(ray.at(hit.t) - sphere.center);
    vec3 offset = s.geometric_normal * sphere.radius; // on the sphere again, whatever t had of error
    s.position = sphere.center + offset;
    s.position_error = gamma_bound(6) * (glm::abs(sphere.center) + glm::abs(offset));
    s.material = sphere_materials_[hit.primitive];
    s.emitter = sphere_emitter(hit.primitive);
  } else {
    const DiscGeometry& disc = discs_[hit.primitive];
    s.geometric_normal = disc.normal;
    vec3 p = ray.at(hit.t);
    s.position = p - disc.normal * glm::dot(p - disc.center, disc.normal); // into the plane
    s.position_error = gamma_bound(8) * (glm::abs(s.position) + glm::abs(disc.center) + disc.radius);
    s.material = disc_materials_[hit.primitive];
    s.emitter = disc_emitter(hit.primitive);
  }
  s.shading_normal = s.geometric_normal;
  return s;
}

bool Geometry::is_ellipsoid(std::uint32_t world_triangle) const {
  auto next = std::ranges::upper_bound(ellipsoids_, world_triangle, {}, &TriangleRange::begin);
  return next != ellipsoids_.begin() && world_triangle < std::prev(next)->end;
}

vec2 Geometry::uv(const Ray& ray, const Hit& hit) const {
  // Points are taken relative to the centre before they are far from the origin: both ends of the ray's way
  // are exact, their sum is not.
  auto from = [&](vec3 center) { return (ray.origin - center) + hit.t * ray.direction; };
  if (hit.kind == PrimitiveKind::sphere)
    return sphere_uv(sphere_from_world_[hit.primitive] * from(spheres_[hit.primitive].center));
  if (hit.kind == PrimitiveKind::disc) {
    const vec3 p = from(discs_[hit.primitive].center);
    const DiscAxes& axes = disc_axes_[hit.primitive];
    return 0.5f * vec2(glm::dot(p, axes.x), glm::dot(p, axes.y)) + 0.5f;
  }
  const bool shared = hit.instance != kNoInstance;
  const TriangleSet& set = shared ? objects_[placed_[hit.instance].object]->set : world_;
  if (set.uvs.empty()) return vec2(0);
  const uvec3 t = set.triangles[hit.primitive];
  const vec2 a = set.uvs[t.x], b = set.uvs[t.y], c = set.uvs[t.z];
  if (!shared && is_ellipsoid(hit.primitive)) // not linear in them: the same as on a sphere
    return sphere_uv(
        interpolate(sphere_direction(a), sphere_direction(b), sphere_direction(c), hit.u, hit.v));
  return interpolate(a, b, c, hit.u, hit.v);
}

std::uint32_t Geometry::material_of(const Hit& hit) const {
  if (hit.kind == PrimitiveKind::sphere) return sphere_materials_[hit.primitive];
  if (hit.kind == PrimitiveKind::disc) return disc_materials_[hit.primitive];
  if (hit.instance == kNoInstance) return world_.materials[hit.primitive];
  const Placed& p = placed_[hit.instance];
  return p.slot_materials[objects_[p.object]->set.materials[hit.primitive]];
}

std::uint32_t Geometry::instance_of(const Hit& hit) const {
  if (hit.kind == PrimitiveKind::sphere) return sphere_instances_[hit.primitive];
  if (hit.kind == PrimitiveKind::disc) return disc_instances_[hit.primitive];
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
