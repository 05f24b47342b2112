#include "render/path_integrator.h"

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
  int last = settings.max_depth < 0 ? std::numeric_limits<int>::max() : settings.max_depth;
  if (settings.only_depth > 0) last = std::min(last, settings.only_depth);
  if (settings.component == PathComponent::emitted) last = std::min(last, 1);
  if (settings.component == PathComponent::direct) last = std::min(last, 2);
  return last;
}

PathTracer::PathTracer(const RenderScene& scene, const PathSettings& settings)
    : scene_(scene), settings_(settings), last_depth_(longest_path(settings)) {}

/// With segments numbered by depth = 1, 2, ... the estimate is the sum over vertices of
///   throughput x (emission met by chance, weighted + light aimed at, weighted).
void PathTracer::trace(std::span<const PathStart> starts, std::span<PathSample> results, RayCounts& counts) {
  results_ = results;
  counts_ = {};
  paths_.clear();
  for (std::uint32_t i = 0; i < starts.size(); ++i) {
    results_[i] = {};
    Path& path = paths_.emplace_back(starts[i]);
    path.result = i;
    path.split = starts[i].sampler.sample() == 0;
  }
  for (int depth = 1; depth <= last_depth_ && !paths_.empty(); ++depth) {
    meet_surfaces(depth);
    aim(depth);
    choose_directions(depth);
    std::swap(paths_, next_);
  }
  counts += counts_;
}

void PathTracer::meet_surfaces(int depth) {
  arrived_.clear();
  missed_.clear();
  hits_.resize(paths_.size());
  for (Path& path : paths_) {
    path.sampler.set_bounce(static_cast<std::uint32_t>(depth));
    if (intersect_scene(scene_, path.ray, path.sampler, hits_[arrived_.size()], counts_))
      arrived_.push_back(&path);
    else
      missed_.push_back(&path);
  }
  if (shows_depth(settings_, depth)) meet_background(depth);
  stops_.clear();
  for (std::size_t i = 0; i < arrived_.size(); ++i) {
    Path& path = *arrived_[i];
    Stop& stop = stops_.emplace_back(path, scene_, hits_[i]);
    const Vertex& vertex = stop.vertex;
    const SurfaceMaterial& material = *vertex.material;
    const bool outside = vertex.side > 0;
    if (material.absorbing && !outside) // it came through the inside of this body (Beer-Lambert)
      path.throughput *=
          glm::exp(-material.absorption * glm::length(vertex.surface.position - path.reference.position));
    if (material.emissive && (outside || material.two_sided_emission)) add_emission(path, vertex, depth);
    if (depth == last_depth_ || !vertex.scatters()) {
      stops_.pop_back();
      continue;
    }
    if (material.diffuse_texture != nullptr) stop.textured = evaluate_bsdf(material, vertex.surface);
    stop.specular = bsdf_delta_probability(stop.bsdf(), vertex.wo_local) >= 1;
    prepare_aiming(stop);
    stop.branches = path.split || stop.specular ? 1 : settings_.split;
    path.split |= !stop.specular;
  }
}

/// What lights need to know of a stop.
void PathTracer::prepare_aiming(Stop& stop) const {
  const Vertex& vertex = stop.vertex;
  LightReference& reference = stop.vertex.reference;
  reference.also_by_chance = settings_.light_sampling == LightSampling::mis;
  if (!scene_.all_lights().is_choice() || std::holds_alternative<Diffuse>(stop.bsdf())) return;
  reference.gloss = gloss_of(stop.bsdf(), vertex.wo_local);
  reference.mirrored = vertex.frame.to_world(reflect_about_normal(vertex.wo_local));
}

/// Weight of a light met by chance, given the density (1/sr) with which aiming would have found it.
float PathTracer::weight_by_chance(const Path& path, float aimed_pdf) const {
  if (path.arrived_by_delta || settings_.light_sampling == LightSampling::bsdf) return 1;
  if (settings_.light_sampling == LightSampling::nee) return 0;
  return mis_weight(settings_.mis_heuristic, path.arrival_density,
                    aimed_pdf * static_cast<float>(settings_.light_samples));
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
  float aimed = needs_aimed_pdf(path) ? scene_.all_lights().pmf(path.reference, light) * pdf : 0;
  results_[path.result].add(path.throughput * radiance * weight_by_chance(path, aimed), depth);
}

void PathTracer::add_emission(const Path& path, const Vertex& vertex, int depth) {
  if (!shows_depth(settings_, depth)) return;
  float aimed = 0;
  if (needs_aimed_pdf(path)) {
    std::uint32_t i = scene_.light_of(vertex.surface.emitter);
    if (i != kNoLight)
      aimed = scene_.all_lights().pmf(path.reference, i) *
              light_pdf(scene_.lights()[i], path.reference, vertex.surface.position, path.ray.direction);
  }
  results_[path.result].add(path.throughput * vertex.material->emission * weight_by_chance(path, aimed),
                            depth);
}

