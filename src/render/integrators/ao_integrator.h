#pragma once

#include "render/integrators/path_integrator.h"

namespace candela {

/// Ambient occlusion of the first surface: the share, weighted by the cosine, of the hemisphere in which
/// nothing lies within ao.distance, by path.light_samples rays. 1 where the ray leaves the scene. It is the
/// radiance under a white sky that stops at the first white surface (Zhukov, Iones and Kronin 1998).
float ambient_occlusion(const RenderScene& scene, const PathStart& start, Sampler& sampler,
                        const RenderSettings& settings, RayCounts& counts);

} // namespace candela
