#pragma once
// Error measures of a picture against a reference.

#include "imaging/image.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace candela {

/// Means over all pixels and channels, summed in double. Pixels with a NaN or infinite channel in either
/// picture count only in `nonfinite` (for FLIP and PSNR they are black or white).
struct ComparisonResult {
  int width = 0;
  int height = 0;
  double rel_mse = 0; ///< mean of (x - r)^2 / (r^2 + 0.01)
  double mse = 0;     ///< mean of (x - r)^2
  double psnr = 0; ///< dB, of the pictures clipped to [0, 1] and encoded as sRGB, peak 1; infinite if equal
  double flip = 0; ///< mean of flip_map (imaging/flip.h)
  std::array<double, 3> mean_ratio{}; ///< per channel, sum of x over sum of r; 1 if both are 0
  std::int64_t nonfinite = 0;         ///< pixels that are not finite in the picture or the reference
  double largest_relative_error = 0;  ///< of relative_error, over finite pixels
};

/// The sizes must be equal.
ComparisonResult compare_images(const Image& image, const Image& reference);

/// ComparisonResult::rel_mse alone, without the cost of the rest. The sizes must be equal.
double relative_mse(std::span<const vec3> image, std::span<const vec3> reference);

/// A pixel's share of the relMSE estimated from the variance of its mean, with the mean in place of the
/// reference: mean over channels of variance / (mean^2 + 0.01).
double relative_variance(vec3 mean, vec3 variance_of_mean);

/// {"width": …, "relMSE": …, …}, indented by two spaces, without a final line break. JSON has no infinity:
/// the PSNR of equal pictures is null, and so is a ratio to a black reference.
std::string comparison_json(const ComparisonResult& result);

/// The root of a pixel's share of relMSE: sqrt(mean over channels of (x - r)^2 / (r^2 + 0.01)).
double relative_error(vec3 x, vec3 r);

/// relative_error of every pixel as a picture, 8-bit sRGB, three bytes a pixel: black at 0.1 % or less, by
/// decades through magma to light yellow at 100 % or more; pixels that are not finite are cyan, which is not
/// in the map.
std::vector<std::uint8_t> relative_error_picture(const Image& image, const Image& reference);

} // namespace candela
