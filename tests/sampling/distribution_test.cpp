#include "sampling/distribution.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace candela::test {
namespace {

float unit(std::mt19937_64& random) { return static_cast<float>(random() >> 40) * 0x1p-24f; }

std::vector<std::vector<float>> weight_tables() {
  std::vector<std::vector<float>> tables = {
      {1}, {1, 1, 1, 1}, {0, 3, 0, 0, 1, 0}, {1e-6f, 1, 1e-6f}, {0.1f, 0.2f, 0.3f, 0.4f, 1e6f}};
  std::vector<float> many;
  for (int i = 0; i < 100; ++i) many.push_back(i % 7 == 0 ? 0.0f : static_cast<float>(i * i));
  tables.push_back(many);
  return tables;
}

TEST(AliasTable, PmfIsTheNormalisedWeight) {
  for (const auto& weights : weight_tables()) {
    AliasTable table(weights);
    double sum = 0;
    for (float w : weights) sum += w;
    ASSERT_EQ(table.size(), weights.size());
    for (std::uint32_t i = 0; i < weights.size(); ++i)
      EXPECT_FLOAT_EQ(table.pmf(i), static_cast<float>(weights[i] / sum));
  }
}

TEST(AliasTable, NeverDrawsAWeightOfZero) {
  for (const auto& weights : weight_tables()) {
    AliasTable table(weights);
    for (std::uint32_t i = 0; i < (1u << 24); i += 61) {
      AliasTable::Sample s = table.sample(static_cast<float>(i) * 0x1p-24f);
      ASSERT_LT(s.index, weights.size());
      ASSERT_GT(weights[s.index], 0);
      ASSERT_EQ(s.pmf, table.pmf(s.index));
      ASSERT_TRUE(s.u >= 0 && s.u < 1);
    }
    EXPECT_GT(weights[table.sample_bits(0).index], 0);
    EXPECT_GT(weights[table.sample_bits(~0u).index], 0);
  }
}

TEST(AliasTable, TheMeasureOfEachIndexIsItsPmf) {
  // Every 32-bit number of a fine lattice once: no chance involved.
  for (const auto& weights : weight_tables()) {
    AliasTable table(weights);
    std::vector<double> share(weights.size());
    constexpr std::uint32_t kSteps = 1u << 20;
    for (std::uint32_t i = 0; i < kSteps; ++i)
      share[table.sample_bits(i << 12 | 0x800).index] += 1.0 / kSteps;
    for (std::uint32_t i = 0; i < weights.size(); ++i)
      EXPECT_NEAR(share[i], table.pmf(i), 2.0 * static_cast<double>(weights.size()) / kSteps) << i;
  }
}

TEST(AliasTable, EmptyWhereAllWeightsAreZero) {
  EXPECT_TRUE(AliasTable().empty());
  EXPECT_TRUE(AliasTable(std::vector<float>{}).empty());
  EXPECT_TRUE(AliasTable(std::vector<float>{0, 0}).empty());
}

TEST(AliasTable, RejectsWhatIsNoWeight) {
  for (float bad : {-1.0f, std::nanf(""), kInfinity}) {
    EXPECT_THROW(AliasTable(std::vector<float>{1, bad}), std::invalid_argument);
    EXPECT_THROW(PiecewiseConstant1D(std::vector<float>{1, bad}), std::invalid_argument);
  }
  EXPECT_THROW(PiecewiseConstant1D(std::vector<float>{}), std::invalid_argument);
}

TEST(AliasTableStatistical, RemappedNumberIsUniformForEachIndex) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed() + 1);
  std::vector<float> weights = {5, 0, 1, 2, 0.5f, 9};
  AliasTable table(weights);
  constexpr int kDraws = 1000000;
  constexpr std::size_t kCells = 32;
  std::vector<double> observed(weights.size() * kCells), expected(weights.size() * kCells);
  for (int i = 0; i < kDraws; ++i) {
    AliasTable::Sample s = table.sample(unit(random));
    observed[s.index * kCells + static_cast<std::size_t>(s.u * kCells)] += 1;
  }
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t c = 0; c < kCells; ++c) expected[i * kCells + c] = kDraws * (weights[i] / 17.5) / kCells;
  EXPECT_GT(chi_square_test(observed, expected).p_value, kFalseAlarm);
}

