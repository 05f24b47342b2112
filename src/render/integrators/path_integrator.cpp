#include "render/integrators/path_integrator.h"

#include "render/integrators/smooth_terminator.h"

namespace candela {

PathTracer::PathTracer(const RenderScene& scene, const PathSettings& settings)
    : scene_(scene), settings_(settings), last_depth_(longest_path(settings)),
      smooths_terminator_(settings.smooth_terminator && scene.geometry().has_smooth_triangles()),
      way_(settings.medium_sampling == MediumSampling::equiangular) {
  branched_.reserve(kLaneCount); // draws point into it
}

/// With segments numbered by depth = 1, 2, ... the estimate is the sum over vertices of
///   throughput x (emission that BSDF sampling found, weighted + light from sampled lights, weighted).
bool PathTracer::trace(std::span<const PathStart> starts, std::span<PathSample> results, RayCounts& counts,
                       StopPoll& stop, std::span<PathSample> layers) {
  results_ = results;
  layers_ = layers;
  std::ranges::fill(layers_, PathSample{});
  shading_points_.layered = layers_.empty() ? nullptr : &layered_light_;
  counts_ = {};
  paths_.clear();
  media_.clear();
  cones_.clear();
  entries_.clear();
  for (std::uint32_t i = 0; i < starts.size(); ++i) {
    results_[i] = {};
    Path& path = paths_.emplace_back(starts[i]);
    path.result = i;
    path.split = starts[i].sampler.sample() == 0;
    if (scene_.has_media()) media_.push_back(starts[i].media);
    if (scene_.filters_textures()) cones_.push_back({starts[i].cone, starts[i].ray.origin});
  }
  for (int depth = 1; depth <= last_depth_ && !paths_.empty(); ++depth) {
    intersect(depth, stop);
    if (stop.asked()) return false;
    sample_media(depth, stop);
    if (shows_depth(settings_, depth)) {
      add_environment(depth);
      add_emission(depth);
    }
    next_paths_.clear();
    next_media_.clear();
    next_cones_.clear();
    sample_lights_in_media(depth, stop);
    scatter_in_media(depth, stop);
    if (depth < last_depth_)
      for (std::size_t begin = 0; begin < arrived_.size(); begin += kLaneCount)
        scatter(begin, std::min(kLaneCount, arrived_.size() - begin), depth, stop);
    if (!entries_.empty()) leave_subsurface(depth, stop);
    if (stop.asked()) return false;
    std::swap(paths_, next_paths_);
    std::swap(media_, next_media_);
    std::swap(cones_, next_cones_);
  }
  counts += counts_;
  return true;
}

/// Rays between two polls of whether to stop: single ones may take milliseconds.
constexpr std::size_t kRaysPerPoll = 16;

/// The closest hits. Where nothing lies between surfaces that could let light through or take some of it
/// away, the paths are divided at once; else hits_[i] becomes that of paths_[i], its t infinite where there
/// is none.
void PathTracer::intersect(int depth, StopPoll& stop) {
  const Accel& accel = scene_.geometry().accel();
  const bool passes = passes_media();
  hits_.resize(paths_.size());
  arrived_.clear();
  escaped_.clear();
  counts_.closest += paths_.size();
  const bool coherent = depth == 1; // camera rays: faster together
  const bool active = scene_.has_active_media();
  if (coherent) {
    rays_.clear();
    for (const Path& path : paths_) rays_.push_back(&path.ray);
    accel.intersect(rays_, hits_);
  }
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (i % kRaysPerPoll == 0 && stop.asked()) return;
    Path& path = paths_[i];
    path.sampler.set_bounce(static_cast<std::uint32_t>(depth));
    if (active && !coherent) path.ray.t_max = collision_distance(path, depth);
    Hit& hit = hits_[passes ? i : arrived_.size()]; // at i or before
    if (coherent) hit = hits_[i];
    const bool met = coherent ? hit.t < kInfinity : accel.intersect(path.ray, hit);
    if (!passes)
      divide(path, met);
    else if (!met)
      hit.t = kInfinity;
  }
}

