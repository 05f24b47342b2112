#include "render/transport.h"

namespace candela {

namespace {

/// More transparent surfaces in a row than any scene has end the ray: two coincident ones could catch it for
/// ever.
constexpr std::uint32_t kMaxCrossings = 1024;

} // namespace

bool look_through(const RenderScene& scene, Ray& ray, const Sampler& sampler, bool met, Hit& hit,
                  RayCounts& counts) {
  if (!scene.has_transparency()) return met;
  for (std::uint32_t crossing = 0; met; ++crossing) {
    float opacity = scene.material(scene.geometry().material_of(hit)).opacity;
    if (opacity >= 1 || sampler.get_1d(Dimension::opacity, crossing) < opacity) return true;
    if (crossing + 1 == kMaxCrossings) return false;
    Surface s = scene.geometry().surface(ray, hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    ++counts.closest;
    met = scene.geometry().accel().intersect(ray, hit);
  }
  return false;
}

bool intersect_scene(const RenderScene& scene, Ray& ray, const Sampler& sampler, Hit& hit,
                     RayCounts& counts) {
  ++counts.closest;
  const bool met = scene.geometry().accel().intersect(ray, hit);
  return look_through(scene, ray, sampler, met, hit, counts);
}

float visibility(const RenderScene& scene, const Ray& towards, vec3 target, bool infinite,
                 RayCounts& counts) {
  const Accel& accel = scene.geometry().accel();
  if (!scene.has_transparency()) {
    ++counts.shadow;
    return accel.occluded(towards) ? 0.0f : 1.0f;
  }
  Ray ray = towards;
  float through = 1;
  for (std::uint32_t i = 0; i < kMaxCrossings; ++i) {
    ++counts.shadow;
    auto hit = accel.intersect(ray);
    if (!hit) return through;
    through *= 1 - scene.material(scene.geometry().material_of(*hit)).opacity;
    if (through <= 0) return 0;
    Surface s = scene.geometry().surface(ray, *hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    if (!infinite) ray.direction = target - ray.origin;
  }
  return 0;
}

} // namespace candela
