#include "render/integrators/path_integrator.h"

namespace candela {

bool shows_depth(const PathSettings& settings, int depth) {
  if (settings.only_depth > 0 && depth != settings.only_depth) return false;
  switch (settings.component) {
  case PathComponent::all: return true;
  case PathComponent::emitted: return depth == 1;
  case PathComponent::direct: return depth == 2;
  case PathComponent::indirect: return depth > 2;
  }
  return true;
}

int longest_path(const PathSettings& settings) {
  int last = settings.max_depth;
  if (last < 0)
    last =
        settings.rr == RussianRoulette::off ? kMostSegmentsWithoutRoulette : std::numeric_limits<int>::max();
  if (settings.only_depth > 0) last = std::min(last, settings.only_depth);
  if (settings.component == PathComponent::emitted) last = std::min(last, 1);
  if (settings.component == PathComponent::direct) last = std::min(last, 2);
  return last;
}

PathTracer::PathTracer(const RenderScene& scene, const PathSettings& settings)
    : scene_(scene), settings_(settings), last_depth_(longest_path(settings)) {
  branched_.reserve(kLaneCount); // draws point into it
}

/// With segments numbered by depth = 1, 2, ... the estimate is the sum over vertices of
///   throughput x (emission met by chance, weighted + light aimed at, weighted).
bool PathTracer::trace(std::span<const PathStart> starts, std::span<PathSample> results, RayCounts& counts,
                       StopPoll& stop) {
  results_ = results;
  counts_ = {};
  paths_.clear();
  interiors_.clear();
  for (std::uint32_t i = 0; i < starts.size(); ++i) {
    results_[i] = {};
    Path& path = paths_.emplace_back(starts[i]);
    path.result = i;
    path.split = starts[i].sampler.sample() == 0;
    if (scene_.has_absorption()) interiors_.push_back(starts[i].interiors);
  }
  for (int depth = 1; depth <= last_depth_ && !paths_.empty(); ++depth) {
    intersect(depth, stop);
    meet_emitters(depth);
    next_.clear();
    next_interiors_.clear();
    if (depth < last_depth_)
      for (std::size_t begin = 0; begin < arrived_.size(); begin += kLaneCount)
        stop_at(begin, std::min(kLaneCount, arrived_.size() - begin), depth, stop);
    if (stop.asked()) return false;
    std::swap(paths_, next_);
    std::swap(interiors_, next_interiors_);
  }
  counts += counts_;
  return true;
}

/// Rays between two looks at whether to stop: single ones may take milliseconds.
constexpr std::size_t kRaysAtATime = 16;

void PathTracer::intersect(int depth, StopPoll& stop) {
  arrived_.clear();
  missed_.clear();
  hits_.resize(paths_.size());
  // Neighbours they are as long as they come from the camera.
  const bool together = depth == 1;
  if (together) {
    rays_.clear();
    for (const Path& path : paths_) rays_.push_back(&path.ray);
    scene_.geometry().accel().intersect(rays_, hits_);
    counts_.closest += rays_.size();
  }
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (i % kRaysAtATime == 0 && stop.asked()) return;
    Path& path = paths_[i];
    path.sampler.set_bounce(static_cast<std::uint32_t>(depth));
    Hit& hit = hits_[arrived_.size()]; // at i or before
    if (together) hit = hits_[i];
    bool met;
    if (scene_.has_absorption())
      met = meet_in_bodies(i, together, hit.t < kInfinity, hit);
    else if (together)
      met = look_through(scene_, path.ray, path.sampler, hit.t < kInfinity, hit, counts_);
    else
      met = intersect_scene(scene_, path.ray, path.sampler, hit, counts_);
    if (met)
      arrived_.push_back(&path);
    else
      missed_.push_back(&path);
  }
  if (shows_depth(settings_, depth)) meet_background(depth);
}

/// Whether the ray of paths_[index] meets a surface, and what is left of its light there. `known`: what it
/// meets first is, as look_through() has it.
bool PathTracer::meet_in_bodies(std::size_t index, bool known, bool met, Hit& hit) {
  Path& path = paths_[index];
  Passage passage{interiors_[index], vec3(1)};
  met = known ? look_through(scene_, path.ray, path.sampler, met, hit, counts_, &passage)
              : intersect_scene(scene_, path.ray, path.sampler, hit, counts_, &passage);
  interiors_[index] = passage.interiors;
  path.throughput *= passage.transmittance;
  return met;
}

