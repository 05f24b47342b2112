#pragma once
// Next-event estimation: direct light at surface points, from lights that are sampled.

#include "core/stop_condition.h"
#include "materials/direction_sampling.h"
#include "render/integrators/vertex_lanes.h"
#include "render/lights/light_lanes.h"

#include <span>
#include <vector>

namespace candela {

/// Light of one layer (RenderScene::layer_of_light) at the shading point in a lane.
struct LayeredLight {
  std::uint32_t lane;
  std::uint8_t layer;
  Spectrum light;
};

/// The points that lights are sampled for: some lanes of VertexLanes.
struct ShadingPoints {
  std::size_t count = 0;
  std::uint32_t draw = 0; ///< index of the random numbers; differs where one bounce has several such points
  bool coherent = false;  ///< their shadow rays are traced together: faster where they lie side by side
  std::array<std::uint32_t, kLaneCount> lane; ///< of the first `count`
  // By lane:
  Lanes<const Sampler*> sampler;   ///< stands at the vertex's bounce
  Lanes<float> bsdf_samples;       ///< directions that BSDF sampling will take there, for MIS
  Lanes<const MediumStack*> media; ///< of the point, on the side of wo; in scenes with media
  Lanes<Spectrum> light;           ///< output: the estimate of f |cos| x radiance
  /// Output, if not null: the parts of `light`, with the layers of their lights.
  std::vector<LayeredLight>* layered = nullptr;
};

/// Density, 1/sr, with which light sampling gives the unit `direction`, for MIS: `pdf` is that of the light
/// there (light_pdf), which is one of all.
inline float light_sampling_pdf(const RenderScene& scene, const LightSamplingContext& context,
                                std::uint32_t light, float pdf, vec3 direction) {
  return context.accepts(direction) ? scene.all_lights().pmf(context, light) * pdf : 0;
}

/// For one thread; keep it, for it keeps its memory.
class DirectLight {
public:
  /// The estimate from all lights, by `settings.light_samples` shadow rays a vertex; each weighted against
  /// the `bsdf_samples` where the settings say mis. Delta lights, which BSDF sampling cannot find, are
  /// sampled under every strategy, with weight 1. The estimate of a point is independent of the others.
  /// Returns early, with less light, where it is asked to stop.
  void estimate(const RenderScene& scene, const VertexLanes& vertices, ShadingPoints& points,
                const PathSettings& settings, RayCounts& counts, StopPoll& stop);

private:
  /// Directions to the sampled lights, by the lane of the vertex.
  struct LightDirectionLanes {
    Vec3Lanes direction; ///< unit, to the light
    Vec3Lanes wi_local;  ///< the same about the normal
    Lanes<float> cosine; ///< with the light sampling context's normal
    // The shadow ray:
    Vec3Lanes origin;
    Vec3Lanes target; ///< its end, off the light's surface; unused where the light is infinite
  };
  /// A light sample that waits for its shadow ray, and what it contributes if nothing is between.
  struct ShadowRay {
    Ray ray;
    ShadowTarget target;
    std::uint32_t lane;
    MediumStack media; ///< where it begins; in scenes with media
    Spectrum light;
    std::uint8_t layer; ///< of the light, where layers are asked for
    // In scenes with active media, where the weight against BSDF sampling depends on what is between:
    bool weighted_later;
    float light_pdf, bsdf_pdf; ///< 1/sr, numbers of samples included
  };

  // The stages of one light sample for each point, in their order.
  void draw_numbers(const ShadingPoints& points, std::uint32_t index, int samples);
  void select_lights(const RenderScene& scene, const LightSelection& selection, const VertexLanes& vertices,
                     const ShadingPoints& points);
  static void set_directions(const VertexLanes& vertices, const LightSampleLanes& lights,
                             LightDirectionLanes& directions);
  void weight_samples(const RenderScene& scene, const VertexLanes& vertices, const ShadingPoints& points,
                      const PathSettings& settings);
  void set_ray(ShadowRay& shadow, float time) const;
  static void add(ShadingPoints& points, const ShadowRay& shadow, Spectrum light);
  static Spectrum passed(const RenderScene& scene, const ShadowRay& shadow, const ShadingPoints& points,
                         MisHeuristic heuristic, RayCounts& counts);
  void look_up_radiance(const RenderScene& scene);
  void trace_shadow_rays(const RenderScene& scene, ShadingPoints& points, MisHeuristic heuristic,
                         RayCounts& counts, StopPoll& stop);

  std::vector<Sampler> branched_;
  Lanes<vec2> u_; ///< by point; all else by lane or by query
  Lanes<LightQuery> queries_;
  std::size_t query_count_ = 0;
  Lanes<float> pmf_;          ///< of the light's having been selected
  LightSampleLanes lights_{}; ///< set_directions() reads all
  LightDirectionLanes directions_;
  Lanes<ShadowRay> shadows_;
  std::size_t shadow_count_ = 0;
};

/// The same for one vertex at a time, without BSDF sampling beside it.
class ScalarDirectLight {
public:
  Spectrum estimate(const RenderScene& scene, const Vertex& vertex, const Bsdf& bsdf, const Sampler& sampler,
                    const PathSettings& settings, RayCounts& counts, StopPoll& stop,
                    const MediumStack* media = nullptr);
  /// From now on there are the parts of the newest estimate, as ShadingPoints::layered has them.
  void keep_layers(bool keep) { points_.layered = keep ? &layered_ : nullptr; }
  std::span<const LayeredLight> layered() const { return layered_; }

private:
  std::vector<LayeredLight> layered_;
  VertexLanes vertices_;
  ShadingPoints points_;
  DirectLight direct_light_;
};

} // namespace candela