/// Through transparent surfaces and media: divides the paths where intersect() has not.
void PathTracer::sample_media(int depth, StopPoll& stop) {
  light_vertices_.clear();
  collisions_.clear();
  if (!passes_media()) return;
  const bool active = scene_.has_active_media();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (i % kRaysPerPoll == 0 && stop.asked()) return;
    Hit& hit = hits_[arrived_.size()]; // at i or before
    hit = hits_[i];
    if (!active) {
      divide(paths_[i], pass_media(i, hit.t < kInfinity, hit));
      continue;
    }
    const RayEnd end = pass_active_media(i, hit.t < kInfinity, hit, depth);
    if (end != RayEnd::collision) divide(paths_[i], end == RayEnd::surface);
  }
}

/// Whether the ray of paths_[index] ends at a surface, given its closest hit, and what is left of its light
/// there.
bool PathTracer::pass_media(std::size_t index, bool met, Hit& hit) {
  Path& path = paths_[index];
  if (!scene_.has_media())
    return intersect_through_opacity(scene_, path.ray, path.sampler, met, hit, counts_, nullptr,
                                     cone_of_view(path));
  MediaPassage passage{media_[index], Spectrum(1)};
  met = intersect_through_opacity(scene_, path.ray, path.sampler, met, hit, counts_, &passage,
                                  cone_of_view(path));
  media_[index] = passage.media;
  path.throughput *= passage.transmittance;
  return met;
}

/// The infinite lights, for the paths that escaped.
void PathTracer::add_environment(int depth) {
  for (std::uint32_t i : scene_.infinite_lights())
    visit_variant(
        [&](const auto& light) {
          using Model = std::remove_cvref_t<decltype(light)>;
          if constexpr (requires(const Model& l, vec3 direction) { l.locate(direction); }) {
            // All texels are sent for before the first is waited for.
            places_.clear();
            for (const Path* path : escaped_) places_.push_back(light.locate(path->ray.direction));
            for (std::size_t k = 0; k < escaped_.size(); ++k) {
              const RadiancePdf found = light.radiance_pdf(escaped_[k]->light_context, places_[k]);
              add_escaped(*escaped_[k], i, found.radiance, found.pdf, depth);
            }
          } else if constexpr (Model::kind == LightKind::infinite) {
            for (const Path* path : escaped_)
              add_escaped(*path, i, light.radiance_from(path->ray.direction),
                          light.pdf(path->light_context, {}, path->ray.direction), depth);
          }
        },
        scene_.lights()[i]);
}

/// Of surfaces that paths hit. Before lights are sampled, for both are added up, and their order must not
/// depend on which paths share lanes.
void PathTracer::add_emission(int depth) {
  for (std::size_t i = 0; i < arrived_.size(); ++i) {
    const SurfaceMaterial& material = scene_.material(scene_.geometry().material_of(hits_[i]));
    if (!material.emissive) continue;
    Path& path = *arrived_[i];
    const SurfaceInteraction surface = scene_.geometry().surface(path.ray, hits_[i]);
    const bool outside = glm::dot(-path.ray.direction, surface.geometric_normal) > 0;
    if (!outside && !material.two_sided_emission) continue;
    const Spectrum emission = emission_at(material, [&] {
      return texture_point(scene_, path.ray, hits_[i], cone_of_view(path), material.asks_place);
    });
    add_emitted(path, surface, emission, depth);
  }
}

/// Weight of light that BSDF sampling found, given the density (1/sr) of light sampling for it.
float PathTracer::bsdf_sampling_weight(const Path& path, float light_pdf) const {
  if (path.specular_bounce || settings_.light_sampling == LightSampling::bsdf) return 1;
  if (settings_.light_sampling == LightSampling::nee) return 0;
  return mis_weight(settings_.mis_heuristic, path.bsdf_pdf,
                    light_pdf * static_cast<float>(settings_.light_samples));
}

