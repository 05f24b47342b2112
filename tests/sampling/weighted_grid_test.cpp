#include "sampling/warp.h"
#include "sampling/weighted_grid.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace candela::test {
namespace {

float unit_float(std::mt19937_64& random) { return static_cast<float>(random() >> 40) * 0x1p-24f; }

TEST(GuidedTable, TheMeasureOfEachIndexIsItsWeight) {
  for (const std::vector<float>& weights :
       {std::vector<float>{1}, {1, 1, 1, 1}, {0, 3, 0, 0, 1, 0}, {1e-3f, 1, 0.25f, 0, 0}, {0, 0, 0, 0, 7}}) {
    GuidedTable table(weights);
    double sum = 0;
    for (float w : weights) sum += static_cast<double>(w);
    std::vector<double> measure(weights.size());
    constexpr int kDraws = 1 << 16;
    std::uint32_t before = 0;
    for (int k = 0; k < kDraws; ++k) {
      auto s = table.sample((static_cast<float>(k) + 0.5f) / kDraws);
      ASSERT_GE(s.index, before) << "monotonic";
      ASSERT_TRUE(s.u >= 0 && s.u < 1);
      before = s.index;
      measure[s.index] += 1.0 / kDraws;
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_NEAR(measure[i], static_cast<double>(weights[i]) / sum, 2.0 / kDraws);
    for (float end : {0.0f, kOneMinusEpsilon}) EXPECT_GT(weights[table.sample(end).index], 0);
  }
  EXPECT_THROW(GuidedTable(std::vector<float>{}), std::invalid_argument);
  EXPECT_THROW(GuidedTable(std::vector<float>{1, -1}), std::invalid_argument);
  EXPECT_THROW(WeightedGrid(std::vector<float>{1, 2, 3}, 2), std::invalid_argument);
}

TEST(WeightedGridStatistical, DrawsCellsByWeightAndLeavesUniformNumbers) {
  std::mt19937_64 random(fresh_seed() + 11);
  constexpr std::size_t kColumns = 23, kRows = 9;
  std::vector<float> weights(kColumns * kRows);
  double sum = 0;
  for (float& w : weights)
    w = unit_float(random) < 0.2f ? 0 : unit_float(random), sum += static_cast<double>(w);
  WeightedGrid grid(weights, kColumns);
  constexpr int kDraws = 200000;
  std::vector<double> observed(4 * weights.size()), expected;
  for (float w : weights) expected.insert(expected.end(), 4, kDraws * static_cast<double>(w) / sum / 4);
  for (int i = 0; i < kDraws; ++i) {
    float u = unit_float(random), v = unit_float(random);
    auto s = grid.sample({u, v});
    observed[4 * (s.row * kColumns + s.column) + (s.u.x < 0.5f ? 0 : 1) + (s.u.y < 0.5f ? 0 : 2)] += 1;
  }
  EXPECT_GT(chi_square_test(observed, expected).p_value, kFalseAlarm) << seed_note();
}

TEST(Warp, LinearRampsAreInversesOfTheirIntegrals) {
  for (vec3 r : {vec3(1, 1, 1), vec3(0, 1, 0), vec3(1, 0, 3), vec3(0, 0, 2), vec3(5, 1, 0)})
    for (int k = 0; k < 1000; ++k) {
      float u = (static_cast<float>(k) + 0.5f) / 1000;
      float x = sample_linear(u, r.x, r.y, r.z);
      ASSERT_TRUE(x >= 0 && x < 1);
      auto integral = [](float a, float b, float t) { return t * (a + 0.5f * t * (b - a)); };
      float t = 2 * x, sum = t < 1 ? integral(r.x, r.y, t) : 0.5f * (r.x + r.y) + integral(r.y, r.z, t - 1);
      ASSERT_NEAR(sum / (0.5f * (r.x + 2 * r.y + r.z)), u, 1e-5f);
    }
}

} // namespace
} // namespace candela::test
