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

  /// What lies beyond the ends is in the first or last bin; zero, negative and non-finite values are in none.
  std::array<std::array<std::uint32_t, kBins>, kChannels> counts{};
  std::size_t pixels = 0;
  std::size_t dark = 0;          ///< luminance 0 or less
  std::size_t nonfinite = 0;     ///< a channel NaN or infinite
  float smallest = 0;            ///< positive luminance; 0 where there is none
  float largest = 0;             ///< luminance
  double log_average = 0;        ///< geometric mean of the positive luminances; 0 where there is none
  std::size_t clipped_black = 0; ///< pixels shown as 0 0 0
  std::size_t clipped_white = 0; ///< pixels of which a channel is shown as 255

  /// log2 of the start of a bin.
  static float bin_start(std::size_t bin) {
    return static_cast<float>(kLowestStop) + static_cast<float>(bin) / kBinsPerStop;
  }
};

/// Of a picture and of the bytes (RGBA) that show it. Bins of single values are off by 1/256 of the value at
/// most.
LogHistogram log_histogram(std::span<const vec3> linear, std::span<const std::uint8_t> rgba);

} // namespace candela