bool PathTracer::needs_light_pdf(const Path& path) const {
  return !path.specular_bounce && settings_.light_sampling == LightSampling::mis;
}

void PathTracer::add_escaped(const Path& path, std::uint32_t light, Spectrum radiance, float pdf, int depth) {
  const float light_pdf = needs_light_pdf(path)
                              ? light_sampling_pdf(scene_, path.light_context, light, pdf, path.ray.direction)
                              : 0;
  const Spectrum light_found = path.throughput * radiance * bsdf_sampling_weight(path, light_pdf);
  results_[path.result].add(light_found, depth);
  if (!layers_.empty()) layer(path, scene_.layer_of_light(light)).add(light_found, depth);
}

void PathTracer::add_emitted(const Path& path, const SurfaceInteraction& surface, Spectrum emission,
                             int depth) {
  Spectrum light_found = path.throughput * emission;
  const std::uint32_t i = scene_.light_of(surface.emitter);
  if (i != kNoLight) { // else no light sample finds it, as curves
    float pdf = 0;
    if (needs_light_pdf(path)) {
      pdf = light_sampling_pdf(
          scene_, path.light_context, i,
          light_pdf(scene_.lights()[i], path.light_context, surface.position, path.ray.direction),
          path.ray.direction);
    }
    light_found *= bsdf_sampling_weight(path, pdf);
  }
  results_[path.result].add(light_found, depth);
  if (!layers_.empty()) layer(path, scene_.layer_of_material(surface.material)).add(light_found, depth);
}

/// The surface vertices of the paths that arrived at hits_[begin ...].
void PathTracer::scatter(std::size_t begin, std::size_t count, int depth, StopPoll& stop) {
  if (stop.asked()) return;
  make_vertices(begin, count, depth);
  if (shows_depth(settings_, depth + 1)) sample_lights(begin, depth, stop);
  for (std::uint32_t branch = 0; sample_bsdfs(branch, depth); ++branch) continue_paths();
}

/// Finds those that scatter, and those of them that light sampling makes sense for.
void PathTracer::make_vertices(std::size_t begin, std::size_t count, int depth) {
  Lanes<const Ray*> rays;
  for (std::size_t i = 0; i < count; ++i) rays[i] = &arrived_[begin + i]->ray;
  Lanes<const MediumStack*> media;
  const std::size_t media_count = scene_.has_priorities() ? count : 0;
  for (std::size_t i = 0; i < media_count; ++i) media[i] = &media_of(*arrived_[begin + i]);
  Lanes<const ConeOfRay*> cones;
  if (scene_.filters_textures())
    for (std::size_t i = 0; i < count; ++i) cones[i] = cone_of(*arrived_[begin + i]);
  vertices_.set(scene_, {rays.data(), count}, std::span(hits_).subspan(begin, count),
                {media.data(), media_count}, {cones.data(), scene_.filters_textures() ? count : 0});
  if (scene_.has_subsurface()) offer_entries(begin);
  if (smooths_terminator_)
    smooth_terminator(vertices_, scene_.geometry(), {rays.data(), count},
                      std::span(hits_).subspan(begin, count));
  scattering_.clear();
  scattering_flags_ = BsdfFlags::none;
  shading_points_.count = 0;
  shading_points_.coherent = depth == 1;
  shading_points_.draw = 0;
  const bool depends_on_context = scene_.all_lights().depends_on_context();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!vertices_.scatters(i)) continue;
    Path& path = *arrived_[begin + i];
    const Bsdf& bsdf = vertices_.bsdf(i);
    const BsdfFlags flags = bsdf_flags(bsdf);
    const bool specular =
        has_any(flags, BsdfFlags::delta) && bsdf_delta_probability(bsdf, vertices_.wo_local[i]) >= 1;
    const int branches = branches_at(path, specular);
    path.split |= !specular;
    scattering_flags_ |= flags;
    scattering_.push_back({&path, i, branches, 1});
    if (specular) continue; // no light sample meets a delta lobe
    LightSamplingContext& context = vertices_.light_context[i];
    if (transmits_with_density(flags)) context.domain = ScatteringDomain::sphere;
    context.mis_with_bsdf = settings_.light_sampling == LightSampling::mis;
    context.lobe = {};
    if (depends_on_context && !is_diffuse(flags)) set_lobe(i, bsdf);
    shading_points_.lane[shading_points_.count++] = i;
    shading_points_.sampler[i] = &path.sampler;
    shading_points_.bsdf_samples[i] = static_cast<float>(branches);
    if (scene_.has_media()) shading_points_.media[i] = &media_of(path);
  }
}

