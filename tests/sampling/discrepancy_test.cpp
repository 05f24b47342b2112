#include "sampler_draws.h"
#include "sampling/discrepancy.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

TEST(Discrepancy, HasItsClosedValues) {
  EXPECT_DOUBLE_EQ(l2_star_discrepancy({}), 1.0 / 3);
  // A point at the origin is in every box: the mean of (1 - a b)^2 = 1 - 1/2 + 1/9.
  EXPECT_NEAR(l2_star_discrepancy(std::vector<vec2>(5, vec2(0))), std::sqrt(11.0 / 18), 1e-15);
  // One in the middle: 1/9 - (3/4)^2 / 2 + 1/4.
  EXPECT_NEAR(l2_star_discrepancy(std::vector<vec2>{vec2(0.5f)}), std::sqrt(23.0 / 288), 1e-15);
  // Two on the diagonal: 1/9 - (15/16)^2 / 4 - (7/16)^2 / 4 + ((3/4)^2 + (1/4)^2 + 2 (1/4)^2) / 4.
  EXPECT_NEAR(l2_star_discrepancy(std::vector<vec2>{vec2(0.25f), vec2(0.75f)}),
              std::sqrt(1.0 / 9 - 274.0 / 1024 + 3.0 / 16), 1e-15);
}

/// The definition, by the midpoint rule.
TEST(Discrepancy, IsTheErrorOfBoxesInTheMean) {
  std::vector<vec2> points;
  for (std::uint32_t i = 0; i < 20; ++i)
    points.emplace_back(to_unit_float(hash32(i)), to_unit_float(hash32(i + 50)));
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      double a = (i + 0.5) / kSteps, b = (j + 0.5) / kSteps, share = 0;
      for (vec2 p : points) share += (double(p.x) < a && double(p.y) < b ? 1.0 : 0.0) / 20;
      sum += (share - a * b) * (share - a * b);
    }
  }
  EXPECT_NEAR(l2_star_discrepancy(points), std::sqrt(sum / kSteps / kSteps), 1e-4);
}

double mean_square(SamplerType type, std::uint32_t n, RunningStatistics* statistics = nullptr) {
  Sampler sampler(type, fresh_seed(), 16);
  RunningStatistics own;
  for (std::uint32_t pixel = 0; pixel < 300; ++pixel) {
    std::vector<vec2> points;
    for (std::uint32_t i = 0; i < n; ++i)
      points.push_back(draw(sampler, {independent_pixel(type, pixel, 1), i, 0, Dimension::film, 0}));
    own.add(std::pow(l2_star_discrepancy(points), 2));
  }
  if (statistics) *statistics = own;
  return own.mean();
}

TEST(DiscrepancyStatistical, OfIndependentPointsIsKnownAndOfOthersLower) {
  SCOPED_TRACE(seed_note());
  RunningStatistics independent;
  mean_square(SamplerType::independent, 64, &independent);
  EXPECT_GT(z_test(independent, 5.0 / (36 * 64)), kFalseAlarm);
  for (SamplerType type : kSamplerTypes) {
    if (type == SamplerType::independent) continue;
    // Stratified points gain a factor of sqrt(n) or so in D^2, sequences nearly n / log n.
    double factor = type == SamplerType::stratified ? 5 : 25;
    EXPECT_LT(mean_square(type, 256), 5.0 / (36 * 256) / factor) << static_cast<int>(type);
  }
}

} // namespace
} // namespace candela::test
