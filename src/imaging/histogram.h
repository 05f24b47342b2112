#pragma once
// The distribution of brightness in a picture, in stops.

#include "core/math.h"

#include <array>
#include <span>

namespace candela {

/// Counts over bins of equal width in log2 of the linear value.
struct LogHistogram {
  static constexpr int kBinsPerStop = 8;
  static constexpr int kLowestStop = -32,
                       kHighestStop = 32; ///< log2 of the first bin's start, the last's end
  static constexpr std::size_t kBins = std::size_t{kHighestStop - kLowestStop} * kBinsPerStop;
  enum Channel : std::size_t { red, green, blue, gray, kChannels }; ///< gray: luminance

  /// Values beyond the ends are in the first or last bin; zero, negative and non-finite values in none.
  std::array<std::array<std::uint32_t, kBins>, kChannels> counts{};
  std::size_t pixels = 0;
  std::size_t dark = 0;          ///< luminance 0 or less
  std::size_t nonfinite = 0;     ///< a channel NaN or infinite
  float smallest = 0;            ///< positive luminance; 0 if there is none
  float largest = 0;             ///< luminance
  double log_average = 0;        ///< geometric mean of the positive luminances; 0 if there are none
  std::size_t clipped_black = 0; ///< pixels shown as 0 0 0
  std::size_t clipped_white = 0; ///< pixels of which a channel is shown as 255

  /// log2 of the start of a bin.
  static float bin_start(std::size_t bin) {
    return static_cast<float>(kLowestStop) + static_cast<float>(bin) / kBinsPerStop;
  }
};

/// The histogram of a picture and of its displayed bytes (RGBA). Values are assigned to bins with an error of
/// at most 1/256.
LogHistogram log_histogram(std::span<const vec3> linear, std::span<const std::uint8_t> rgba);

} // namespace candela
