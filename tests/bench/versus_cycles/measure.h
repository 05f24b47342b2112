#pragma once
// Noise of two renderers' pictures of a scene, and a test whether their means agree.

#include "imaging/image.h"

#include <array>
#include <string>
#include <vector>

namespace candela::versus {

/// Mean of the pictures of one size.
Image mean_of(const std::vector<Image>& images);

/// relMSE of one render, from pairs (0, 1), (2, 3) ... of independent seeds: the mean over pixels, channels
/// and pairs of (a - b)^2 / 2 / (r^2 + 0.01). It does not include bias.
double noise_relative_mse(const std::vector<Image>& images, const Image& reference);

/// The ratio of two means, the first over the second.
struct MeanRatio {
  double value = 1;
  double standard_error = 0;
};

struct MeansReport {
  std::array<MeanRatio, 3> image;         ///< by channel
  MeanRatio worst_block;                  ///< the farthest from 1 of all blocks and channels
  std::vector<std::string> disagreements; ///< differences beyond noise and tolerances
};

/// Whether two renderers' pictures (an even number of each) have the same expectation: the mean of each
/// channel over the image, and over each of 8 x 8 blocks, may differ by six standard errors, estimated from
/// the pairs, plus `image_tolerance` and `block_tolerance` relative to the mean for differences of the
/// models.
MeansReport compare_means(const std::vector<Image>& a, const std::vector<Image>& b, double image_tolerance,
                          double block_tolerance);

} // namespace candela::versus