/// Direct light at the stops.
void PathTracer::aim(int depth) {
  if (!shows_depth(settings_, depth + 1)) return;
  seekers_.clear();
  for (const Stop& stop : stops_)
    if (!stop.specular) seekers_.push_back({&stop.vertex, &stop.bsdf(), &stop.path->sampler, stop.branches});
  aim_at_lights(scene_, seekers_, settings_, counts_);
  auto seeker = seekers_.begin();
  for (const Stop& stop : stops_)
    if (!stop.specular)
      results_[stop.path->result].add_aimed(stop.path->throughput * (seeker++)->light, depth + 1);
}

/// The paths that go on, into next_.
void PathTracer::choose_directions(int depth) {
  next_.clear();
  tries_.clear();
  if (depth + 1 > last_depth_) return; // nothing beyond matters
  std::size_t split = 0;
  for (const Stop& stop : stops_)
    if (stop.branches > 1) split += static_cast<std::size_t>(stop.branches);
  branched_.clear();
  branched_.reserve(split); // draws_ point into it
  draws_.clear();
  for (const Stop& stop : stops_) {
    const auto branches = static_cast<std::uint32_t>(stop.branches);
    for (std::uint32_t k = 0; k < branches; ++k) {
      const Sampler& own = stop.path->sampler;
      tries_.push_back(&stop);
      draws_.push_back({branches > 1 ? &branched_.emplace_back(own.branch(k, branches)) : &own, 0});
    }
  }
  const std::size_t count = tries_.size();
  disc_.resize(count), lobe_u_.resize(count), roulette_u_.resize(count);
  Sampler::get_2d(draws_, Dimension::bsdf_direction, disc_);
  sample_uniform_discs(disc_);
  Sampler::get_1d(draws_, Dimension::bsdf_lobe, lobe_u_);
  Sampler::get_1d(draws_, Dimension::russian_roulette, roulette_u_);
  const Roulette roulette = Roulette::at(settings_, depth);
  for (std::size_t begin = 0; begin < count; begin += kLaneCount)
    leave(begin, std::min(kLaneCount, count - begin), roulette);
}

/// Follows those of the tries that go on.
void PathTracer::leave(std::size_t begin, std::size_t count, const Roulette& roulette) {
  OnwardLanes& lanes = onward_;
  lanes.count = 0;
  for (std::size_t i = begin; i < begin + count; ++i) {
    const Stop& from = *tries_[i];
    const Vertex& vertex = from.vertex;
    auto s =
        sample_direction(from.bsdf(), vertex.wo_local, {disc_[i], lobe_u_[i]}, settings_.direction_sampling);
    if (!s) continue;
    const auto branches = static_cast<float>(from.branches);
    const std::size_t k = lanes.count++;
    leaving_[k] = {i, s->pdf * branches, s->delta};
    lanes.normal.set(k, vertex.frame.n);
    lanes.geometric_normal.set(k, vertex.surface.geometric_normal);
    lanes.position.set(k, vertex.surface.position);
    lanes.position_error.set(k, vertex.surface.position_error);
    lanes.side[k] = vertex.side;
    lanes.local.set(k, s->wi);
    lanes.cosines[k] = s->wi.z * vertex.wo_local.z;
    lanes.throughput.set(k, from.path->throughput * s->weight / branches);
    lanes.unscaled[k] = from.path->roulette_scale * sqr(s->eta) * branches;
    lanes.u[k] = roulette_u_[i];
  }
  lanes.choose(roulette);
  // Who survives cannot be predicted.
  std::size_t survivors = 0;
  std::array<std::uint32_t, kLaneCount> going;
  for (std::uint32_t k = 0; k < lanes.count; ++k) {
    going[survivors] = k;
    survivors += static_cast<std::size_t>(lanes.goes_on[k]);
  }
  for (std::size_t n = 0; n < survivors; ++n) {
    const std::size_t k = going[n];
    const Leaving& leaving = leaving_[k];
    const Stop& from = *tries_[leaving.attempt];
    Path& path = next_.emplace_back(*draws_[leaving.attempt].sampler);
    path.ray.origin = lanes.origin[k];
    path.ray.direction = lanes.direction[k];
    path.throughput = lanes.throughput[k];
    path.roulette_scale = lanes.unscaled[k];
    path.result = from.path->result;
    path.split = from.path->split;
    path.arrived_by_delta = leaving.delta;
    path.arrival_density = leaving.density;
    path.reference = from.vertex.reference;
  }
}

} // namespace candela