/// Of a BSDF that is more than diffuse, for the choice of lights.
void PathTracer::set_lobe(std::size_t i, const Bsdf& bsdf) {
  LightSamplingContext& context = vertices_.light_context[i];
  const vec3 wo = vertices_.wo_local[i];
  context.lobe = bsdf_lobe_proxy(bsdf, wo);
  context.lobe_axis = Basis::from_normal(vertices_.normal[i]).to_world(reflect_about_normal(wo));
}

/// Next-event estimation.
void PathTracer::sample_lights(std::size_t begin, int depth, StopPoll& stop) {
  direct_light_.estimate(scene_, vertices_, shading_points_, settings_, counts_, stop);
  for (std::uint32_t i : std::span(shading_points_.lane.data(), shading_points_.count)) {
    const Path& path = *arrived_[begin + i];
    results_[path.result].add_light_sampled(path.throughput * shading_points_.light[i], depth + 1);
  }
  if (layers_.empty()) return;
  for (const LayeredLight& part : layered_light_) {
    const Path& path = *arrived_[begin + part.lane];
    layer(path, part.layer).add(path.throughput * part.light, depth + 1);
  }
}

/// A direction for each scattering vertex, and what becomes of it: directions_, continuation_. Vertices that
/// split have one more for each branch; false where none has so many.
bool PathTracer::sample_bsdfs(std::uint32_t branch, int depth) {
  Lanes<const ScatteringVertex*> from;
  Lanes<Sampler::Draw> draws;
  std::size_t count = 0;
  branched_.clear();
  for (const ScatteringVertex& vertex : scattering_) {
    const auto branches = static_cast<std::uint32_t>(vertex.branches);
    if (branch >= branches) continue;
    const Sampler& own = vertex.path->sampler;
    const Sampler* sampler = branches > 1 ? &branched_.emplace_back(own.branch(branch, branches)) : &own;
    from[count] = &vertex;
    draws[count++] = {sampler, 0};
  }
  if (count == 0) return false;
  Lanes<vec2> disc;
  Lanes<float> lobe_u{}, roulette_u;
  const std::span<const Sampler::Draw> all(draws.data(), count);
  Sampler::get_2d(all, Dimension::bsdf_direction, disc);
  if (chooses_lobe(scattering_flags_)) Sampler::get_1d(all, Dimension::bsdf_lobe, lobe_u);
  Sampler::get_1d(all, Dimension::russian_roulette, roulette_u);
  sample_uniform_discs({disc.data(), count});

  Lanes<const Bsdf*> bsdfs;
  for (std::size_t k = 0; k < count; ++k) bsdfs[k] = &vertices_.bsdf(from[k]->lane);
  sample_directions(
      {bsdfs.data(), count}, settings_.direction_sampling,
      [&](std::size_t k) { return vertices_.wo_local[from[k]->lane]; },
      [&](std::size_t k) { return BsdfU(disc[k], lobe_u[k]); },
      [&](std::size_t k, const std::optional<BsdfSample>& s) {
        const ScatteringVertex& vertex = *from[k];
        const std::uint32_t i = vertex.lane;
        const auto branches = static_cast<float>(vertex.branches);
        directions_[k] = {&vertex, draws[k].sampler, i, 0, false};
        continuation_.u[i] = roulette_u[k];
        if (!s) {
          continuation_.throughput.set(i, Spectrum(0)); // ends by Russian roulette
          return;
        }
        directions_[k].bsdf_pdf = s->pdf * branches * vertex.pdf_scale;
        directions_[k].delta = s->delta;
        continuation_.wi_local.set(i, s->wi);
        Spectrum throughput = vertex.path->throughput;
        if (vertex.branches != 1) throughput /= branches;
        continuation_.throughput.set(i, throughput * s->weight);
        continuation_.eta_scale[i] = vertex.path->eta_scale * branches * sqr(s->eta);
      });
  direction_count_ = count;
  continuation_.folds.fill(0);
  if (!is_diffuse(scattering_flags_)) fold_directions();
  continuation_.compute(vertices_, Roulette::at(settings_, depth));
  return true;
}

