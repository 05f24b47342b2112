#include "render/integrators/direct_light.h"

namespace candela {

/// Random numbers for the index-th of so many light samples.
void DirectLight::draw_numbers(const ShadingPoints& points, std::uint32_t index, int samples) {
  Lanes<Sampler::Draw> draws;
  if (samples == 1) {
    for (std::size_t k = 0; k < points.count; ++k) draws[k] = {points.sampler[points.lane[k]], points.draw};
  } else { // those of all samples are one sequence
    branched_.clear();
    branched_.reserve(kLaneCount); // the draws point into it
    for (std::size_t k = 0; k < points.count; ++k) {
      const Sampler& own = *points.sampler[points.lane[k]];
      draws[k] = {&branched_.emplace_back(own.branch(index, static_cast<std::uint32_t>(samples))),
                  points.draw};
    }
  }
  Sampler::get_2d({draws.data(), points.count}, Dimension::light_position, u_);
}

/// A light for each point that one may reach.
void DirectLight::select_lights(const RenderScene& scene, const LightSelection& selection,
                                const VertexLanes& vertices, const ShadingPoints& points) {
  query_count_ = 0;
  for (std::size_t k = 0; k < points.count; ++k) {
    // One number selects the light and, stretched again, the place on it: so the samples of each light are
    // well distributed, too. Between lamps of similar size this has half the noise of separate numbers.
    const std::uint32_t i = points.lane[k];
    const LightSamplingContext& context = vertices.light_context[i];
    auto choice = selection.choose(context, u_[k].x);
    if (!choice) continue;
    pmf_[i] = choice->pmf;
    queries_[query_count_++] = {&scene.lights()[choice->light], &context, vec2(choice->u, u_[k].y), i};
  }
}

/// Of the samples of lights whose radiance a texture gives.
void DirectLight::look_up_radiance(const RenderScene& scene) {
  for (const LightQuery& query : std::span(queries_.data(), query_count_)) {
    const auto light = static_cast<std::uint32_t>(query.light - scene.lights().data());
    const EmitterTexture* texture = scene.emitter_texture(light);
    if (texture != nullptr && lights_.pdf[query.lane] > 0)
      lights_.radiance.set(query.lane, texture->radiance(scene, lights_.point[query.lane]));
  }
}

/// In all lanes, also where no light was sampled: the output of those is not read.
[[gnu::noinline]] void DirectLight::set_directions(const VertexLanes& __restrict vertices,
                                                   const LightSampleLanes& __restrict lights,
                                                   LightDirectionLanes& __restrict out) {
  for (std::size_t i = 0; i < vertices.count; ++i) {
    vec3 position = vertices.position[i], outside = vertices.geometric_normal[i], point = lights.point[i];
    vec3 away = select(lights.infinite[i] != 0, lights.direction[i], glm::normalize(point - position));
    float cosine = glm::dot(away, outside);
    out.direction.set(i, away);
    out.wi_local.set(i, Basis::from_normal(vertices.normal[i]).to_local(away));
    out.cosine[i] = vertices.side[i] > 0 ? cosine : -cosine;
    out.origin.set(i, offset_ray_origin(position, vertices.position_error[i], outside, away));
    out.target.set(i, offset_ray_origin(point, lights.point_error[i], lights.point_normal[i], -away));
  }
}

/// Makes the shadow rays of the samples that contribute, with their MIS weights. All are made before the
/// first is traced: one that has just been written by parts stalls the processor when it is loaded whole.
void DirectLight::weight_samples(const RenderScene& scene, const VertexLanes& vertices,
                                 const ShadingPoints& points, const PathSettings& settings) {
  shadow_count_ = 0;
  const auto n = static_cast<float>(settings.light_samples);
  const bool weighs_later = scene.has_active_media();
  for (const LightQuery& query : std::span(queries_.data(), query_count_)) {
    const std::uint32_t i = query.lane;
    if (!(lights_.pdf[i] > 0) || !query.context->accepts(directions_.cosine[i])) continue;
    BsdfEval e = vertices.eval_pdf(i, directions_.wi_local[i], settings.direction_sampling);
    Spectrum contribution = e.f_cos * lights_.radiance[i];
    if (is_black(contribution)) continue;
    float pdf = pmf_[i] * lights_.pdf[i];
    float weight = 1;
    const bool mis = !lights_.delta[i] && settings.light_sampling == LightSampling::mis;
    if (mis && !weighs_later)
      weight = mis_weight(settings.mis_heuristic, n * pdf, points.bsdf_samples[i] * e.pdf);
    ShadowRay& shadow = shadows_[shadow_count_++];
    shadow.weighted_later = mis && weighs_later;
    if (shadow.weighted_later) shadow.light_pdf = n * pdf, shadow.bsdf_pdf = points.bsdf_samples[i] * e.pdf;
    shadow.lane = i;
    shadow.light = contribution * (weight / (pdf * n));
    if (points.layered != nullptr)
      shadow.layer = scene.layer_of_light(static_cast<std::uint32_t>(query.light - scene.lights().data()));
    set_ray(shadow, vertices.time[i]);
    if (!scene.has_media()) continue;
    // The point's media are those on the side of wo.
    shadow.media = *points.media[i];
    if (directions_.cosine[i] < 0) shadow.media.cross(vertices.material[i]->media, vertices.side[i] > 0);
  }
}

void DirectLight::set_ray(ShadowRay& shadow, float time) const {
  const std::size_t i = shadow.lane;
  const bool infinite = lights_.infinite[i] != 0;
  shadow.target = {directions_.target[i], infinite};
  shadow.ray.origin = directions_.origin[i];
  shadow.ray.direction = infinite ? directions_.direction[i] : shadow.target.point - shadow.ray.origin;
  // Both ends are off their surfaces by their error bounds, so what is left must be free but for what the
  // distance adds to the rounding of t.
  shadow.ray.t_max = infinite ? kInfinity : 1 - gamma_bound(16);
  shadow.ray.time = time;
}

/// Gives a point the light of the shadow ray that reaches it.
void DirectLight::add(ShadingPoints& points, const ShadowRay& shadow, Spectrum light) {
  points.light[shadow.lane] += light;
  if (points.layered != nullptr) points.layered->push_back({shadow.lane, shadow.layer, light});
}

/// The share of its light that reaches the point, with the MIS weight where that waits for it: the density
/// with which BSDF sampling finds the light has the probability of no collision between in it. For the weight
/// it is enough to know that of a path whose throughput is the same in all channels.
Spectrum DirectLight::passed(const RenderScene& scene, const ShadowRay& shadow, const ShadingPoints& points,
                             MisHeuristic heuristic, RayCounts& counts) {
  const MediumStack* media = scene.has_media() ? &shadow.media : nullptr;
  const Sampler& sampler = *points.sampler[shadow.lane];
  if (!shadow.weighted_later) return transmittance(scene, shadow.ray, shadow.target, sampler, counts, media);
  Spectrum unscattered;
  const Spectrum through =
      transmittance(scene, shadow.ray, shadow.target, sampler, counts, media, &unscattered);
  return through * mis_weight(heuristic, shadow.light_pdf, shadow.bsdf_pdf * average(unscattered));
}

/// Gives the points the light that reaches them.
void DirectLight::trace_shadow_rays(const RenderScene& scene, ShadingPoints& points, MisHeuristic heuristic,
                                    RayCounts& counts, StopPoll& stop) {
  const std::span<const ShadowRay> shadows(shadows_.data(), shadow_count_);
  const bool anything_passes = scene.has_transparency() || scene.has_media();
  if (!points.coherent && !anything_passes) {
    counts.shadow += shadows.size();
    for (const ShadowRay& shadow : shadows)
      if (!scene.geometry().accel().occluded(shadow.ray)) add(points, shadow, shadow.light);
    return;
  }
  if (anything_passes) {
    for (const ShadowRay& shadow : shadows) {
      if (stop.asked()) return;
      const Spectrum through = passed(scene, shadow, points, heuristic, counts);
      if (!is_black(through)) add(points, shadow, shadow.light * through);
    }
    return;
  }
  Lanes<const Ray*> rays;
  Lanes<bool> occluded;
  for (std::size_t k = 0; k < shadows.size(); ++k) rays[k] = &shadows[k].ray;
  counts.shadow += shadows.size();
  scene.geometry().accel().occluded({rays.data(), shadows.size()}, occluded);
  for (std::size_t k = 0; k < shadows.size(); ++k)
    if (!occluded[k]) add(points, shadows[k], shadows[k].light);
}

void DirectLight::estimate(const RenderScene& scene, const VertexLanes& vertices, ShadingPoints& points,
                           const PathSettings& settings, RayCounts& counts, StopPoll& stop) {
  for (std::size_t k = 0; k < points.count; ++k) points.light[points.lane[k]] = Spectrum(0);
  if (points.layered != nullptr) points.layered->clear();
  const bool all = settings.light_sampling != LightSampling::bsdf;
  const LightSelection& selection = all ? scene.all_lights() : scene.delta_lights();
  if (selection.empty()) return;
  for (std::uint32_t index = 0; index < static_cast<std::uint32_t>(settings.light_samples); ++index) {
    draw_numbers(points, index, settings.light_samples);
    select_lights(scene, selection, vertices, points);
    sample_lights({queries_.data(), query_count_}, lights_);
    if (scene.has_textured_lights()) look_up_radiance(scene);
    set_directions(vertices, lights_, directions_);
    weight_samples(scene, vertices, points, settings);
    trace_shadow_rays(scene, points, settings.mis_heuristic, counts, stop);
    if (stop.asked()) return;
  }
}

Spectrum ScalarDirectLight::estimate(const RenderScene& scene, const Vertex& vertex, const Bsdf& bsdf,
                                     const Sampler& sampler, const PathSettings& settings, RayCounts& counts,
                                     StopPoll& stop, const MediumStack* media) {
  vertices_.set_one(vertex, bsdf);
  points_.count = 1;
  points_.lane[0] = 0;
  points_.sampler[0] = &sampler;
  points_.bsdf_samples[0] = 0;
  points_.media[0] = media;
  direct_light_.estimate(scene, vertices_, points_, settings, counts, stop);
  return points_.light[0];
}

} // namespace candela
