// What happens to paths between surfaces, where media scatter or shine.
//
// Light that is scattered once towards the eye is the integral, over the distance t on a ray and the
// direction to a light, of sigma_s x transmittance x phase function x radiance. Two strategies sample it: a
// collision of the path itself, at a distance of the density p, which then meets the light; and light
// sampling, at a distance of its own, whose density q is a mixture of
// - a collision that is made to happen, for thin media, which paths mostly pass; and
// - equiangular sampling about a place on a light (Kulla & Fajardo 2012), for what is near to lights.
// The place is chosen first, with random numbers that both strategies share. Given it both densities are
// known, so they are combined by MIS.

#include "render/integrators/medium_tracking.h"
#include "render/integrators/path_integrator.h"

namespace candela {

namespace {

/// A place on a light, for equiangular sampling: the middle of what is round, else any.
std::optional<vec3> light_pivot(const Light& light, const LightSamplingContext& context, float u,
                                const Sampler& sampler) {
  return visit_variant(
      [&](const auto& l) -> std::optional<vec3> {
        if constexpr (requires { l.center; }) {
          return l.center;
        } else if constexpr (requires { l.position; }) {
          return l.position;
        } else {
          const auto sample = l.sample(context, {u, sampler.get_1d(Dimension::medium_pivot, 1)});
          if (!sample || sample->infinite) return std::nullopt;
          return sample->point;
        }
      },
      light);
}

const PhaseFunction& phase_of(const MediumPoint& point) { return phase_function(*point.segment->medium); }
/// Scattering coefficient there, 1/scene unit.
Spectrum sigma_s_of(const MediumWay& way, const MediumPoint& point) {
  if (const auto* uniform = std::get_if<HomogeneousMedium>(point.segment->medium)) return uniform->sigma_s;
  return std::get<GridMedium>(*point.segment->medium).sigma_s_at(way.position(point));
}

} // namespace

/// Through surfaces that are passed and media, to a collision in one of them or beyond all. A ray that may
/// not be followed by another segment is weighted by the transmittance; else it comes through with a
/// probability.
PathTracer::RayEnd PathTracer::pass_active_media(std::size_t index, bool met, Hit& hit, int depth) {
  Path& path = paths_[index];
  path.ray.t_max = kInfinity; // of collision_distance()
  const Ray ray = path.ray;   // before it is moved behind surfaces that it passes
  MediaPassage passage{media_[index], Spectrum(1), &way_};
  met = intersect_through_opacity(scene_, path.ray, path.sampler, met, hit, counts_, &passage,
                                  cone_of_view(path));
  const RayEnd end = met ? RayEnd::surface : RayEnd::escaped;
  if (way_.has_grids()) return pass_grids(index, ray, end, passage.media, depth);
  if (way_.emits() && shows_depth(settings_, depth)) add_medium_emission(path, way_.emitted(), depth);
  if (way_.scatters()) {
    const Spectrum channels = channel_probabilities(path.throughput);
    if (depth < last_depth_) {
      const auto collision = way_.sample_collision(channels, path.sampler.get_2d(Dimension::medium_distance));
      const float pdf_ratio =
          choose_light_vertex(path, ray, channels, collision ? &*collision : nullptr, depth);
      if (collision) {
        path.throughput *= sigma_s_of(way_, *collision) * collision->transmittance /
                           way_.collision_pdf(*collision, channels);
        media_[index] = collision->segment->bodies;
        collisions_.push_back({&path, way_.position(*collision), &phase_of(*collision), pdf_ratio});
        return RayEnd::collision;
      }
    }
    const float passes = way_.pass_probability(channels);
    // As DirectLight::passed() has it. No less than what is no number any more, for it may be infinite.
    path.bsdf_pdf *= std::max(average(way_.unscattered()), std::numeric_limits<float>::min());
    if (depth < last_depth_) path.throughput *= passes > 0 ? 1 / passes : 0;
  }
  path.throughput *= way_.transmittance();
  media_[index] = passage.media;
  return end;
}

/// The distance beyond which a ray need not be traced, for it collides before: known of one that starts in a
/// sealed medium, where nothing but the collision matters.
float PathTracer::collision_distance(const Path& path, int depth) const {
  const MediumId id = scene_.filling(media_[static_cast<std::size_t>(&path - paths_.data())]);
  if (!id || depth >= last_depth_ || !scene_.is_sealed(id)) return kInfinity;
  const Medium& medium = scene_.medium(id);
  if (!medium_scatters(medium) || medium_emits(medium)) return kInfinity;
  return MediumWay::collision_distance(medium, channel_probabilities(path.throughput),
                                       path.sampler.get_2d(Dimension::medium_distance));
}

/// pass_active_media() where a part of the way is a grid.
PathTracer::RayEnd PathTracer::pass_grids(std::size_t index, const Ray& ray, RayEnd end,
                                          const MediumStack& behind, int depth) {
  Path& path = paths_[index];
  const Spectrum channels = channel_probabilities(path.throughput);
  const bool collides = way_.scatters() && depth < last_depth_;
  TrackingRandom random(path.sampler, ray.origin, ray.direction);
  const TrackedWay tracked = track(way_, channels, collides, random);
  if (way_.emits() && shows_depth(settings_, depth)) add_medium_emission(path, tracked.emitted, depth);
  const auto& collision = tracked.collision;
  const bool apart = collides && samples_apart();
  float pdf_ratio = 1;
  if (apart) {
    std::optional<MediumPoint> point;
    if (collision) point = way_.at(collision->distance);
    pdf_ratio = choose_light_vertex(path, ray, channels, point ? &*point : nullptr, depth);
  }
  if (collision) {
    path.throughput *= collision->weight;
    media_[index] = collision->segment->bodies;
    const PhaseFunction& phase = phase_function(*collision->segment->medium);
    if (!apart && way_.is_lit() && shows_depth(settings_, depth + 1))
      light_vertices_.push_back(
          {{&path, collision->position, &phase, 1}, path.throughput, collision->segment->bodies});
    collisions_.push_back({&path, collision->position, &phase, pdf_ratio});
    return RayEnd::collision;
  }
  path.bsdf_pdf *= std::max(average(tracked.unscattered), std::numeric_limits<float>::min());
  path.throughput *= tracked.weight;
  media_[index] = behind;
  return end;
}

/// Whether lights are sampled at a point of their own on the way, rather than where the path collides: there
/// the transmittance, which has to be estimated, cancels; but few paths collide in what is thin.
bool PathTracer::samples_apart() const {
  switch (settings_.medium_sampling) {
  case MediumSampling::distance: return false;
  case MediumSampling::mis: return !way_.is_thick();
  case MediumSampling::equiangular: break;
  }
  return true;
}

/// Equiangular sampling about a place on a light that matters somewhere in the beginning of the media;
/// nothing where it is none, or infinitely far.
std::optional<EquiangularSampling> PathTracer::equiangular_about_light(const Path& path,
                                                                       const Ray& ray) const {
  const LightSelection& selection =
      settings_.light_sampling != LightSampling::bsdf ? scene_.all_lights() : scene_.delta_lights();
  if (selection.empty()) return std::nullopt;
  const vec2 u = path.sampler.get_2d(Dimension::medium_pivot);
  const float begin = way_.scattering_begin(), end = way_.scattering_end();
  const float somewhere = begin + u.x * std::min(end - begin, way_.typical_free_path());
  const LightSamplingContext context =
      LightSamplingContext::in_volume(ray.origin + somewhere * ray.direction);
  const auto choice = selection.choose(context, u.y);
  if (!choice) return std::nullopt;
  const Light& light = scene_.lights()[choice->light];
  if (light_kind(light) == LightKind::infinite || light_kind(light) == LightKind::delta_direction)
    return std::nullopt;
  const auto pivot = light_pivot(light, context, choice->u, path.sampler);
  if (!pivot) return std::nullopt;
  const EquiangularSampling about(ray.origin, ray.direction, *pivot, begin, end);
  return about.is_usable() ? std::optional(about) : std::nullopt;
}

/// Chooses a point on the ray that lights are sampled for, light_vertices_. Returns MediumVertex::pdf_ratio
/// of the path's own collision, if there is one.
float PathTracer::choose_light_vertex(Path& path, const Ray& ray, Spectrum channels,
                                      const MediumPoint* collision, int depth) {
  if (!way_.is_lit() || !shows_depth(settings_, depth + 1)) return kInfinity;
  std::optional<EquiangularSampling> equiangular;
  if (settings_.medium_sampling != MediumSampling::distance) equiangular = equiangular_about_light(path, ray);
  const float share = !equiangular ? 0 : settings_.medium_sampling == MediumSampling::equiangular ? 1 : 0.5f;
  auto density = [&](const MediumPoint& point) {
    float pdf = 0;
    if (share < 1) pdf += (1 - share) * way_.forced_collision_pdf(point, channels);
    if (share > 0) pdf += share * equiangular->pdf(point.distance);
    return pdf;
  };
  // Where rounding has taken a collision out of its brick, it is the only way to be there.
  auto ratio = [&](const MediumPoint& point, float pdf) {
    return pdf > 0 ? way_.collision_pdf(point, channels) / pdf : kInfinity;
  };

  vec2 u = path.sampler.get_2d(Dimension::medium_direct);
  std::optional<MediumPoint> point;
  if (u.x < share) {
    point = way_.at(equiangular->sample(u.y));
  } else {
    u.x = (u.x - share) / (1 - share);
    point = way_.sample_forced_collision(channels, u);
  }
  if (point && max_component(point->sigma_t) > 0) {
    const float pdf = density(*point);
    Spectrum throughput = path.throughput * sigma_s_of(way_, *point) * point->transmittance / pdf;
    if (way_.has_grids() && !is_black(throughput)) {
      TrackingRandom random(path.sampler, ray.direction,
                            ray.origin); // not the numbers of the path's collision
      throughput *= track_transmittance(way_, point->distance, random);
    }
    if (!is_black(throughput))
      light_vertices_.push_back({{&path, way_.position(*point), &phase_of(*point), ratio(*point, pdf)},
                                 throughput,
                                 point->segment->bodies});
  }
  return collision != nullptr ? ratio(*collision, density(*collision)) : 0;
}

/// Emission of media belongs to no group of lights.
void PathTracer::add_medium_emission(const Path& path, Spectrum emission, int depth) {
  const Spectrum light_found = path.throughput * emission;
  results_[path.result].add(light_found, depth);
  if (!layers_.empty()) layer(path, scene_.layer_of_media()).add(light_found, depth);
}

/// Next-event estimation at light_vertices_.
void PathTracer::sample_lights_in_media(int depth, StopPoll& stop) {
  for (std::size_t begin = 0; begin < light_vertices_.size(); begin += kLaneCount) {
    const auto vertices =
        std::span(light_vertices_).subspan(begin, std::min(kLaneCount, light_vertices_.size() - begin));
    vertices_.count = shading_points_.count = vertices.size();
    shading_points_.coherent = false;
    shading_points_.draw = 1; // the segment may end at a surface, which has the numbers of 0
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      const MediumLightVertex& v = vertices[i];
      vertices_.set_in_medium(i, v.position, v.path->ray.direction, v.path->ray.time, *v.phase);
      shading_points_.lane[i] = i;
      shading_points_.sampler[i] = &v.path->sampler;
      shading_points_.bsdf_samples[i] = static_cast<float>(branches_at(*v.path, false)) * v.pdf_ratio;
      shading_points_.media[i] = &v.bodies;
    }
    direct_light_.estimate(scene_, vertices_, shading_points_, settings_, counts_, stop);
    if (stop.asked()) return;
    for (std::uint32_t i = 0; i < vertices.size(); ++i)
      results_[vertices[i].path->result].add_light_sampled(vertices[i].throughput * shading_points_.light[i],
                                                           depth + 1);
    if (layers_.empty()) continue;
    for (const LayeredLight& part : layered_light_) {
      const MediumLightVertex& v = vertices[part.lane];
      layer(*v.path, part.layer).add(v.throughput * part.light, depth + 1);
    }
  }
}

/// The paths that collided go on in a direction of the phase function.
void PathTracer::scatter_in_media(int depth, StopPoll& stop) {
  for (std::size_t begin = 0; begin < collisions_.size(); begin += kLaneCount) {
    if (stop.asked()) return;
    const auto vertices =
        std::span(collisions_).subspan(begin, std::min(kLaneCount, collisions_.size() - begin));
    vertices_.count = vertices.size();
    vertices_.blends.clear();
    scattering_.clear();
    scattering_flags_ = BsdfFlags::none;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      const MediumVertex& v = vertices[i];
      vertices_.set_in_medium(i, v.position, v.path->ray.direction, v.path->ray.time, *v.phase);
      const int branches = branches_at(*v.path, false);
      v.path->split = true;
      scattering_flags_ |= bsdf_flags(vertices_.varying[i]);
      scattering_.push_back({v.path, i, branches, v.pdf_ratio});
    }
    for (std::uint32_t branch = 0; sample_bsdfs(branch, depth); ++branch) continue_paths();
  }
}

} // namespace candela
