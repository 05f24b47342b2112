#include "render/path_integrator.h"

#include "render/direct_light.h"

namespace candela {

namespace {

/// Branches of a split path have bounces of their own; longer unsplit paths than this would only share
/// numbers with them.
constexpr std::uint32_t kBranchShift = 20;

/// A walk on its way: what the next vertex needs to know of those before.
struct Path {
  Ray ray;
  vec3 throughput{1}; ///< product of f |cos| / pdf and of 1 / survival so far
  /// What Russian roulette multiplies the throughput by: it leaves out the 1/eta^2 of refractions, which the
  /// way out of the glass gives back, and the share of a split.
  float roulette_scale = 1;
  std::uint32_t branch = 0;
  bool split = false;
  // The last vertex: how the path left it.
  bool arrived_by_delta = true; ///< the camera cannot be aimed from
  float arrival_density = 0;    ///< 1/sr, times the number of directions tried there
  vec3 previous{0};
  LightReference reference;
};

/// The settings and sums of one sample, so that the walk's steps can be read one by one.
class PathTracer {
public:
  PathTracer(const RenderScene& scene, Sampler& sampler, const PathSettings& settings, RayCounts& counts)
      : scene_(scene), sampler_(sampler), settings_(settings), counts_(counts),
        last_depth_(longest_path(settings)) {}

  PathSample trace(const Ray& ray) {
    Path path;
    path.ray = ray;
    walk(path, 1);
    return sample_;
  }

private:
  /// With segments numbered by depth = 1, 2, ... the estimate is the sum over vertices of
  ///   throughput x (emission met by chance, weighted + light aimed at, weighted).
  void walk(Path& path, int depth) {
    for (; depth <= last_depth_; ++depth) {
      stand_at(path, depth);
      Hit hit;
      if (!intersect_scene(scene_, path.ray, sampler_, hit, counts_)) {
        add_background(path, depth);
        return;
      }
      Surface surface = scene_.geometry().surface(path.ray, hit);
      const SurfaceMaterial& material = scene_.material(surface.material);
      vec3 wo = -path.ray.direction;
      bool outside = glm::dot(wo, surface.geometric_normal) > 0;
      if (material.absorbing && !outside) // it came through the inside of this body (Beer-Lambert)
        path.throughput *= glm::exp(-material.absorption * glm::length(surface.position - path.previous));
      if (material.emissive && (outside || material.two_sided_emission))
        add_emission(path, surface, material, depth);
      if (depth == last_depth_ || !scatter(path, surface, material, wo, depth)) return;
    }
  }

  void stand_at(const Path& path, int depth) {
    sampler_.set_bounce(static_cast<std::uint32_t>(depth) + (path.branch << kBranchShift));
  }

  /// Weight of a light met by chance, given the density (1/sr) with which aiming would have found it.
  float weight_by_chance(const Path& path, float aimed_pdf) const {
    if (path.arrived_by_delta || settings_.light_sampling == LightSampling::bsdf) return 1;
    if (settings_.light_sampling == LightSampling::nee) return 0;
    return mis_weight(settings_.mis_heuristic, path.arrival_density,
                      aimed_pdf * static_cast<float>(settings_.light_samples));
  }

  bool needs_aimed_pdf(const Path& path) const {
    return !path.arrived_by_delta && settings_.light_sampling == LightSampling::mis;
  }

  void add_background(const Path& path, int depth) {
    if (!shows_depth(settings_, depth)) return;
    for (std::uint32_t i : scene_.infinite_lights()) {
      const Light& light = scene_.lights()[i];
      float aimed = needs_aimed_pdf(path) ? scene_.all_lights().pmf(i) *
                                                light_pdf(light, path.reference, {}, path.ray.direction)
                                          : 0;
      sample_.add(path.throughput * light_radiance(light, path.ray.direction) * weight_by_chance(path, aimed),
                  depth);
    }
  }

