#pragma once
// Repeats one sample from its indices.

#include "render/film/pass_renderer.h"
#include "render/film/pixel_sampler.h"

namespace candela {

/// The value of the sample, bit for bit as its pass traced it.
vec3 replay_sample(const RenderScene& scene, const Document& document, uvec2 pixel, std::uint32_t sample);

/// The path segment at which a sample of the job stops being finite: that of the shortest path that is not. 0
/// where there is none.
int nonfinite_depth(const PassJob& job, const SampleIndex& index);

} // namespace candela
