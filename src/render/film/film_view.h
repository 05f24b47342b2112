#pragma once
// Views of a film: its means, or statistics of its samples.

#include "render/film/film.h"
#include "scene/document.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace candela {

class RenderScene;

/// Factor that makes the view displayable: the depth view is shown relative to the scene's diagonal.
float display_scale(const RenderScene& scene, const RenderSettings& settings);

/// Fills `out` with the picture of the view, row 0 is the top. The film holds the samples of
/// accumulated_view(view). The holes of a coarse first pass take the top left pixel of their block.
/// - depth_share: red, green and blue are the shares of direct light (emitters seen among it), of one bounce
///   and of more in the radiance;
/// - light_share: the share of the radiance that light sampling found, the rest being found by BSDF sampling;
/// - variance: luminance of the variance of one sample; samples, nonfinite: counts;
/// - others: the mean.
void resolve_view(const Film& film, View view, int coarseness, std::vector<vec3>& out);
Image view_image(const Film& film, View view);

/// Per pixel, unbiased, of the mean, per channel; and the number of samples.
void resolve_statistics(const Film& film, std::vector<vec3>& variance_of_mean,
                        std::vector<std::uint32_t>& samples);

/// relMSE of the film against the image that it converges to, estimated from its own variance: the mean of
/// relative_variance (compare.h) over the pixels of at least two samples; infinite where there are none, for
/// then nothing is known. Samplers that spread their samples well do better than their variance says, and no
/// variance knows of a bias.
double estimated_relmse(const Film& film);
/// The same of what resolve_view and resolve_statistics gave.
double estimated_relmse(std::span<const vec3> mean, std::span<const vec3> variance_of_mean,
                        std::span<const std::uint32_t> samples);

/// stop.noise is tested only at these sample numbers, so that where a render stops does not depend on how its
/// passes divide the samples: multiples of 8, and so far apart that testing costs little.
constexpr int noise_check_step(int spp) {
  return std::max(8, static_cast<int>(std::bit_floor(static_cast<unsigned>(spp))) / 8);
}
constexpr bool is_noise_check(int spp) { return spp > 0 && spp % noise_check_step(spp) == 0; }
/// The first one after `spp` (>= 0).
constexpr int next_noise_check(int spp) {
  int step = noise_check_step(spp);
  return (spp / step + 1) * step;
}

} // namespace candela