/// Finds the directions that are to be folded to the right side of their surface, see folds_directions().
void PathTracer::fold_directions() {
  for (SampledDirection& direction : std::span(directions_.data(), direction_count_)) {
    const std::uint32_t i = direction.lane;
    if (!vertices_.folds(i)) continue;
    continuation_.folds[i] = 1;
    if (!direction.delta)
      direction.bsdf_pdf += static_cast<float>(direction.vertex->branches) *
                            vertices_.folded_pdf(i, continuation_.wi_local[i], settings_.direction_sampling);
  }
}

/// Makes the paths of the next segment, of the directions that survived.
void PathTracer::continue_paths() {
  // Who survives cannot be predicted.
  Lanes<std::uint32_t> survivors;
  std::size_t count = 0;
  for (std::uint32_t n = 0; n < direction_count_; ++n) {
    survivors[count] = n;
    count += static_cast<std::size_t>(continuation_.survives[directions_[n].lane]);
  }
  const bool has_media = scene_.has_media(), filters_textures = scene_.filters_textures(),
             has_subsurface = scene_.has_subsurface();
  for (std::uint32_t n : std::span(survivors.data(), count)) {
    const SampledDirection& direction = directions_[n];
    if (has_subsurface && enters_subsurface(direction)) {
      enter_subsurface(direction);
      continue;
    }
    const Path& from = *direction.vertex->path;
    const std::uint32_t i = direction.lane;
    Path& path = next_paths_.emplace_back(*direction.sampler);
    path.ray.origin = continuation_.origin[i];
    path.ray.direction = continuation_.direction[i];
    path.ray.time = from.ray.time;
    path.throughput = continuation_.throughput[i];
    path.eta_scale = continuation_.eta_scale[i];
    path.result = from.result;
    path.split = from.split;
    path.specular_bounce = direction.delta;
    path.bsdf_pdf = direction.bsdf_pdf;
    path.light_context = vertices_.light_context[i];
    if (filters_textures) continue_cone(direction);
    if (!has_media) continue;
    MediumStack& media = next_media_.emplace_back(media_of(from));
    if (!same_hemisphere(vertices_.wo_local[i], continuation_.wi_local[i])) // it goes through the surface
      media.cross(vertices_.material[i]->media, vertices_.side[i] > 0);
  }
}

/// A mirror keeps the spread, as if it were flat; what is rough widens it by its lobe.
void PathTracer::continue_cone(const SampledDirection& direction) {
  const std::uint32_t i = direction.lane;
  const float pdf = bsdf_pdf(vertices_.bsdf(i), vertices_.wo_local[i], continuation_.wi_local[i]);
  next_cones_.push_back(
      cone_of(*direction.vertex->path)->after(vertices_.position[i], direction.delta ? 0 : lobe_spread(pdf)));
}

} // namespace candela
