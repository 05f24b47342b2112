// Paths that enter a surface and leave it elsewhere, by a diffusion profile (a BSSRDF):
//     S(wo, po, wi, pi) = T(wo) R(|po - pi|) T(wi) / (pi times the mean of T)
// of Christensen & Burley 2015, section 3, with T = 1 - the interface's reflectance. In the limit of a mean
// free path of 0 that is Plastic. Both points belong to one vertex of the path: the way between them counts
// as no segment.

#include "render/integrators/path_integrator.h"

namespace candela {

namespace {

/// The random numbers of exit points are those of bounces that no path has otherwise.
constexpr std::uint32_t kExitBounces = 1u << 30;

/// The surface where light leaves: its BSDF is that of the lane.
const SurfaceMaterial& exit_material() {
  static const SurfaceMaterial exit = [] {
    SurfaceMaterial m;
    m.varies = true;
    return m;
  }();
  return exit;
}

} // namespace

/// The vertices whose surfaces have a profile, of hits_[begin ...], get the BSDF that lets paths enter.
void PathTracer::offer_entries(std::size_t begin) {
  first_hit_ = begin;
  for (std::size_t i = 0; i < vertices_.count; ++i) {
    const SurfaceMaterial& material = *vertices_.material[i];
    if (!material.diffuses) continue;
    if (material.textured == nullptr && !material.oriented) vertices_.varying[i] = material.bsdf;
    if (auto* bsdf = std::get_if<Subsurface>(&vertices_.varying[i])) bsdf->part = Subsurface::Part::entry;
  }
}

bool PathTracer::enters_subsurface(const SampledDirection& direction) const {
  const std::uint32_t i = direction.lane;
  return direction.delta && vertices_.material[i]->diffuses &&
         !same_hemisphere(vertices_.wo_local[i], continuation_.wi_local[i]);
}

void PathTracer::enter_subsurface(const SampledDirection& direction) {
  const Path& from = *direction.vertex->path;
  const std::uint32_t i = direction.lane;
  SubsurfaceEntry& entry = entries_.emplace_back(SubsurfaceEntry{
      Path(*direction.sampler),
      {vertices_.position[i], vertices_.normal[i], vertices_.side[i], from.ray.time, hits_[first_hit_ + i]},
      std::get<Subsurface>(vertices_.bsdf(i))});
  entry.path.ray = from.ray;
  entry.path.throughput = continuation_.throughput[i];
  entry.path.eta_scale = continuation_.eta_scale[i];
  entry.path.result = from.result;
  entry.path.split = from.split;
  if (scene_.has_media()) entry_media_.push_back(media_of(from));
  if (scene_.filters_textures()) entry_cones_.push_back(*cone_of(from));
}

/// Scatters the paths of entries_ where they leave. They become paths_, for those of this segment have gone
/// on.
void PathTracer::leave_subsurface(int depth, StopPoll& stop) {
  find_exits(depth, stop);
  for (std::size_t begin = 0; begin < exits_.size(); begin += kLaneCount) {
    if (stop.asked()) return;
    make_exit_vertices(begin, std::min(kLaneCount, exits_.size() - begin));
    if (shows_depth(settings_, depth + 1)) sample_lights_at_exits(begin, depth, stop);
    for (std::uint32_t branch = 0; sample_bsdfs(branch, depth); ++branch) continue_paths();
  }
}

void PathTracer::find_exits(int depth, StopPoll& stop) {
  exits_.clear();
  paths_.clear();
  media_.clear();
  cones_.clear();
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    if (stop.asked()) break;
    const SubsurfaceEntry& entry = entries_[k];
    Path path = entry.path;
    path.sampler.set_bounce(kExitBounces + static_cast<std::uint32_t>(depth));
    const auto exit = probe_.sample(scene_, entry.point, entry.bsdf, path.throughput,
                                    path.sampler.get_2d(Dimension::subsurface_probe),
                                    path.sampler.get_2d(Dimension::subsurface_point), counts_);
    if (!exit) continue;
    path.throughput *= exit->weight;
    exits_.push_back(*exit);
    paths_.push_back(path);
    if (scene_.has_media()) media_.push_back(entry_media_[k]);
    if (scene_.filters_textures()) cones_.push_back(entry_cones_[k]);
  }
  entries_.clear();
  entry_media_.clear();
  entry_cones_.clear();
}

void PathTracer::make_exit_vertices(std::size_t begin, std::size_t count) {
  vertices_.count = shading_points_.count = count;
  vertices_.blends.clear();
  shading_points_.coherent = false;
  shading_points_.draw = 0;
  scattering_.clear();
  scattering_flags_ = BsdfFlags::reflection | BsdfFlags::diffuse;
  for (std::uint32_t i = 0; i < count; ++i) {
    const SubsurfaceExit& exit = exits_[begin + i];
    Path& path = paths_[begin + i];
    const vec3 outside = exit.surface.geometric_normal;
    vertices_.position.set(i, exit.surface.position);
    vertices_.position_error.set(i, exit.surface.position_error);
    vertices_.geometric_normal.set(i, outside);
    vertices_.normal.set(i, exit.normal);
    vertices_.wo_local.set(i, {0, 0, exit.side});
    vertices_.side[i] = exit.side;
    vertices_.time[i] = path.ray.time;
    vertices_.light_context[i] = {exit.surface.position, exit.side * outside};
    vertices_.light_context[i].mis_with_bsdf = settings_.light_sampling == LightSampling::mis;
    vertices_.material[i] = &exit_material();
    vertices_.varying[i] = exit.bsdf;
    const int branches = branches_at(path, false);
    path.split = true;
    scattering_.push_back({&path, i, branches, 1});
    shading_points_.lane[i] = i;
    shading_points_.sampler[i] = &path.sampler;
    shading_points_.bsdf_samples[i] = static_cast<float>(branches);
    if (scene_.has_media()) shading_points_.media[i] = &media_of(path);
  }
}

/// Next-event estimation.
void PathTracer::sample_lights_at_exits(std::size_t begin, int depth, StopPoll& stop) {
  direct_light_.estimate(scene_, vertices_, shading_points_, settings_, counts_, stop);
  for (std::uint32_t i : std::span(shading_points_.lane.data(), shading_points_.count)) {
    const Path& path = paths_[begin + i];
    results_[path.result].add_light_sampled(path.throughput * shading_points_.light[i], depth + 1);
  }
  if (layers_.empty()) return;
  for (const LayeredLight& part : layered_light_) {
    const Path& path = paths_[begin + part.lane];
    layer(path, part.layer).add(path.throughput * part.light, depth + 1);
  }
}

} // namespace candela