  void add_emission(const Path& path, const Surface& surface, const SurfaceMaterial& material, int depth) {
    if (!shows_depth(settings_, depth)) return;
    float aimed = 0;
    if (needs_aimed_pdf(path)) {
      std::uint32_t i = scene_.light_of(surface.emitter);
      if (i != kNoLight)
        aimed = scene_.all_lights().pmf(i) *
                light_pdf(scene_.lights()[i], path.reference, surface.position, path.ray.direction);
    }
    sample_.add(path.throughput * material.emission * weight_by_chance(path, aimed), depth);
  }

  /// Direct light at the vertex and the next direction; false where the path ends.
  bool scatter(Path& path, const Surface& surface, const SurfaceMaterial& material, vec3 wo, int depth) {
    Vertex vertex = make_vertex(surface, material, wo);
    if (!vertex.scatters()) return false;
    Bsdf textured;
    const Bsdf* bsdf = &material.bsdf;
    if (material.diffuse_texture != nullptr) {
      textured = evaluate_bsdf(material, surface);
      bsdf = &textured;
    }
    bool specular = bsdf_delta_probability(*bsdf, vertex.wo_local) >= 1;
    int branches = path.split || specular ? 1 : settings_.split;
    path.split |= !specular;
    // A path that can still matter beyond this vertex? Only then is aiming worth a ray.
    if (shows_depth(settings_, depth + 1) && !specular)
      sample_.add_aimed(path.throughput *
                            aim_at_lights(scene_, vertex, *bsdf, sampler_, settings_, branches, counts_),
                        depth + 1);
    if (depth + 1 > last_depth_) return false;
    if (branches == 1) return go_on(path, vertex, *bsdf, depth, 0, 1);
    for (int k = 0; k < branches; ++k) {
      Path child = path;
      stand_at(path, depth);
      child.branch = static_cast<std::uint32_t>(k);
      child.throughput /= static_cast<float>(branches);
      child.roulette_scale *= static_cast<float>(branches);
      if (go_on(child, vertex, *bsdf, depth, static_cast<std::uint32_t>(k), branches)) walk(child, depth + 1);
    }
    return false;
  }

  /// Takes the `index`-th of `tries` directions from the vertex.
  bool go_on(Path& path, const Vertex& vertex, const Bsdf& bsdf, int depth, std::uint32_t index, int tries) {
    vec2 u = sampler_.get_2d(Dimension::bsdf_direction, index);
    auto s = sample_direction(bsdf, vertex.wo_local, vec3(u, sampler_.get_1d(Dimension::bsdf_lobe, index)),
                              settings_.direction_sampling);
    if (!s) return false;
    vec3 wi = vertex.frame.to_world(s->wi);
    if (!vertex.keeps_side(wi, s->wi.z * vertex.wo_local.z > 0)) return false;
    path.throughput *= s->weight;
    path.roulette_scale *= sqr(s->eta);
    if (!survives(path, depth, index)) return false;

    path.arrived_by_delta = s->delta;
    path.arrival_density = s->pdf * static_cast<float>(tries);
    path.previous = vertex.surface.position;
    path.reference = vertex.reference;
    path.ray = spawn_ray(vertex.surface, wi);
    return true;
  }

  /// Russian roulette (Arvo and Kirk 1990): going on with probability q and weight 1/q keeps the mean.
  bool survives(Path& path, int depth, std::uint32_t index) {
    // Nothing, or less than a normal float: rounding would keep denormals alive for ever where reflectance is
    // above 1/2.
    float largest = max_component(path.throughput);
    if (largest < std::numeric_limits<float>::min()) return false;
    if (settings_.rr == RussianRoulette::off || depth < settings_.rr_depth) return true;
    float q = settings_.rr_probability;
    if (settings_.rr == RussianRoulette::throughput) q = std::min(1.0f, largest * path.roulette_scale);
    if (sampler_.get_1d(Dimension::russian_roulette, index) >= q) return false;
    path.throughput /= q;
    return true;
  }

  const RenderScene& scene_;
  Sampler& sampler_;
  const PathSettings& settings_;
  RayCounts& counts_;
  int last_depth_;
  PathSample sample_;
};

} // namespace

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

PathSample path_radiance(const RenderScene& scene, const Ray& ray, Sampler& sampler,
                         const PathSettings& settings, RayCounts& counts) {
  return PathTracer(scene, sampler, settings, counts).trace(ray);
}

} // namespace candela
