#pragma once
// Next-event estimation: light that surface points get straight from a light that was aimed at.

#include "bsdf/direction_sampling.h"
#include "render/transport.h"

#include <span>

namespace candela {

/// One of many points that look for light.
struct LightSeeker {
  const Vertex* vertex;
  const Bsdf* bsdf;
  const Sampler* sampler; ///< stands at the vertex's bounce
  int scattered;          ///< directions that the BSDF's strategy will try there
  vec3 light{0};          ///< what comes of it: the estimate of f |cos| x radiance
};

/// The estimate from all lights, by `settings.light_samples` shadow rays a vertex; each weighted against the
/// `scattered` directions where the settings say mis. The lights that no direction meets by chance are aimed
/// at under every strategy, with weight 1. What one seeker gets does not depend on the others.
void aim_at_lights(const RenderScene& scene, std::span<LightSeeker> seekers, const PathSettings& settings,
                   RayCounts& counts);

} // namespace candela
