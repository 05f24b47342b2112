#pragma once
// Next-event estimation: light that surface points get straight from a light that was aimed at.

#include "bsdf/direction_sampling.h"
#include "core/stop_condition.h"
#include "render/integrators/vertex_lanes.h"
#include "render/lights/light_lanes.h"

namespace candela {

/// Points that look for light: those of the lanes of VertexLanes that are named.
struct LightSeekers {
  std::size_t count = 0;
  bool neighbours = false; ///< what they ask is asked together: faster where they lie side by side
  std::array<std::uint32_t, kLaneCount> lane; ///< the count lanes that seek
  // By lane:
  Lanes<const Sampler*> sampler; ///< stands at the vertex's bounce
  Lanes<int> scattered;          ///< directions that the BSDF's strategy will try there
  Lanes<const Interiors*>
      interiors;     ///< bodies that the point lies in, on the side of wo; in scenes with absorption
  Lanes<vec3> light; ///< what comes of it: the estimate of f |cos| x radiance
};

/// Density, 1/sr, with which a sample of direct light aims along the unit `direction`, for MIS: `pdf` is that
/// of the light there (light_pdf), which is one of all.
inline float aimed_pdf(const RenderScene& scene, const LightReference& reference, std::uint32_t light,
                       float pdf, vec3 direction) {
  return reference.accepts(direction) ? scene.all_lights().pmf(reference, light) * pdf : 0;
}

/// For one thread; keep it, for it keeps its memory.
class DirectLight {
public:
  /// The estimate from all lights, by `settings.light_samples` shadow rays a vertex; each weighted against
  /// the `scattered` directions where the settings say mis. The lights that no direction meets by chance are
  /// aimed at under every strategy, with weight 1. What one seeker gets does not depend on the others. Comes
  /// back early, with less light, where it is asked to stop.
  void aim(const RenderScene& scene, const VertexLanes& vertices, LightSeekers& seekers,
           const PathSettings& settings, RayCounts& counts, StopPoll& stop);

private:
  /// What is aimed along, by the lane of the vertex.
  struct AimedLanes {
    Vec3Lanes direction; ///< unit, to the light
    Vec3Lanes wi_local;  ///< the same about the normal
    Lanes<float> cosine; ///< with the reference's normal
    // The shadow ray:
    Vec3Lanes origin;
    Vec3Lanes target; ///< its end, off the light's surface; unused where the light is infinite
  };
  /// A light sample that waits to be looked at, and what it brings if nothing is between.
  struct ShadowRay {
    Ray ray;
    vec3 target;
    bool infinite;
    std::uint32_t lane;
    vec3 light;
  };

  void draw(const LightSeekers& seekers, std::uint32_t index, int samples);
  void choose(const RenderScene& scene, const LightSelection& selection, const VertexLanes& vertices,
              const LightSeekers& seekers);
  void weigh(const VertexLanes& vertices, const LightSeekers& seekers, const PathSettings& settings);
  void set_ray(ShadowRay& shadow) const;
  void look(const RenderScene& scene, LightSeekers& seekers, RayCounts& counts, StopPoll& stop);
  void look_up_radiance(const RenderScene& scene);
  static void set_aims(const VertexLanes& vertices, const LightSampleLanes& lights, AimedLanes& aims);

  // Of one light sample for each seeker:
  std::vector<Sampler> branched_;
  Lanes<vec2> u_; ///< by seeker; all else by lane or in the order of asking
  Lanes<LightQuery> queries_;
  std::size_t queried_ = 0;
  Lanes<float> pmf_;
  LightSampleLanes lights_{}; ///< set_aims() looks at all
  AimedLanes aims_;
  Lanes<ShadowRay> shadows_;
  std::size_t shadow_count_ = 0;
};

/// The same for one vertex at a time, from which no direction is tried by chance.
class DirectLightOfOne {
public:
  vec3 aim(const RenderScene& scene, const Vertex& vertex, const Bsdf& bsdf, const Sampler& sampler,
           const PathSettings& settings, RayCounts& counts, StopPoll& stop,
           const Interiors* interiors = nullptr);

private:
  VertexLanes vertices_;
  LightSeekers seekers_;
  DirectLight direct_light_;
};

} // namespace candela
