#include "render/transport.h"

namespace candela {

namespace {

/// More transparent surfaces in a row than any scene has end the ray: two coincident ones could catch it for
/// ever.
constexpr std::uint32_t kMaxCrossings = 1024;

} // namespace

bool intersect_scene(const RenderScene& scene, Ray& ray, const Sampler& sampler, Hit& hit,
                     RayCounts& counts) {
  const Accel& accel = scene.geometry().accel();
  for (std::uint32_t crossing = 0; crossing < kMaxCrossings; ++crossing) {
    ++counts.closest;
    if (!accel.intersect(ray, hit)) return false;
    if (!scene.has_transparency()) return true;
    float opacity = scene.material(scene.geometry().material_of(hit)).opacity;
    if (opacity >= 1 || sampler.get_1d(Dimension::opacity, crossing) < opacity) return true;
    Surface s = scene.geometry().surface(ray, hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
  }
  return false;
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
