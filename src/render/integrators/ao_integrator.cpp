#include "render/integrators/ao_integrator.h"

namespace candela {

float ambient_occlusion(const RenderScene& scene, const PathStart& start, Sampler& sampler,
                        const RenderSettings& settings, RayCounts& counts) {
  sampler.set_bounce(1);
  Ray ray = start.ray;
  MediaPassage passage{start.media, Spectrum(1)};
  Hit hit;
  if (!intersect_scene(scene, ray, sampler, hit, counts, scene.has_priorities() ? &passage : nullptr))
    return 1;
  SurfaceInteraction surface = scene.geometry().surface(ray, hit);
  vec3 normal = surface.geometric_normal; // the interpolated one's hemisphere reaches below the surface
  if (glm::dot(normal, ray.direction) > 0) normal = -normal;
  Basis frame = Basis::from_normal(normal);
  int n = settings.path.light_samples, open = 0;
  for (int i = 0; i < n; ++i) {
    vec3 local =
        sample_cosine_hemisphere(sampler.get_2d(Dimension::bsdf_direction, static_cast<std::uint32_t>(i)));
    Ray probe = spawn_ray(surface, frame.to_world(local), ray.time);
    if (settings.ao.distance > 0) probe.t_max = settings.ao.distance;
    open += !is_occluded(scene, probe, passage.media, counts);
  }
  return static_cast<float>(open) / static_cast<float>(n);
}

} // namespace candela