TEST(AliasTableStatistical, LargeTable) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed() + 2);
  constexpr std::size_t kSize = 100000;
  std::vector<float> weights(kSize);
  double sum = 0;
  for (float& w : weights) sum += (w = unit(random) * unit(random));
  AliasTable table(weights);
  constexpr int kDraws = 4000000;
  std::vector<double> observed(kSize), expected(kSize);
  for (int i = 0; i < kDraws; ++i)
    observed[table.sample_bits(static_cast<std::uint32_t>(random() >> 32)).index] += 1;
  for (std::size_t i = 0; i < kSize; ++i) expected[i] = kDraws * (weights[i] / sum);
  EXPECT_GT(chi_square_test(observed, expected).p_value, kFalseAlarm);
}

TEST(PiecewiseConstant, SampleInvertsTheDistribution) {
  std::vector<float> weights = {0, 2, 0, 1, 1, 0};
  PiecewiseConstant1D d(weights);
  EXPECT_FLOAT_EQ(d.integral(), 4.0f / 6);
  EXPECT_EQ(d.sample(0).cell, 1u);
  EXPECT_EQ(d.sample(kOneMinusEpsilon).cell, 4u);
  for (int i = 0; i < 1000; ++i) {
    float u = static_cast<float>(i) / 1000;
    PiecewiseConstant1D::Sample s = d.sample(u);
    // The distribution function at s.x, by hand.
    double x = double(s.x) * 6, f = 0;
    for (std::size_t c = 0; c < 6; ++c)
      f += weights[c] / 4 * std::clamp(x - static_cast<double>(c), 0.0, 1.0);
    ASSERT_NEAR(f, u, 1e-6);
    ASSERT_FLOAT_EQ(s.pdf, d.pdf(s.x));
    ASSERT_FLOAT_EQ(s.pdf, weights[s.cell] * 6 / 4);
  }
}

TEST(PiecewiseConstant, UniformWhereAllWeightsAreZero) {
  PiecewiseConstant1D d(std::vector<float>{0, 0, 0, 0});
  EXPECT_EQ(d.integral(), 0);
  EXPECT_NEAR(d.sample(0.3f).x, 0.3f, 1e-6f);
  EXPECT_FLOAT_EQ(d.sample(0.3f).pdf, 1);
}

TEST(PiecewiseConstant, RoundingKeepsToTheCell) {
  for (std::size_t n : {3u, 7u, 100u, 1001u, 4096u}) {
    std::vector<float> weights(n);
    for (std::size_t i = 0; i < n; i += 2) weights[i] = 1;
    PiecewiseConstant1D d(weights);
    // Either side of where one cell ends and the next begins.
    const std::size_t filled = (n + 1) / 2;
    for (std::size_t i = 0; i <= n / 2; ++i) {
      float u = static_cast<float>(i) / static_cast<float>(filled);
      for (float v : {u, std::nextafter(u, 0.0f), std::nextafter(u, 1.0f)}) {
        PiecewiseConstant1D::Sample s = d.sample(std::min(v, kOneMinusEpsilon));
        ASSERT_EQ(s.cell % 2, 0u);
        ASSERT_EQ(d.cell_of(s.x), s.cell);
        ASSERT_GT(d.pdf(s.x), 0);
      }
    }
  }
}

TEST(PiecewiseConstant, ZeroTailIsNeverDrawn) {
  // A distribution function that rounding may leave a little below 1 before the tail.
  std::vector<float> weights(1000, 0.1f);
  weights.resize(2000, 0.0f);
  PiecewiseConstant1D d(weights);
  EXPECT_LT(d.sample(kOneMinusEpsilon).cell, 1000u);
}

} // namespace
} // namespace candela::test
