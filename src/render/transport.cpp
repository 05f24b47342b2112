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

float visibility(const RenderScene& scene, const Surface& from, const LightSample& light, RayCounts& counts) {
  const Accel& accel = scene.geometry().accel();
  Ray ray = spawn_ray(from, light.direction);
  vec3 target(0);
  if (!light.infinite) {
    // Both ends are moved off their surfaces by their error bounds, so what is left must be free but for what
    // the distance adds to the rounding of t.
    target = offset_ray_origin(light.point, light.point_error, light.point_normal, -light.direction);
    ray.direction = target - ray.origin;
    ray.t_max = 1 - gamma_bound(16);
  }
  if (!scene.has_transparency()) {
    ++counts.shadow;
    return accel.occluded(ray) ? 0.0f : 1.0f;
  }
  float through = 1;
  for (std::uint32_t i = 0; i < kMaxCrossings; ++i) {
    ++counts.shadow;
    auto hit = accel.intersect(ray);
    if (!hit) return through;
    through *= 1 - scene.material(scene.geometry().material_of(*hit)).opacity;
    if (through <= 0) return 0;
    Surface s = scene.geometry().surface(ray, *hit);
    ray.origin = offset_ray_origin(s.position, s.position_error, s.geometric_normal, ray.direction);
    if (!light.infinite) ray.direction = target - ray.origin;
  }
  return 0;
}

} // namespace candela
