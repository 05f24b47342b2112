#include "render/direct_light.h"

namespace candela {

namespace {

/// What is aimed along, by the lane of the vertex.
struct AimedLanes {
  Vec3Lanes direction; ///< unit, to the light
  Vec3Lanes wi_local;  ///< the same about the normal
  Lanes<float> cosine; ///< with the geometric normal, on wo's side; all that is aimed from reflects
  // The shadow ray:
  Vec3Lanes origin;
  Vec3Lanes target; ///< its end, off the light's surface; unused where the light is infinite
};

/// In all lanes, also where nothing is asked: their results are not looked at.
[[gnu::noinline]] void set_aims(const VertexLanes& __restrict vertices,
                                const LightSampleLanes& __restrict lights, AimedLanes& __restrict aims) {
  for (std::size_t i = 0; i < vertices.count; ++i) {
    vec3 position = vertices.position[i], outside = vertices.geometric_normal[i], point = lights.point[i];
    vec3 away = select(lights.infinite[i] != 0, lights.direction[i], glm::normalize(point - position));
    float cosine = glm::dot(away, outside);
    aims.direction.set(i, away);
    aims.wi_local.set(i, Basis::from_normal(vertices.normal[i]).to_local(away));
    aims.cosine[i] = vertices.side[i] > 0 ? cosine : -cosine;
    aims.origin.set(i, offset_ray_origin(position, vertices.position_error[i], outside, away));
    aims.target.set(i, offset_ray_origin(point, lights.point_error[i], lights.point_normal[i], -away));
  }
}

/// A light sample that waits to be looked at, and what it brings if nothing is between.
struct ShadowRay {
  Ray ray;
  vec3 target;
  bool infinite;
  std::uint32_t lane;
  vec3 light;
};

void set_ray(ShadowRay& shadow, const AimedLanes& aims) {
  const std::size_t i = shadow.lane;
  shadow.target = aims.target[i];
  shadow.ray.origin = aims.origin[i];
  shadow.ray.direction = shadow.infinite ? aims.direction[i] : shadow.target - shadow.ray.origin;
  // Both ends are off their surfaces by their error bounds, so what is left must be free but for what the
  // distance adds to the rounding of t.
  shadow.ray.t_max = shadow.infinite ? kInfinity : 1 - gamma_bound(16);
}

/// The index-th light sample of each seeker.
void aim_once(const RenderScene& scene, const LightSelection& selection, const VertexLanes& vertices,
              LightSeekers& seekers, std::uint32_t index, const PathSettings& settings,
              std::vector<Sampler>& branched, RayCounts& counts) {
  Lanes<Sampler::Draw> draws;
  Lanes<vec2> u;
  if (settings.light_samples == 1) {
    for (std::size_t k = 0; k < seekers.count; ++k) draws[k] = {seekers.sampler[seekers.lane[k]], 0};
  } else { // those of all samples are one sequence
    const auto all = static_cast<std::uint32_t>(settings.light_samples);
    branched.clear();
    for (std::size_t k = 0; k < seekers.count; ++k)
      branched.push_back(seekers.sampler[seekers.lane[k]]->branch(index, all));
    for (std::size_t k = 0; k < seekers.count; ++k) draws[k] = {&branched[k], 0};
  }
  Sampler::get_2d({draws.data(), seekers.count}, Dimension::light_position, u);

  Lanes<float> pmf;
  Lanes<LightQuery> queries;
  LightSampleLanes lights{}; // set_aims looks at all
  std::size_t queried = 0;
  for (std::size_t k = 0; k < seekers.count; ++k) {
    // One number chooses the light and, stretched again, the place on it: so the samples of each light are
    // spread well, too. Between lamps of alike size that halves the noise of numbers of their own.
    const std::uint32_t i = seekers.lane[k];
    const LightReference& reference = vertices.reference[i];
    auto choice = selection.choose(reference, u[k].x);
    if (!choice) continue;
    pmf[i] = choice->pmf;
    queries[queried++] = {&scene.lights()[choice->light], &reference, vec2(choice->u, u[k].y), i};
  }
  const std::span<const LightQuery> asked(queries.data(), queried);
  sample_lights(asked, lights);
  AimedLanes aims;
  set_aims(vertices, lights, aims);

  const auto n = static_cast<float>(settings.light_samples);
  // All rays are made before the first is traced: one that has just been written by parts stalls the
  // processor when it is loaded whole.
  Lanes<ShadowRay> shadows;
  std::size_t traced = 0;
  for (const LightQuery& query : asked) {
    const std::uint32_t i = query.lane;
    if (!(lights.pdf[i] > 0) || !(aims.cosine[i] > 0)) continue;
    BsdfEval e = direction_eval_pdf(vertices.bsdf(i), vertices.wo_local[i], aims.wi_local[i],
                                    settings.direction_sampling);
    vec3 contribution = e.f_cos * lights.radiance[i];
    if (is_black(contribution)) continue;
    float pdf = pmf[i] * lights.pdf[i];
    float weight = 1;
    if (!lights.delta[i] && settings.light_sampling == LightSampling::mis)
      weight = mis_weight(settings.mis_heuristic, n * pdf, static_cast<float>(seekers.scattered[i]) * e.pdf);
    ShadowRay& shadow = shadows[traced++];
    shadow.lane = i;
    shadow.infinite = lights.infinite[i] != 0;
    shadow.light = contribution * (weight / (pdf * n));
    set_ray(shadow, aims);
  }
  for (const ShadowRay& shadow : std::span(shadows.data(), traced))
    seekers.light[shadow.lane] +=
        shadow.light * visibility(scene, shadow.ray, shadow.target, shadow.infinite, counts);
}

} // namespace

void aim_at_lights(const RenderScene& scene, const VertexLanes& vertices, LightSeekers& seekers,
                   const PathSettings& settings, RayCounts& counts) {
  for (std::size_t k = 0; k < seekers.count; ++k) seekers.light[seekers.lane[k]] = vec3(0);
  bool aim = settings.light_sampling != LightSampling::bsdf;
  const LightSelection& selection = aim ? scene.all_lights() : scene.delta_lights();
  if (selection.empty()) return;
  std::vector<Sampler> branched;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(settings.light_samples); ++i)
    aim_once(scene, selection, vertices, seekers, i, settings, branched, counts);
}

} // namespace candela
