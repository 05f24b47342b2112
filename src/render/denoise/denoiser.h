#pragma once
// Denoises a rendered image, with a bias: for display only, and labelled wherever it is shown.

#include "imaging/image.h"

#include <array>
#include <atomic>
#include <optional>

namespace candela {

/// A mean of random samples a pixel, in two halves of independent samples: weights from one half are
/// applied to the other, so that they are independent of its noise.
struct NoisyImage {
  std::array<Image, 2> half; ///< means of either half of the samples
  Image variance;            ///< of the mean of both, per channel
};

/// All of one size.
struct DenoiseInput {
  NoisyImage color;    ///< linear radiance
  NoisyImage albedo;   ///< of the first surface that is not specular
  NoisyImage normal;   ///< its shading normal
  NoisyImage position; ///< its place in units of the scene's size
};

struct DenoiseOptions {
  int threads = 0;                         ///< 0: every core
  const std::atomic<bool>* stop = nullptr; ///< set from another thread, ends the work within milliseconds
};

/// The denoised image; nothing if it was stopped. The same bits for any number of threads.
///
/// First-order regression of the colour on the features, weighted by non-local means of the colour, the two
/// halves crossed: Bitterli et al. 2016, "Nonlinearly Weighted First-order Regression for Denoising Monte
/// Carlo Renderings".
/// Pixels that are not finite are taken from their neighbours.
std::optional<Image> denoise(const DenoiseInput& input, const DenoiseOptions& options = {});

} // namespace candela
