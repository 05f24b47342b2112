#include "render/direct_light.h"

namespace candela {

namespace {

/// As many as are asked at once: enough for full vectors, and all that is known of them stays in the
/// first-level cache.
constexpr std::size_t kChunk = 64;

/// The index-th light sample for each of at most kChunk seekers. `branched` is memory.
void aim_once(const RenderScene& scene, const LightSelection& selection, std::span<LightSeeker> seekers,
              std::uint32_t index, const PathSettings& settings, std::vector<Sampler>& branched,
              RayCounts& counts) {
  std::array<Sampler::Draw, kChunk> draws;
  std::array<vec2, kChunk> u;
  const std::size_t count = seekers.size();
  if (settings.light_samples == 1) {
    for (std::size_t k = 0; k < count; ++k) draws[k] = {seekers[k].sampler, 0};
  } else { // those of all samples are one sequence
    const auto all = static_cast<std::uint32_t>(settings.light_samples);
    branched.clear();
    for (std::size_t k = 0; k < count; ++k) branched.push_back(seekers[k].sampler->branch(index, all));
    for (std::size_t k = 0; k < count; ++k) draws[k] = {&branched[k], 0};
  }
  const std::span<const Sampler::Draw> asked(draws.data(), count);
  Sampler::get_2d(asked, Dimension::light_position, u);

  std::array<float, kChunk> pmf;
  std::array<LightSeeker*, kChunk> asking; // those that a light may reach
  std::array<LightQuery, kChunk> queries;
  std::array<std::optional<LightSample>, kChunk> lights;
  std::size_t queried = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // One number chooses the light and, stretched again, the place on it: so the samples of each light are
    // spread well, too. Between lamps of alike size that halves the noise of numbers of their own.
    const LightReference& reference = seekers[k].vertex->reference;
    auto choice = selection.choose(reference, u[k].x);
    if (!choice) continue;
    pmf[queried] = choice->pmf;
    asking[queried] = &seekers[k];
    queries[queried++] = {&scene.lights()[choice->light], &reference, vec2(choice->u, u[k].y)};
  }
  sample_lights({queries.data(), queried}, lights);

  const auto n = static_cast<float>(settings.light_samples);
  for (std::size_t k = 0; k < queried; ++k) {
    const std::optional<LightSample>& light = lights[k];
    const Vertex& vertex = *asking[k]->vertex;
    // All that is aimed from reflects.
    if (!light || glm::dot(light->direction, vertex.reference.normal) <= 0) continue;
    vec3 wi_local = vertex.frame.to_local(light->direction);
    BsdfEval e = direction_eval_pdf(*asking[k]->bsdf, vertex.wo_local, wi_local, settings.direction_sampling);
    vec3 contribution = e.f_cos * light->radiance;
    if (is_black(contribution)) continue;
    float through = visibility(scene, vertex.surface, *light, counts);
    if (through == 0) continue;
    float pdf = pmf[k] * light->pdf;
    float weight = 1;
    if (!light->delta && settings.light_sampling == LightSampling::mis)
      weight = mis_weight(settings.mis_heuristic, n * pdf, static_cast<float>(asking[k]->scattered) * e.pdf);
    asking[k]->light += contribution * (through * weight / (pdf * n));
  }
}

} // namespace

void aim_at_lights(const RenderScene& scene, std::span<LightSeeker> seekers, const PathSettings& settings,
                   RayCounts& counts) {
  bool aim = settings.light_sampling != LightSampling::bsdf;
  const LightSelection& selection = aim ? scene.all_lights() : scene.delta_lights();
  if (selection.empty()) return;
  std::vector<Sampler> branched;
  for (std::size_t begin = 0; begin < seekers.size(); begin += kChunk)
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(settings.light_samples); ++i)
      aim_once(scene, selection, seekers.subspan(begin, std::min(kChunk, seekers.size() - begin)), i,
               settings, branched, counts);
}

} // namespace candela
