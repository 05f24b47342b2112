#include "core/color.h"
#include "imaging/histogram.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace candela::test {
namespace {

LogHistogram of(const std::vector<vec3>& linear) {
  return log_histogram(linear, std::vector<std::uint8_t>(4 * linear.size(), 100));
}

std::size_t total(const LogHistogram& h, LogHistogram::Channel channel) {
  return std::accumulate(h.counts[channel].begin(), h.counts[channel].end(), std::size_t{0});
}

TEST(Histogram, PutsEachValueIntoItsBin) {
  for (float stop = -31.9375f; stop < 32; stop += 0.125f) { // the bins' middles
    const float value = std::exp2(stop);
    const LogHistogram h = of({vec3(value, 0, 0)});
    const auto bin = static_cast<std::size_t>((stop + 32) * 8);
    EXPECT_EQ(h.counts[LogHistogram::red][bin], 1u) << stop;
    EXPECT_LE(LogHistogram::bin_start(bin), stop);
    EXPECT_GT(LogHistogram::bin_start(bin + 1), stop);
    EXPECT_EQ(total(h, LogHistogram::green), 0u);
    EXPECT_EQ(total(h, LogHistogram::gray), 1u);
  }
}

TEST(Histogram, CountsWhatHasNoLogarithmApart) {
  const LogHistogram h =
      of({vec3(0), vec3(-1), vec3(std::nanf("")), vec3(kInfinity), vec3(1e-30f), vec3(1e30f), vec3(0.5f)});
  EXPECT_EQ(h.pixels, 7u);
  EXPECT_EQ(h.dark, 2u);
  EXPECT_EQ(h.nonfinite, 2u);
  EXPECT_EQ(total(h, LogHistogram::gray), 3u);
  EXPECT_EQ(h.counts[LogHistogram::blue].front(), 1u) << "beyond the ends: the end bins";
  EXPECT_EQ(h.counts[LogHistogram::blue].back(), 1u);
}

TEST(Histogram, KnowsTheMeanOfTheLogarithmsAndTheEnds) {
  const LogHistogram h = of({vec3(0.25f), vec3(4), vec3(0)});
  EXPECT_NEAR(h.log_average, 1, 0.1); // bins are an eighth of a stop wide
  EXPECT_NEAR(h.smallest, 0.25f, 1e-6f);
  EXPECT_NEAR(h.largest, 4, 1e-5f);
  EXPECT_EQ(of({vec3(0)}).log_average, 0);
}

TEST(Histogram, ClippingIsThatOfTheShownBytes) {
  const std::vector<vec3> linear(5, vec3(1));
  const std::vector<std::uint8_t> rgba = {0, 0,   0,   255, 0,   1,   0, 255, 255, 3,
                                          3, 255, 254, 254, 254, 255, 9, 9,   255, 255};
  const LogHistogram h = log_histogram(linear, rgba);
  EXPECT_EQ(h.clipped_black, 1u);
  EXPECT_EQ(h.clipped_white, 2u);
}

} // namespace
} // namespace candela::test
