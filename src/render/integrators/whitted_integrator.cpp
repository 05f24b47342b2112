#include "render/integrators/whitted_integrator.h"

#include "materials/delta_lobes.h"
#include "render/integrators/russian_roulette.h"
#include "render/integrators/smooth_terminator.h"

#include <array>

namespace candela {

namespace {

/// Both branches of glass are traced for so many surfaces; then one is chosen at random, which keeps the
/// mean and bounds the cost.
constexpr int kBranchingDepth = 5;
/// Branches have bounces of their own.
constexpr std::uint32_t kBranchShift = 20;
constexpr std::uint32_t kMostBranches = 1u << (32 - kBranchShift);

struct SpecularRay {
  Ray ray;
  Spectrum throughput{1};
  float eta_scale = 1;
  std::uint32_t branch = 1; ///< a bit per choice, the leading one marks their number
  MediumStack media{};      ///< of the ray, in scenes with media
  ConeOfRay cone{};         ///< in scenes that filter textures
};

class WhittedTracer {
public:
  WhittedTracer(const RenderScene& scene, Sampler& sampler, const PathSettings& settings,
                ScalarDirectLight& direct_light, RayCounts& counts, StopPoll& stop,
                std::span<PathSample> layers)
      : scene_(scene), sampler_(sampler), settings_(settings), counts_(counts), stop_(stop),
        last_depth_(longest_path(settings)), layers_(layers), direct_light_(direct_light) {
    std::ranges::fill(layers_, PathSample{});
    direct_light_.keep_layers(!layers_.empty());
    // BSDF sampling gives specular directions alone: light sampling has full weight.
    settings_.light_sampling = LightSampling::nee;
  }

  PathSample trace(const PathStart& start) {
    SpecularRay first;
    first.ray = start.ray;
    first.media = start.media;
    first.cone = {start.cone, start.ray.origin};
    trace_ray(first, 1);
    return sample_;
  }

private:
  // Recursion is as deep as kBranchingDepth; behind that the loop continues alone.
  void trace_ray(SpecularRay path, int depth) {
    for (; depth <= last_depth_ && !stop_.asked(); ++depth) {
      set_sampler(path, depth);
      Hit hit;
      MediaPassage passage{path.media, Spectrum(1)};
      const ConeOfRay* cone = scene_.filters_textures() ? &path.cone : nullptr;
      const bool met = intersect_scene(scene_, path.ray, sampler_, hit, counts_,
                                       scene_.has_media() ? &passage : nullptr, cone);
      path.media = passage.media;
      path.throughput *= passage.transmittance;
      if (!met) {
        add_environment(path, depth);
        return;
      }
      Vertex vertex(scene_, path.ray, hit);
      const SurfaceMaterial& material = *vertex.material;
      bool outside = vertex.side > 0;
      auto texture_at = [&] { return texture_point(scene_, path.ray, hit, cone, material.asks_place); };
      if (material.emissive && (outside || material.two_sided_emission) && shows_depth(settings_, depth)) {
        const Spectrum light = path.throughput * emission_at(material, texture_at);
        sample_.add(light, depth);
        if (!layers_.empty()) layers_[scene_.layer_of_material(vertex.surface.material)].add(light, depth);
      }
      if (depth == last_depth_ || !vertex.scatters()) return;
      BlendArena blends;
      Bsdf bsdf =
          material.textured != nullptr ? evaluate_bsdf(material, texture_at(), blends) : material.bsdf;
      if (material.oriented) orient_bsdf(bsdf, scene_.geometry(), path.ray, hit, vertex.frame.n);
      set_outside(scene_, material, path.media, outside, bsdf);
      if (settings_.smooth_terminator) smooth_terminator(vertex, bsdf, scene_.geometry(), path.ray, hit);
      if (shows_depth(settings_, depth + 1) && bsdf_delta_probability(bsdf, vertex.wo_local) < 1) {
        Spectrum light =
            direct_light_.estimate(scene_, vertex, bsdf, sampler_, settings_, counts_, stop_, &path.media);
        sample_.add_light_sampled(path.throughput * light, depth + 1);
        if (!layers_.empty())
          for (const LayeredLight& part : direct_light_.layered())
            layers_[part.layer].add(path.throughput * part.light, depth + 1);
      }
      if (!continue_specular(path, vertex, bsdf, depth)) return;
    }
  }

