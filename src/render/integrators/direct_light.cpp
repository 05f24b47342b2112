#include "render/integrators/direct_light.h"

namespace candela {

/// Random numbers for the index-th of so many light samples.
void DirectLight::draw(const LightSeekers& seekers, std::uint32_t index, int samples) {
  Lanes<Sampler::Draw> draws;
  if (samples == 1) {
    for (std::size_t k = 0; k < seekers.count; ++k) draws[k] = {seekers.sampler[seekers.lane[k]], 0};
  } else { // those of all samples are one sequence
    branched_.clear();
    branched_.reserve(kLaneCount); // the draws point into it
    for (std::size_t k = 0; k < seekers.count; ++k) {
      const Sampler& own = *seekers.sampler[seekers.lane[k]];
      draws[k] = {&branched_.emplace_back(own.branch(index, static_cast<std::uint32_t>(samples))), 0};
    }
  }
  Sampler::get_2d({draws.data(), seekers.count}, Dimension::light_position, u_);
}

/// A light for each seeker that one may reach.
void DirectLight::choose(const RenderScene& scene, const LightSelection& selection,
                         const VertexLanes& vertices, const LightSeekers& seekers) {
  queried_ = 0;
  for (std::size_t k = 0; k < seekers.count; ++k) {
    // One number chooses the light and, stretched again, the place on it: so the samples of each light are
    // spread well, too. Between lamps of alike size that halves the noise of numbers of their own.
    const std::uint32_t i = seekers.lane[k];
    const LightReference& reference = vertices.reference[i];
    auto choice = selection.choose(reference, u_[k].x);
    if (!choice) continue;
    pmf_[i] = choice->pmf;
    queries_[queried_++] = {&scene.lights()[choice->light], &reference, vec2(choice->u, u_[k].y), i};
  }
}

/// What textures say of the points that were sampled.
void DirectLight::look_up_radiance(const RenderScene& scene) {
  for (const LightQuery& query : std::span(queries_.data(), queried_)) {
    const auto light = static_cast<std::uint32_t>(query.light - scene.lights().data());
    const EmitterTexture* texture = scene.emitter_texture(light);
    if (texture != nullptr && lights_.pdf[query.lane] > 0)
      lights_.radiance.set(query.lane, texture->radiance(scene.geometry(), lights_.point[query.lane]));
  }
}

/// In all lanes, also where nothing is asked: what comes of those is not looked at.
[[gnu::noinline]] void DirectLight::set_aims(const VertexLanes& __restrict vertices,
                                             const LightSampleLanes& __restrict lights,
                                             AimedLanes& __restrict aims) {
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

/// The shadow rays of the samples that bring something. All are made before the first is traced: one that has
/// just been written by parts stalls the processor when it is loaded whole.
void DirectLight::weigh(const VertexLanes& vertices, const LightSeekers& seekers,
                        const PathSettings& settings) {
  shadow_count_ = 0;
  const auto n = static_cast<float>(settings.light_samples);
  for (const LightQuery& query : std::span(queries_.data(), queried_)) {
    const std::uint32_t i = query.lane;
    if (!(lights_.pdf[i] > 0) || !query.reference->accepts(aims_.cosine[i])) continue;
    BsdfEval e = vertices.eval_pdf(i, aims_.wi_local[i], settings.direction_sampling);
    vec3 contribution = e.f_cos * lights_.radiance[i];
    if (is_black(contribution)) continue;
    float pdf = pmf_[i] * lights_.pdf[i];
    float weight = 1;
    if (!lights_.delta[i] && settings.light_sampling == LightSampling::mis)
      weight = mis_weight(settings.mis_heuristic, n * pdf, static_cast<float>(seekers.scattered[i]) * e.pdf);
    ShadowRay& shadow = shadows_[shadow_count_++];
    shadow.lane = i;
    shadow.light = contribution * (weight / (pdf * n));
    set_ray(shadow);
  }
}

void DirectLight::set_ray(ShadowRay& shadow) const {
  const std::size_t i = shadow.lane;
  shadow.infinite = lights_.infinite[i] != 0;
  shadow.target = aims_.target[i];
  shadow.ray.origin = aims_.origin[i];
  shadow.ray.direction = shadow.infinite ? aims_.direction[i] : shadow.target - shadow.ray.origin;
  // Both ends are off their surfaces by their error bounds, so what is left must be free but for what the
  // distance adds to the rounding of t.
  shadow.ray.t_max = shadow.infinite ? kInfinity : 1 - gamma_bound(16);
}

/// Gives seekers the light that reaches them.
void DirectLight::look(const RenderScene& scene, LightSeekers& seekers, RayCounts& counts, StopPoll& stop) {
  const std::span<const ShadowRay> shadows(shadows_.data(), shadow_count_);
  const bool anything_passes = scene.has_transparency() || scene.has_absorption();
  if (!seekers.neighbours && !anything_passes) {
    counts.shadow += shadows.size();
    for (const ShadowRay& shadow : shadows)
      if (!scene.geometry().accel().occluded(shadow.ray)) seekers.light[shadow.lane] += shadow.light;
    return;
  }
  if (anything_passes) {
    for (const ShadowRay& shadow : shadows) {
      if (stop.asked()) return;
      const Interiors* interiors = scene.has_absorption() ? seekers.interiors[shadow.lane] : nullptr;
      const vec3 through = visibility(scene, shadow.ray, shadow.target, shadow.infinite, counts, interiors);
      if (!is_black(through)) seekers.light[shadow.lane] += shadow.light * through;
    }
    return;
  }
  Lanes<const Ray*> rays;
  Lanes<bool> occluded;
  for (std::size_t k = 0; k < shadows.size(); ++k) rays[k] = &shadows[k].ray;
  counts.shadow += shadows.size();
  scene.geometry().accel().occluded({rays.data(), shadows.size()}, occluded);
  for (std::size_t k = 0; k < shadows.size(); ++k)
    if (!occluded[k]) seekers.light[shadows[k].lane] += shadows[k].light;
}

void DirectLight::aim(const RenderScene& scene, const VertexLanes& vertices, LightSeekers& seekers,
                      const PathSettings& settings, RayCounts& counts, StopPoll& stop) {
  for (std::size_t k = 0; k < seekers.count; ++k) seekers.light[seekers.lane[k]] = vec3(0);
  const bool all = settings.light_sampling != LightSampling::bsdf;
  const LightSelection& selection = all ? scene.all_lights() : scene.delta_lights();
  if (selection.empty()) return;
  for (std::uint32_t index = 0; index < static_cast<std::uint32_t>(settings.light_samples); ++index) {
    draw(seekers, index, settings.light_samples);
    choose(scene, selection, vertices, seekers);
    sample_lights({queries_.data(), queried_}, lights_);
    if (scene.has_textured_lights()) look_up_radiance(scene);
    set_aims(vertices, lights_, aims_);
    weigh(vertices, seekers, settings);
    look(scene, seekers, counts, stop);
    if (stop.asked()) return;
  }
}

vec3 DirectLightOfOne::aim(const RenderScene& scene, const Vertex& vertex, const Bsdf& bsdf,
                           const Sampler& sampler, const PathSettings& settings, RayCounts& counts,
                           StopPoll& stop, const Interiors* interiors) {
  vertices_.set_one(vertex, bsdf);
  seekers_.count = 1;
  seekers_.lane[0] = 0;
  seekers_.sampler[0] = &sampler;
  seekers_.scattered[0] = 0;
  seekers_.interiors[0] = interiors;
  direct_light_.aim(scene, vertices_, seekers_, settings, counts, stop);
  return seekers_.light[0];
}

} // namespace candela
