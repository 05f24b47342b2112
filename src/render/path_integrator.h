#pragma once
// The path tracer: radiance along a camera ray by a random walk from the eye.

#include "render/path_sample.h"
#include "render/transport.h"

namespace candela {

/// One sample of the radiance that arrives along `ray` (which starts in empty space). The sampler stands at
/// the path's pixel and sample. Unbiased unless the settings say otherwise (max_depth, component,
/// only_depth).
PathSample path_radiance(const RenderScene& scene, const Ray& ray, Sampler& sampler,
                         const PathSettings& settings, RayCounts& counts);

/// Whether the settings show light of paths of `depth` segments.
bool shows_depth(const PathSettings& settings, int depth);
/// The longest path that can matter under the settings, in segments.
int longest_path(const PathSettings& settings);

} // namespace candela