/// What happens to paths on arrival. Before all else, for emission and light that is aimed at are added up,
/// and their order must not depend on which paths share lanes.
void PathTracer::meet_emitters(int depth) {
  for (std::size_t i = 0; i < arrived_.size(); ++i) {
    const SurfaceMaterial& material = scene_.material(scene_.geometry().material_of(hits_[i]));
    if (!material.emissive) continue;
    Path& path = *arrived_[i];
    const Surface surface = scene_.geometry().surface(path.ray, hits_[i]);
    const bool outside = glm::dot(-path.ray.direction, surface.geometric_normal) > 0;
    if (!outside && !material.two_sided_emission) continue;
    const vec3 emission = emission_at(material, [&] { return scene_.geometry().uv(path.ray, hits_[i]); });
    add_emission(path, surface, emission, depth);
  }
}

/// Stops the paths that arrived at hits_[begin ...] there: aims at lights, and sends on those that go on.
void PathTracer::stop_at(std::size_t begin, std::size_t count, int depth, StopPoll& stop) {
  if (stop.asked()) return;
  Lanes<const Ray*> rays;
  for (std::size_t i = 0; i < count; ++i) rays[i] = &arrived_[begin + i]->ray;
  vertices_.meet(scene_, {rays.data(), count}, std::span(hits_).subspan(begin, count));
  stops_.clear();
  seekers_.count = 0;
  seekers_.neighbours = depth == 1;
  several_lobes_ = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!vertices_.scatters(i)) continue;
    Path& path = *arrived_[begin + i];
    const Bsdf& bsdf = vertices_.bsdf(i);
    const bool specular = bsdf_delta_probability(bsdf, vertices_.wo_local[i]) >= 1;
    const int branches = path.split || specular ? 1 : settings_.split;
    path.split |= !specular;
    several_lobes_ |= !std::holds_alternative<Diffuse>(bsdf);
    stops_.push_back({&path, i, branches});
    if (specular) continue; // there is nothing that could be aimed from
    prepare_aiming(i);
    seekers_.lane[seekers_.count++] = i;
    seekers_.sampler[i] = &path.sampler;
    seekers_.scattered[i] = branches;
    if (scene_.has_absorption()) seekers_.interiors[i] = &interiors_of(path);
  }
  if (shows_depth(settings_, depth + 1)) {
    direct_light_.aim(scene_, vertices_, seekers_, settings_, counts_, stop);
    for (std::uint32_t i : std::span(seekers_.lane.data(), seekers_.count)) {
      const Path& path = *arrived_[begin + i];
      results_[path.result].add_aimed(path.throughput * seekers_.light[i], depth + 1);
    }
  }
  for (std::uint32_t branch = 0; leave(branch, depth); ++branch) {}
}

/// What lights need to know of a vertex.
void PathTracer::prepare_aiming(std::size_t i) {
  LightReference& reference = vertices_.reference[i];
  const Bsdf& bsdf = vertices_.bsdf(i);
  reference.also_by_chance = settings_.light_sampling == LightSampling::mis;
  reference.gloss = {};
  if (!scene_.all_lights().is_choice() || std::holds_alternative<Diffuse>(bsdf)) return;
  const vec3 wo = vertices_.wo_local[i];
  reference.gloss = gloss_of(bsdf, wo);
  reference.mirrored = Basis::from_normal(vertices_.normal[i]).to_world(reflect_about_normal(wo));
}

/// Weight of a light met by chance, given the density (1/sr) with which aiming would have found it.
float PathTracer::weight_by_chance(const Path& path, float aimed) const {
  if (path.arrived_by_delta || settings_.light_sampling == LightSampling::bsdf) return 1;
  if (settings_.light_sampling == LightSampling::nee) return 0;
  return mis_weight(settings_.mis_heuristic, path.arrival_density,
                    aimed * static_cast<float>(settings_.light_samples));
}

bool PathTracer::needs_aimed_pdf(const Path& path) const {
  return !path.arrived_by_delta && settings_.light_sampling == LightSampling::mis;
}

/// The infinite lights behind the paths that missed all surfaces.
void PathTracer::meet_background(int depth) {
  for (std::uint32_t i : scene_.infinite_lights()) {
    const Light& light = scene_.lights()[i];
    if (const auto* environment = std::get_if<EnvironmentLight>(&light)) {
      // All texels are sent for before the first is waited for: with a panorama of 2048 x 1024 that halves
      // the time of looking at it.
      places_.clear();
      for (const Path* path : missed_)
        places_.push_back(environment->map->locate(path->ray.direction * environment->world_from_map));
      for (std::size_t k = 0; k < missed_.size(); ++k) {
        auto seen = environment->map->look(places_[k], missed_[k]->reference.environment_aim());
        add_background(*missed_[k], i, environment->factor * seen.radiance, seen.pdf, depth);
      }
    } else {
      for (const Path* path : missed_)
        add_background(*path, i, light_radiance(light, path->ray.direction),
                       light_pdf(light, path->reference, {}, path->ray.direction), depth);
    }
  }
}

void PathTracer::add_background(const Path& path, std::uint32_t light, vec3 radiance, float pdf, int depth) {
  float aimed = needs_aimed_pdf(path) ? aimed_pdf(scene_, path.reference, light, pdf, path.ray.direction) : 0;
  results_[path.result].add(path.throughput * radiance * weight_by_chance(path, aimed), depth);
}

