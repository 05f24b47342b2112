#pragma once
// Next-event estimation: light that surface points get straight from a light that was aimed at.

#include "bsdf/direction_sampling.h"
#include "render/vertex_lanes.h"

namespace candela {

/// Points that look for light: those of the lanes of VertexLanes that are named.
struct LightSeekers {
  std::size_t count = 0;
  std::array<std::uint32_t, kLaneCount> lane; ///< the count lanes that seek
  // By lane:
  Lanes<const Sampler*> sampler; ///< stands at the vertex's bounce
  Lanes<int> scattered;          ///< directions that the BSDF's strategy will try there
  Lanes<vec3> light;             ///< what comes of it: the estimate of f |cos| x radiance
};

/// The estimate from all lights, by `settings.light_samples` shadow rays a vertex; each weighted against the
/// `scattered` directions where the settings say mis. The lights that no direction meets by chance are aimed
/// at under every strategy, with weight 1. What one seeker gets does not depend on the others.
void aim_at_lights(const RenderScene& scene, const VertexLanes& vertices, LightSeekers& seekers,
                   const PathSettings& settings, RayCounts& counts);

} // namespace candela
