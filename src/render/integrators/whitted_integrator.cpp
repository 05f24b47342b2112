#include "render/integrators/whitted_integrator.h"

#include "bsdf/delta_lobes.h"
#include "render/integrators/onward.h"
#include "render/integrators/path_integrator.h"

namespace candela {

namespace {

/// Both branches of glass are followed for so many surfaces; then one is chosen by chance, which keeps the
/// mean and the cost.
constexpr int kBranchingDepth = 5;
/// Branches have bounces of their own.
constexpr std::uint32_t kBranchShift = 20;

struct SpecularRay {
  Ray ray;
  vec3 throughput{1};
  float eta2 = 1;
  std::uint32_t branch = 1; ///< a bit per choice, the leading one marks their number
  Interiors interiors{};    ///< of the ray, in scenes with absorption
};

class WhittedTracer {
public:
  WhittedTracer(const RenderScene& scene, Sampler& sampler, const PathSettings& settings,
                DirectLightOfOne& direct_light, RayCounts& counts, StopPoll& stop)
      : scene_(scene), sampler_(sampler), settings_(settings), counts_(counts), stop_(stop),
        last_depth_(longest_path(settings)), direct_light_(direct_light) {
    // No direction is tried by chance but the specular ones: aiming is alone, with full weight.
    settings_.light_sampling = LightSampling::nee;
  }

  PathSample trace(const PathStart& start) {
    SpecularRay first;
    first.ray = start.ray;
    first.interiors = start.interiors;
    follow(first, 1);
    return sample_;
  }

private:
  // Recursion is as deep as kBranchingDepth; behind that the loop goes on alone.
  void follow(SpecularRay path, int depth) {
    for (; depth <= last_depth_ && !stop_.asked(); ++depth) {
      stand_at(path, depth);
      Hit hit;
      Passage passage{path.interiors, vec3(1)};
      const bool met = intersect_scene(scene_, path.ray, sampler_, hit, counts_,
                                       scene_.has_absorption() ? &passage : nullptr);
      path.interiors = passage.interiors;
      path.throughput *= passage.transmittance;
      if (!met) {
        add_background(path, depth);
        return;
      }
      const Vertex vertex(scene_, path.ray, hit);
      const SurfaceMaterial& material = *vertex.material;
      bool outside = vertex.side > 0;
      if (material.emissive && (outside || material.two_sided_emission) && shows_depth(settings_, depth))
        sample_.add(path.throughput *
                        emission_at(material, [&] { return scene_.geometry().uv(path.ray, hit); }),
                    depth);
      if (depth == last_depth_ || !vertex.scatters()) return;
      Bsdf bsdf = material.textured != nullptr ? evaluate_bsdf(material, scene_.geometry().uv(path.ray, hit))
                                               : material.bsdf;
      if (shows_depth(settings_, depth + 1) && bsdf_delta_probability(bsdf, vertex.wo_local) < 1) {
        vec3 light =
            direct_light_.aim(scene_, vertex, bsdf, sampler_, settings_, counts_, stop_, &path.interiors);
        sample_.add_aimed(path.throughput * light, depth + 1);
      }
      if (!leave(path, vertex, bsdf, depth)) return;
    }
  }

  /// Sends the other branch on its own way and turns `path` into the last one; false where there is none.
  bool leave(SpecularRay& path, const Vertex& vertex, const Bsdf& bsdf, int depth) {
    DeltaLobes lobes = delta_lobes(bsdf, vertex.wo_local);
    if (lobes.count == 2 && depth <= kBranchingDepth) {
      SpecularRay other = path;
      other.branch = 2 * path.branch + 1;
      path.branch *= 2;
      if (take(other, vertex, lobes.lobe[0], 1, depth)) {
        follow(other, depth + 1);
        stand_at(path, depth);
      }
      return take(path, vertex, lobes.lobe[1], 1, depth);
    }
    if (lobes.count == 0) return false;
    if (lobes.count == 1) return take(path, vertex, lobes.lobe[0], 1, depth);
    float first = max_component(lobes.lobe[0].transfer);
    float second = max_component(lobes.lobe[1].transfer) * sqr(lobes.lobe[1].eta);
    if (!(first + second > 0)) return false;
    float p = first / (first + second);
    if (sampler_.get_1d(Dimension::bsdf_lobe) < p) return take(path, vertex, lobes.lobe[0], p, depth);
    return take(path, vertex, lobes.lobe[1], 1 - p, depth);
  }

  bool take(SpecularRay& path, const Vertex& vertex, const DeltaLobe& lobe, float probability, int depth) {
    vec3 wi = vertex.frame.to_world(lobe.wi);
    const bool reflected = same_hemisphere(vertex.wo_local, lobe.wi);
    if (!vertex.keeps_side(wi, reflected)) { // folded back, see folds_directions()
      wi = mirrored_at_plane(wi, vertex.surface.geometric_normal);
      if (!vertex.keeps_side(wi, reflected)) return false;
    }
    path.throughput *= lobe.transfer / probability;
    path.eta2 *= sqr(lobe.eta);
    float largest = max_component(path.throughput);
    if (largest < std::numeric_limits<float>::min()) return false;
    // Between two mirrors a path would never end: roulette by what is left of it, and a little even where
    // nothing is lost.
    if (depth > kBranchingDepth) {
      float q = std::min(survival_bound(depth), largest * path.eta2);
      if (sampler_.get_1d(Dimension::russian_roulette) >= q) return false;
      path.throughput /= q;
    }
    if (!reflected) path.interiors.cross(vertex.material->interior, vertex.side > 0);
    path.ray = spawn_ray(vertex.surface, wi);
    return true;
  }

  void stand_at(const SpecularRay& path, int depth) {
    sampler_.set_bounce(static_cast<std::uint32_t>(depth) + ((path.branch - 1) << kBranchShift));
  }

  void add_background(const SpecularRay& path, int depth) {
    if (!shows_depth(settings_, depth)) return;
    for (std::uint32_t i : scene_.infinite_lights())
      sample_.add(path.throughput * light_radiance(scene_.lights()[i], path.ray.direction), depth);
  }

  const RenderScene& scene_;
  Sampler& sampler_;
  PathSettings settings_;
  RayCounts& counts_;
  StopPoll& stop_;
  int last_depth_;
  PathSample sample_;
  DirectLightOfOne& direct_light_;
};

} // namespace

PathSample whitted_radiance(const RenderScene& scene, const PathStart& start, Sampler& sampler,
                            const PathSettings& settings, DirectLightOfOne& direct_light, RayCounts& counts,
                            StopPoll& stop) {
  return WhittedTracer(scene, sampler, settings, direct_light, counts, stop).trace(start);
}

} // namespace candela
