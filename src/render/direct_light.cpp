#include "render/direct_light.h"

namespace candela {

vec3 aim_at_lights(const RenderScene& scene, const Vertex& vertex, const Bsdf& bsdf, const Sampler& sampler,
                   const PathSettings& settings, int scattered, RayCounts& counts) {
  bool aim = settings.light_sampling != LightSampling::bsdf;
  const AliasTable& table = aim ? scene.all_lights() : scene.delta_lights();
  vec3 sum(0);
  if (table.empty()) return sum;
  auto n = static_cast<float>(settings.light_samples);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(settings.light_samples); ++i) {
    AliasTable::Sample choice =
        table.sample(table.size() > 1 ? sampler.get_1d(Dimension::light_choice, i) : 0);
    auto light = sample_light(scene.lights()[choice.index], vertex.reference,
                              sampler.get_2d(Dimension::light_position, i));
    // All that is aimed from reflects.
    if (!light || glm::dot(light->direction, vertex.reference.normal) <= 0) continue;
    vec3 wi_local = vertex.frame.to_local(light->direction);
    BsdfEval e = direction_eval_pdf(bsdf, vertex.wo_local, wi_local, settings.direction_sampling);
    vec3 contribution = e.f_cos * light->radiance;
    if (is_black(contribution)) continue;
    float through = visibility(scene, vertex.surface, *light, counts);
    if (through == 0) continue;
    float pdf = choice.pmf * light->pdf;
    float weight = 1;
    if (!light->delta && settings.light_sampling == LightSampling::mis)
      weight = mis_weight(settings.mis_heuristic, n * pdf, static_cast<float>(scattered) * e.pdf);
    sum += contribution * (through * weight / (pdf * n));
  }
  return sum;
}

} // namespace candela
