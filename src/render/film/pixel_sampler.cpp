#include "render/film/pixel_sampler.h"

#include "render/integrators/ao_integrator.h"
#include "render/integrators/first_hit_view.h"

namespace candela {

namespace {

PathSample ambient_occlusion_sample(const RenderScene& scene, const PathStart& start, Sampler& sampler,
                                    const RenderSettings& settings, RayCounts& counts) {
  PathSample sample;
  sample.direct = vec3(ambient_occlusion(scene, start, sampler, settings, counts));
  return sample;
}

PathSettings path_settings(const RenderSettings& settings) {
  PathSettings path = settings.path;
  if (settings.integrator == Integrator::direct)
    path.max_depth = path.max_depth < 0 ? 2 : std::min(path.max_depth, 2);
  return path;
}

} // namespace

PixelSampler::PixelSampler(const RenderScene& scene, const Document& document, const StopCondition& stop,
                           std::shared_ptr<const CameraModel> camera)
    : stop_(stop), scene_(scene), settings_(document.settings), view_(accumulated_view(settings_.view)),
      camera_view_(document.scene.camera, document.settings.film.width, document.settings.film.height),
      rays_(document, std::move(camera)), sampler_(PixelRays::sampler(settings_.sampler)),
      paths_(scene, path_settings(settings_)), camera_media_(scene, camera_view_.position()) {}

bool PixelSampler::sample(std::span<const SampleIndex> indices, std::span<PixelSample> results,
                          RayCounts& counts) {
  RayCounts made;
  evaluate(indices, results, made);
  if (stop_.asked()) return false;
  made.samples = indices.size();
  counts += made;
  return true;
}

PixelSample PixelSampler::sample(const SampleIndex& index) {
  PixelSample result;
  RayCounts ignored;
  sample({&index, 1}, {&result, 1}, ignored);
  return result;
}

void PixelSampler::evaluate(std::span<const SampleIndex> indices, std::span<PixelSample> results,
                            RayCounts& counts) {
  start(indices);
  layers_.resize(indices.size() * layer_count_);
  const std::span<PathSample> layers(layers_.data(), starts_.size() * layer_count_);
  if (starts_.size() < indices.size()) // samples without a ray are black
    std::fill_n(results.begin(), indices.size(), PixelSample{});
  if (!shows_light()) {
    view_first_hits(results, counts);
  } else if (follows_paths()) {
    parts_.resize(starts_.size());
    if (!paths_.trace(starts_, parts_, counts, stop_, layers)) return;
    for (std::size_t i = 0; i < starts_.size(); ++i) show(parts_[i], results[sample_of_[i]]);
  } else {
    for (std::size_t i = 0; i < starts_.size() && !stop_.asked(); ++i)
      sample_singly(starts_[i], results[sample_of_[i]], layers.subspan(i * layer_count_, layer_count_),
                    counts);
  }
  if (layer_count_ > 0) place_layers(indices.size());
  for (std::size_t i = 0; i < starts_.size(); ++i) { // as the pixel's filter and the camera weigh them
    if (weights_[i] == 1) continue;                  // always, for most filters
    results[sample_of_[i]].value *= weights_[i];
    results[sample_of_[i]].parts *= weights_[i];
  }
}

/// Brings the layers of the samples that have a ray, which lie first, to their samples, and weighs them.
void PixelSampler::place_layers(std::size_t count) {
  const auto n = static_cast<std::ptrdiff_t>(layer_count_);
  auto at = [&](std::size_t i) { return layers_.begin() + static_cast<std::ptrdiff_t>(i) * n; };
  std::size_t free = count; // from here on all are in their places
  for (std::size_t i = starts_.size(); i-- > 0; free = sample_of_[i]) {
    const std::size_t to = sample_of_[i]; // at i or behind
    std::fill(at(to + 1), at(free), PathSample{});
    if (to != i) std::copy(at(i), at(i + 1), at(to));
    if (weights_[i] == 1) continue;
    for (auto layer = at(to); layer != at(to + 1); ++layer) *layer *= weights_[i];
  }
  std::fill(at(0), at(free), PathSample{});
}

bool PixelSampler::shows_light() const {
  return view_ == View::radiance || view_ == View::depth_share || view_ == View::light_share;
}

bool PixelSampler::follows_paths() const {
  return settings_.integrator == Integrator::path || settings_.integrator == Integrator::direct;
}

/// Makes the camera rays, of the samples that have one.
void PixelSampler::start(std::span<const SampleIndex> indices) {
  starts_.resize(indices.size(), {Ray(), sampler_});
  draws_.clear();
  for (std::size_t i = 0; i < indices.size(); ++i) {
    starts_[i].sampler.start(indices[i].pixel, indices[i].sample);
    draws_.push_back({&starts_[i].sampler, 0});
  }
  film_.resize(indices.size());
  lens_.assign(indices.size(), vec2(0));
  Sampler::get_2d(draws_, Dimension::film, film_);
  if (rays_.uses_lens_sample()) Sampler::get_2d(draws_, Dimension::lens, lens_);
  time_.assign(indices.size(), 0);
  if (rays_.uses_time_sample()) Sampler::get_1d(draws_, Dimension::time, time_);
  weights_.resize(indices.size());
  sample_of_.resize(indices.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    PathStart& start = starts_[count];
    if (count != i) start.sampler = starts_[i].sampler;
    const std::optional<float> weight = rays_.at(indices[i].pixel, film_[i], lens_[i], time_[i], start.ray);
    if (!weight) continue;
    weights_[count] = *weight;
    sample_of_[count++] = i;
    if (scene_.filters_textures()) start.cone = pixel_cone(start.ray);
    if (scene_.has_media()) start.media = camera_media_.at(start.ray.origin, start.ray.time);
  }
  starts_.erase(starts_.begin() + static_cast<std::ptrdiff_t>(count), starts_.end());
}

RayCone PixelSampler::pixel_cone(const Ray& ray) const {
  return camera_view_.pixel_cone(rays_.motion().direction_at_start(ray.direction, ray.time));
}

void PixelSampler::view_first_hits(std::span<PixelSample> results, RayCounts& counts) {
  if (view_ == View::bvh_cost) {
    for (std::size_t i = 0; i < starts_.size() && !stop_.asked(); ++i)
      results[sample_of_[i]] = {bvh_cost_value(scene_, starts_[i].ray, counts), {}};
    return;
  }
  camera_rays_.clear();
  for (const PathStart& start : starts_) camera_rays_.push_back(&start.ray);
  hits_.resize(starts_.size());
  scene_.geometry().accel().intersect(camera_rays_, hits_);
  counts.closest += starts_.size();
  for (std::size_t i = 0; i < starts_.size() && !stop_.asked(); ++i) {
    PathStart& start = starts_[i];
    const ConeOfRay cone{start.cone, start.ray.origin};
    const vec3 forward = rays_.motion().direction_at(camera_view_.forward(), start.ray.time);
    results[sample_of_[i]] = {first_hit_value(scene_, start.ray, start.media, hits_[i].t < kInfinity,
                                              hits_[i], forward, view_, start.sampler, counts,
                                              scene_.filters_textures() ? &cone : nullptr),
                              {}};
  }
}

/// By an integrator that takes one sample after the other.
void PixelSampler::sample_singly(PathStart& start, PixelSample& result, std::span<PathSample> layers,
                                 RayCounts& counts) {
  if (settings_.integrator == Integrator::whitted)
    show(whitted_radiance(scene_, start, start.sampler, settings_.path, direct_light_, counts, stop_, layers),
         result);
  else
    show(ambient_occlusion_sample(scene_, start, start.sampler, settings_, counts), result);
}

/// The view's value of the light.
void PixelSampler::show(const PathSample& parts, PixelSample& result) const {
  result.parts = parts;
  switch (view_) {
  case View::depth_share:
    result.value = {luminance(parts.emitted + parts.direct), luminance(parts.one_bounce),
                    luminance(parts.more)};
    break;
  case View::light_share:
    result.value = {luminance(parts.light_sampled),
                    luminance(parts.direct + parts.indirect() - parts.light_sampled), 0};
    break;
  default:
    result.value = parts.radiance();
    if (settings_.path.clamp > 0) result.value = glm::min(result.value, settings_.path.clamp);
  }
}

} // namespace candela