  /// Traces all branches but the last one, into which it turns `path`; false where there is none.
  bool continue_specular(SpecularRay& path, const Vertex& vertex, const Bsdf& bsdf, int depth) {
    DeltaLobes lobes = delta_lobes(bsdf, vertex.wo_local);
    if (lobes.count == 0) return false;
    const auto last = static_cast<std::size_t>(lobes.count) - 1;
    if (depth <= kBranchingDepth && path.branch << last < kMostBranches) {
      for (std::size_t i = 0; i < last; ++i) {
        SpecularRay other = path;
        other.branch = 2 * path.branch + 1;
        path.branch *= 2;
        if (follow_lobe(other, vertex, lobes.lobe[i], 1, depth)) {
          trace_ray(other, depth + 1);
          set_sampler(path, depth);
        }
      }
      return follow_lobe(path, vertex, lobes.lobe[last], 1, depth);
    }
    if (last == 0) return follow_lobe(path, vertex, lobes.lobe[0], 1, depth);
    std::array<float, kMostDeltaLobes> shares{};
    float sum = 0;
    for (std::size_t i = 0; i <= last; ++i)
      sum += shares[i] = max_component(lobes.lobe[i].transfer) * sqr(lobes.lobe[i].eta);
    if (!(sum > 0)) return false;
    const float u = sampler_.get_1d(Dimension::bsdf_lobe);
    std::size_t chosen = 0;
    float before = 0, upto = shares[0] / sum;
    while (chosen < last && !(u < upto)) before = upto, upto += shares[++chosen] / sum;
    return follow_lobe(path, vertex, lobes.lobe[chosen], (chosen == last ? 1 : upto) - before, depth);
  }

  bool follow_lobe(SpecularRay& path, const Vertex& vertex, const DeltaLobe& lobe, float probability,
                   int depth) {
    vec3 wi = vertex.frame.to_world(lobe.wi);
    const bool reflected = same_hemisphere(vertex.wo_local, lobe.wi);
    if (!vertex.keeps_side(wi, reflected)) { // folded back, see folds_directions()
      wi = mirrored_at_plane(wi, vertex.surface.geometric_normal);
      if (!vertex.keeps_side(wi, reflected)) return false;
    }
    path.throughput *= lobe.transfer / probability;
    path.eta_scale *= sqr(lobe.eta);
    float largest = max_component(path.throughput);
    if (largest < std::numeric_limits<float>::min()) return false;
    // Between two mirrors a path would never end: roulette by what is left of it, and a little even where
    // nothing is lost.
    if (depth > kBranchingDepth) {
      float q = std::min(survival_bound(depth), largest * path.eta_scale);
      if (sampler_.get_1d(Dimension::russian_roulette) >= q) return false;
      path.throughput /= q;
    }
    if (!reflected) path.media.cross(vertex.material->media, vertex.side > 0);
    path.ray = spawn_ray(vertex.surface, wi, path.ray.time);
    if (scene_.filters_textures()) path.cone = path.cone.after(vertex.surface.position, 0);
    return true;
  }

  void set_sampler(const SpecularRay& path, int depth) {
    sampler_.set_bounce(static_cast<std::uint32_t>(depth) + ((path.branch - 1) << kBranchShift));
  }

  void add_environment(const SpecularRay& path, int depth) {
    if (!shows_depth(settings_, depth)) return;
    for (std::uint32_t i : scene_.infinite_lights()) {
      const Spectrum light = path.throughput * light_radiance(scene_.lights()[i], path.ray.direction);
      sample_.add(light, depth);
      if (!layers_.empty()) layers_[scene_.layer_of_light(i)].add(light, depth);
    }
  }

  const RenderScene& scene_;
  Sampler& sampler_;
  PathSettings settings_;
  RayCounts& counts_;
  StopPoll& stop_;
  int last_depth_;
  PathSample sample_;
  std::span<PathSample> layers_; ///< of the sample; empty: not asked for
  ScalarDirectLight& direct_light_;
};

} // namespace

PathSample whitted_radiance(const RenderScene& scene, const PathStart& start, Sampler& sampler,
                            const PathSettings& settings, ScalarDirectLight& direct_light, RayCounts& counts,
                            StopPoll& stop, std::span<PathSample> layers) {
  return WhittedTracer(scene, sampler, settings, direct_light, counts, stop, layers).trace(start);
}

} // namespace candela
