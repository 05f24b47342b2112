#include "render/integrators/transport.h"

namespace candela {

namespace {

/// More transparent surfaces in a row than any scene has end the ray: two coincident ones could catch it for
/// ever.
constexpr std::uint32_t kMaxCrossings = 1024;

} // namespace

bool detail::look_through_bodies(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met,
                                 Hit& hit, RayCounts& counts, Passage* passage) {
  auto advance = [&](float distance) {
    if (passage != nullptr) passage->transmittance *= transmittance(scene, passage->interiors, distance);
  };
  if (!scene.has_transparency()) {
    advance(met ? hit.t : kInfinity);
    return met;
  }
  for (std::uint32_t crossing = 0; met; ++crossing) {
    const SurfaceMaterial& material = scene.material(scene.geometry().material_of(hit));
    advance(hit.t);
    const float opacity = opacity_at(material, [&] { return scene.geometry().uv(ray, hit); });
    if (opacity >= 1 || sampler.get_1d(Dimension::opacity, crossing) < opacity) return true;
    if (crossing + 1 == kMaxCrossings) return false;
    Surface s = scene.geometry().surface(ray, hit);
    if (passage != nullptr)
      passage->interiors.cross(material.interior, glm::dot(s.geometric_normal, ray.direction) < 0);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    ++counts.closest;
    met = scene.geometry().accel().intersect(ray, hit);
  }
  advance(kInfinity);
  return false;
}

vec3 visibility(const RenderScene& scene, const Ray& towards, vec3 target, bool infinite, RayCounts& counts,
                const Interiors* interiors) {
  const Accel& accel = scene.geometry().accel();
  // `t` is in lengths of the ray's direction, as Hit has it.
  auto passes = [&](const Interiors& where, const Ray& ray, float t) {
    return where.empty() ? vec3(1) : transmittance(scene, where, t * glm::length(ray.direction));
  };
  const float whole_way = infinite ? kInfinity : 1;
  if (!scene.has_transparency()) {
    ++counts.shadow;
    if (accel.occluded(towards)) return vec3(0);
    return interiors == nullptr ? vec3(1) : passes(*interiors, towards, whole_way);
  }
  Ray ray = towards;
  Interiors where = interiors != nullptr ? *interiors : Interiors();
  vec3 through(1);
  for (std::uint32_t i = 0; i < kMaxCrossings; ++i) {
    ++counts.shadow;
    auto hit = accel.intersect(ray);
    if (!hit) return through * passes(where, ray, whole_way);
    const SurfaceMaterial& material = scene.material(scene.geometry().material_of(*hit));
    through *= 1 - opacity_at(material, [&] { return scene.geometry().uv(ray, *hit); });
    if (is_black(through)) return vec3(0);
    Surface s = scene.geometry().surface(ray, *hit);
    if (interiors != nullptr) {
      through *= passes(where, ray, hit->t);
      where.cross(material.interior, glm::dot(s.geometric_normal, ray.direction) < 0);
    }
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    if (!infinite) ray.direction = target - ray.origin;
  }
  return vec3(0);
}

} // namespace candela
