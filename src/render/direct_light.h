#pragma once
// Next-event estimation: light that a surface point gets straight from a light that was aimed at.

#include "bsdf/direction_sampling.h"
#include "render/transport.h"

namespace candela {

/// The estimate of f |cos| x radiance from all lights, by `settings.light_samples` shadow rays; each weighted
/// against the `scattered` directions that the BSDF's strategy will try where the settings say mis. The
/// lights that no direction meets by chance are aimed at under every strategy, with weight 1.
vec3 aim_at_lights(const RenderScene& scene, const Vertex& vertex, const Bsdf& bsdf, const Sampler& sampler,
                   const PathSettings& settings, int scattered, RayCounts& counts);

} // namespace candela
