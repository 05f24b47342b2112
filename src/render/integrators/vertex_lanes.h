#pragma once
// Hits of many rays made ready for scattering, side by side: what Vertex is of one.

#include "core/lanes.h"
#include "materials/bsdf_lanes.h"
#include "render/integrators/transport.h"

#include <span>

namespace candela {

/// Up to kLaneCount of them.
struct VertexLanes {
  std::size_t count = 0;
  Vec3Lanes position, position_error; ///< as SurfaceInteraction has them
  Vec3Lanes geometric_normal;
  Vec3Lanes normal;   ///< visible_normal
  Vec3Lanes wo_local; ///< unit, where the ray came from, about the normal
  Lanes<float> side;  ///< cosine of wo with the geometric normal: > 0 outside
  Lanes<float> time;  ///< of the ray
  Lanes<LightSamplingContext> light_context;
  Lanes<const SurfaceMaterial*> material;
  Lanes<Bsdf> varying; ///< where the BSDF depends on the hit (SurfaceMaterial::varies)
  BlendArena blends;   ///< parts of those

  /// Lane i is where rays[i] met hits[i]. media[i] are those of the ray; none in scenes without priorities.
  /// Textures are filtered over cones[i], if there are cones.
  void set(const RenderScene& scene, std::span<const Ray* const> rays, std::span<const Hit> hits,
           std::span<const MediumStack* const> media = {}, std::span<const ConeOfRay* const> cones = {});
  /// Lane 0 is `vertex`, with this BSDF, and there is no other.
  void set_one(const Vertex& vertex, const Bsdf& bsdf);

  /// Lane i is a point in a medium, which a ray of that unit direction and time reaches. Its frame is about
  /// the way back.
  void set_in_medium(std::size_t i, vec3 point, vec3 direction, float at_time, const PhaseFunction& phase);

  const Bsdf& bsdf(std::size_t i) const { return material[i]->varies ? varying[i] : material[i]->bsdf; }
  /// As folds_directions() has it.
  bool folds(std::size_t i) const { return folds_directions(bsdf(i), normal[i], geometric_normal[i]); }
  /// f |cos| and the density of wi (local, unit) under `how`, without delta lobes, what is folded onto it
  /// included.
  BsdfEval eval_pdf(std::size_t i, vec3 wi_local, DirectionSampling how) const {
    const BsdfEval own = direction_eval_pdf(bsdf(i), wo_local[i], wi_local, how);
    return folds(i) ? folded_eval_pdf(i, wi_local, how, own) : own;
  }
  /// Density that folding adds to a direction that was sampled, before or after it was folded itself.
  float folded_pdf(std::size_t i, vec3 wi_local, DirectionSampling how) const;
  /// eval_pdf() of a lane that folds, from what it is without.
  BsdfEval folded_eval_pdf(std::size_t i, vec3 wi_local, DirectionSampling how, const BsdfEval& own) const;
  /// As Vertex::scatters().
  bool scatters(std::size_t i) const { return wo_local.z[i] * side[i] > 0; }
};

} // namespace candela
