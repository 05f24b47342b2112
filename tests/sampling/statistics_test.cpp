// Tests of support/statistics.h with correct and with wrong data.

#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace candela::test {
namespace {

TEST(Statistics, IncompleteGammaHasItsClosedForms) {
  for (double x : {1e-6, 0.1, 0.9, 1.0, 2.0, 2.1, 7.0, 30.0, 200.0}) {
    EXPECT_NEAR(regularized_gamma_q(1, x), std::exp(-x), 1e-14) << x;
    EXPECT_NEAR(regularized_gamma_p(0.5, x), std::erf(std::sqrt(x)), 1e-13) << x;
    // Q(n, x) is the chance of fewer than n events of a Poisson process that expects x.
    double term = std::exp(-x), sum = 0;
    for (int n = 1; n <= 60; ++n) {
      sum += term;
      term *= x / n;
      EXPECT_NEAR(regularized_gamma_q(n, x), sum, 1e-12) << n << ' ' << x;
    }
  }
  // Far tails keep their relative accuracy.
  EXPECT_NEAR(regularized_gamma_q(1, 300) / std::exp(-300.0), 1, 1e-10);
}

TEST(Statistics, TabulatedQuantiles) {
  EXPECT_NEAR(chi_square_p_value(3.841458820694124, 1), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_p_value(18.307038053275146, 10), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_p_value(149.4492527706, 100), 0.001, 1e-9);
  EXPECT_NEAR(normal_p_value(1.959963984540054), 0.05, 1e-12);
  EXPECT_NEAR(normal_p_value(-5), 5.733031437583892e-07, 1e-17);
}

TEST(Statistics, SidakThreshold) {
  EXPECT_NEAR(sidak_threshold(1, 0.01), 0.01, 1e-15);
  EXPECT_NEAR(1 - std::pow(1 - sidak_threshold(50, 0.01), 50), 0.01, 1e-14);
  EXPECT_NEAR(sidak_threshold(1000, 1e-6), 1e-9, 1e-14);
}

TEST(Statistics, ChiSquarePoolsSmallBins) {
  std::vector<double> observed = {1, 2, 0, 3, 50, 44}, expected = {2, 2, 1, 3, 46, 46};
  ChiSquareResult r = chi_square_test(observed, expected);
  // {1, 2, 2} make a group of 5; the 3 left over goes with what follows, a 46.
  EXPECT_EQ(r.degrees_of_freedom, 2);
  EXPECT_NEAR(r.statistic, 4.0 / 5 + 16.0 / 49 + 4.0 / 46, 1e-12);
  EXPECT_EQ(chi_square_test(std::vector<double>{1, 2}, std::vector<double>{1.5, 1.5}).p_value, 1);
  EXPECT_EQ(chi_square_test(std::vector<double>{1, 99}, std::vector<double>{0, 100}).p_value, 0);
}

TEST(Statistics, RunningStatisticsMatchesTheDefinition) {
  RunningStatistics s;
  for (double x : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}) s.add(x);
  EXPECT_DOUBLE_EQ(s.mean(), 1e9 + 10);
  EXPECT_DOUBLE_EQ(s.variance(), 30);
  EXPECT_DOUBLE_EQ(s.variance_of_mean(), 7.5);
}

TEST(Statistics, WithoutVarianceMeansMustAgree) {
  RunningStatistics s;
  for (int i = 0; i < 10; ++i) s.add(0.25);
  EXPECT_EQ(z_test(s, 0.25), 1);
  EXPECT_EQ(z_test(s, 0.250001), 0);
  EXPECT_EQ(z_test(s, 0.250001, 1e-5), 1);
  EXPECT_EQ(z_test(s, std::nan("")), 0);
}

/// p-values of right data are uniform: of tests with unequal bins, some of which are pooled.
TEST(StatisticsStatistical, PValuesAreUniformUnderTheNull) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed() + 1);
  std::vector<double> probability;
  for (int i = 1; i <= 40; ++i) probability.push_back(i < 4 ? 1e-4 : i / 820.0);
  double total = 0;
  for (double p : probability) total += p;
  for (double& p : probability) p /= total;
  std::discrete_distribution<std::size_t> bin(probability.begin(), probability.end());
  std::normal_distribution<double> normal;

  constexpr int kTests = 4000, kDraws = 4000, kCells = 20;
  std::vector<double> chi_square_cells(kCells), z_cells(kCells), cells(kCells, double(kTests) / kCells);
  auto cell = [](double p) {
    return std::min(static_cast<std::size_t>(p * kCells), std::size_t{kCells - 1});
  };
  for (int test = 0; test < kTests; ++test) {
    std::vector<double> observed(probability.size()), expected(probability.size());
    for (int i = 0; i < kDraws; ++i) observed[bin(random)] += 1;
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = probability[i] * kDraws;
    chi_square_cells[cell(chi_square_test(observed, expected).p_value)] += 1;
    RunningStatistics sample;
    for (int i = 0; i < 1000; ++i) sample.add(3 + 2 * normal(random));
    z_cells[cell(z_test(sample, 3))] += 1;
  }
  EXPECT_GT(chi_square_test(chi_square_cells, cells).p_value, sidak_threshold(2));
  EXPECT_GT(chi_square_test(z_cells, cells).p_value, sidak_threshold(2));
}

TEST(StatisticsStatistical, OnePercentOfBiasIsSeen) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed() + 2);
  std::uniform_real_distribution<double> uniform;
  // One half of the bins gets 1 % more than its share.
  constexpr int kBins = 64, kDraws = 4000000;
  std::vector<double> observed(kBins), expected(kBins, double(kDraws) / kBins);
  RunningStatistics sample;
  for (int i = 0; i < kDraws; ++i) {
    bool upper = uniform(random) < 0.5 * 1.01;
    double x = 0.5 * uniform(random) + (upper ? 0.5 : 0);
    observed[static_cast<std::size_t>(x * kBins)] += 1;
    if (i < kDraws / 4) sample.add(1.01 * uniform(random));
  }
  EXPECT_LT(chi_square_test(observed, expected).p_value, kFalseAlarm);
  EXPECT_LT(z_test(sample, 0.5), kFalseAlarm);
}

TEST(Percentile, IsLinearBetweenTheNearestValues) {
  const double values[] = {40, 10, 30, 20};
  EXPECT_DOUBLE_EQ(percentile(values, 0), 10);
  EXPECT_DOUBLE_EQ(percentile(values, 50), 25);
  EXPECT_DOUBLE_EQ(percentile(values, 90), 37);
  EXPECT_DOUBLE_EQ(percentile(values, 100), 40);
  const double one[] = {3};
  EXPECT_DOUBLE_EQ(percentile(one, 99), 3);
  EXPECT_DOUBLE_EQ(percentile({}, 50), 0);
}

} // namespace
} // namespace candela::test
