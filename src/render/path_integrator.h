#pragma once
// The path tracer: radiance along a camera ray by a random walk from the eye.

#include "render/frame.h"
#include "render/render_scene.h"
#include "sampling/sampler.h"

namespace candela {

/// One sample of the radiance that arrives along `ray` (which starts in empty space), W/(m^2 sr). The sampler
/// stands at the path's pixel and sample. Unbiased unless the settings say otherwise (max_depth, component,
/// clamp).
vec3 path_radiance(const RenderScene& scene, Ray ray, Sampler& sampler, const PathSettings& settings,
                   RayCounts& counts);

/// The first surface's albedo, shading normal (mapped to 0.5 n + 0.5) or depth along `forward` (scene units),
/// as `view` says; 0 where the ray leaves the scene.
vec3 view_value(const RenderScene& scene, Ray ray, vec3 forward, View view, Sampler& sampler,
                RayCounts& counts);

/// The closest surface of the ray, looking through what is transparent with the chance of 1 - opacity; each
/// crossing has a random number of its own. The ray then starts behind the last one that it passed.
bool intersect_scene(const RenderScene& scene, Ray& ray, const Sampler& sampler, Hit& hit, RayCounts& counts);

} // namespace candela
