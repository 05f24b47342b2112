#include "imaging/histogram.h"

#include "core/color.h"

#include <bit>
#include <cassert>

namespace candela {

namespace {

/// Bins of positive floats by their exponent and 8 bits of mantissa: a look-up is much faster than a
/// logarithm.
using BinTable = std::array<std::uint16_t, 1 << 16>;

BinTable make_bins() {
  BinTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float middle = std::bit_cast<float>(static_cast<std::uint32_t>(i << 15) + 0x4000u);
    const double stop = static_cast<double>(std::log2(middle)) - LogHistogram::kLowestStop;
    const double bin = std::isfinite(stop) ? std::floor(stop * LogHistogram::kBinsPerStop) : 0;
    table[i] = static_cast<std::uint16_t>(std::clamp(bin, 0.0, static_cast<double>(LogHistogram::kBins - 1)));
  }
  return table;
}

} // namespace

LogHistogram log_histogram(std::span<const vec3> linear, std::span<const std::uint8_t> rgba) {
  assert(rgba.size() == 4 * linear.size());
  static const BinTable kBinOf = make_bins();
  auto bin_of = [](float x) { return kBinOf[std::bit_cast<std::uint32_t>(x) >> 15]; };
  LogHistogram h;
  h.pixels = linear.size();
  float smallest = kInfinity;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const std::uint8_t* shown = rgba.data() + 4 * i;
    h.clipped_black += shown[0] == 0 && shown[1] == 0 && shown[2] == 0;
    h.clipped_white += shown[0] == 255 || shown[1] == 255 || shown[2] == 255;
    const vec3 p = linear[i];
    if (!is_finite(p)) {
      ++h.nonfinite;
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c)
      if (const float x = p[static_cast<int>(c)]; x > 0) ++h.counts[c][bin_of(x)];
    const float l = luminance(p);
    if (!(l > 0)) {
      ++h.dark;
      continue;
    }
    ++h.counts[LogHistogram::gray][bin_of(l)];
    smallest = std::min(smallest, l);
    h.largest = std::max(h.largest, l);
  }
  // The mean logarithm, with the bins' centres.
  double sum = 0, count = 0;
  for (std::size_t b = 0; b < LogHistogram::kBins; ++b) {
    const double n = h.counts[LogHistogram::gray][b];
    sum += n * (static_cast<double>(LogHistogram::bin_start(b)) + 0.5 / LogHistogram::kBinsPerStop);
    count += n;
  }
  if (count > 0) {
    h.smallest = smallest;
    h.log_average = std::exp2(sum / count);
  }
  return h;
}

} // namespace candela
