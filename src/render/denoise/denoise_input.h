#pragma once
// Filtering of the inputs of the denoiser's regression.

#include "render/denoise/denoise_tile.h"
#include "render/denoise/denoiser.h"

namespace candela::denoising {

/// The colour's halves. Pixels that are not finite become the mean of their finite neighbours. The variance
/// is smoothed, for one estimated from few samples is itself noisy, and brought to the size that the
/// difference of the halves has: samples that are spread well err less than their variance says.
Halves prepare_color(const NoisyImage& color);

/// Writes the feature into three channels of `out`, without its noise (antialiasing, depth of field) as far
/// as that can be separated from its edges: cross-filtered by non-local means, as Bitterli et al. 2016,
/// section 4.2. Stops between tiles where `stop` is set.
void prepare_feature(const NoisyImage& feature, Planes& out, int first_channel, int threads,
                     const std::atomic<bool>& stop);

} // namespace candela::denoising
