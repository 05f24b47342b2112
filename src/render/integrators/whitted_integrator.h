#pragma once
// Ray tracing as Whitted described it: light from lights, and perfect mirrors and glass.

#include "render/integrators/direct_light.h"
#include "render/integrators/path_integrator.h"

namespace candela {

/// One sample of the light that reaches `start` straight from lights at the first surface that is not
/// perfectly specular, both branches of glass followed (Whitted, "An Improved Illumination Model for Shaded
/// Display", CACM 23(6), 1980). Diffuse surfaces do not light each other: with the path integrator's picture
/// beside it, one sees what is missing. Lights are sampled (several times where path.light_samples says so);
/// depths mean the same as in the path integrator. `direct_light` is memory, of the thread. `layers` as
/// PathTracer::trace() has them. Less than it should be, and quick, where it is asked to stop.
PathSample whitted_radiance(const RenderScene& scene, const PathStart& start, Sampler& sampler,
                            const PathSettings& settings, ScalarDirectLight& direct_light, RayCounts& counts,
                            StopPoll& stop, std::span<PathSample> layers = {});

} // namespace candela