void PathTracer::add_emission(const Path& path, const Surface& surface, vec3 emission, int depth) {
  if (!shows_depth(settings_, depth)) return;
  float aimed = 0;
  if (needs_aimed_pdf(path)) {
    std::uint32_t i = scene_.light_of(surface.emitter);
    if (i != kNoLight)
      aimed = aimed_pdf(scene_, path.reference, i,
                        light_pdf(scene_.lights()[i], path.reference, surface.position, path.ray.direction),
                        path.ray.direction);
  }
  results_[path.result].add(path.throughput * emission * weight_by_chance(path, aimed), depth);
}

/// Sends the stops' paths on, those that split once more for each branch. False where none has so many.
bool PathTracer::leave(std::uint32_t branch, int depth) {
  Lanes<const Stop*> from;
  Lanes<Sampler::Draw> draws;
  std::size_t count = 0;
  branched_.clear();
  for (const Stop& stop : stops_) {
    const auto branches = static_cast<std::uint32_t>(stop.branches);
    if (branch >= branches) continue;
    const Sampler& own = stop.path->sampler;
    from[count] = &stop;
    draws[count++] = {branches > 1 ? &branched_.emplace_back(own.branch(branch, branches)) : &own, 0};
  }
  if (count == 0) return false;
  Lanes<vec2> disc;
  Lanes<float> lobe_u{}, roulette_u;
  const std::span<const Sampler::Draw> asked(draws.data(), count);
  Sampler::get_2d(asked, Dimension::bsdf_direction, disc);
  if (several_lobes_) Sampler::get_1d(asked, Dimension::bsdf_lobe, lobe_u);
  Sampler::get_1d(asked, Dimension::russian_roulette, roulette_u);
  sample_uniform_discs({disc.data(), count});

  /// A direction in onward_.
  struct Leaving {
    std::uint32_t k; ///< index into from
    float density;   ///< Path::arrival_density
    bool delta;
  };
  Lanes<Leaving> leaving;
  std::size_t left = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Stop& stop = *from[k];
    const std::uint32_t i = stop.lane;
    auto s = sample_direction(vertices_.bsdf(i), vertices_.wo_local[i], {disc[k], lobe_u[k]},
                              settings_.direction_sampling);
    if (!s) continue;
    const auto branches = static_cast<float>(stop.branches);
    leaving[left++] = {k, s->pdf * branches, s->delta};
    onward_.wi_local.set(i, s->wi);
    onward_.throughput.set(i, stop.path->throughput / branches * s->weight);
    onward_.unscaled[i] = stop.path->roulette_scale * branches * sqr(s->eta);
    onward_.u[i] = roulette_u[k];
  }
  // Apart from the loop above, which is quicker without.
  onward_.folds.fill(0);
  for (std::uint32_t n = 0; several_lobes_ && n < left; ++n) {
    const Stop& stop = *from[leaving[n].k];
    const std::uint32_t i = stop.lane;
    if (!vertices_.folds(i)) continue;
    onward_.folds[i] = 1;
    if (!leaving[n].delta)
      leaving[n].density += static_cast<float>(stop.branches) *
                            vertices_.folded_pdf(i, onward_.wi_local[i], settings_.direction_sampling);
  }
  onward_.choose(vertices_, Roulette::at(settings_, depth));
  const bool absorbs = scene_.has_absorption();
  // Who survives cannot be predicted.
  Lanes<std::uint32_t> going;
  std::size_t survivors = 0;
  for (std::uint32_t n = 0; n < left; ++n) {
    going[survivors] = n;
    survivors += static_cast<std::size_t>(onward_.goes_on[from[leaving[n].k]->lane]);
  }
  for (std::uint32_t n : std::span(going.data(), survivors)) {
    const Stop& stop = *from[leaving[n].k];
    const std::uint32_t i = stop.lane;
    Path& path = next_.emplace_back(*draws[leaving[n].k].sampler);
    path.ray.origin = onward_.origin[i];
    path.ray.direction = onward_.direction[i];
    path.throughput = onward_.throughput[i];
    path.roulette_scale = onward_.unscaled[i];
    path.result = stop.path->result;
    path.split = stop.path->split;
    path.arrived_by_delta = leaving[n].delta;
    path.arrival_density = leaving[n].density;
    path.reference = vertices_.reference[i];
    if (absorbs) {
      Interiors& interiors = next_interiors_.emplace_back(interiors_of(*stop.path));
      if (!same_hemisphere(vertices_.wo_local[i], onward_.wi_local[i])) // it goes through the surface
        interiors.cross(vertices_.material[i]->interior, vertices_.side[i] > 0);
    }
  }
  return true;
}

} // namespace candela
