#pragma once
// Hypothesis tests. Each gives a p-value: the chance, if all is right, of data at least as odd as these. A
// test fails where it is below a threshold that leaves kFalseAlarm for the whole TEST(); with some hundred
// statistical TESTs, one run in ten thousand fails without a cause.

#include <cmath>
#include <cstddef>
#include <span>

namespace candela::test {

/// Chance that one TEST() fails although all is right.
inline constexpr double kFalseAlarm = 1e-6;

/// Threshold for each of `tests` p-values, so that one or more fall below it with probability `family` (Šidák
/// 1967: exact if independent, on the safe side otherwise for the statistics here).
double sidak_threshold(int tests, double family = kFalseAlarm);

/// Regularised incomplete gamma functions P(a, x) and Q(a, x) = 1 - P for a > 0, x >= 0: the power series
/// below x = a + 1, Lentz's continued fraction above (DLMF 8.11.4, 8.9.2).
double regularized_gamma_p(double a, double x);
double regularized_gamma_q(double a, double x);

/// P(X >= statistic) for X of a chi-square distribution.
double chi_square_p_value(double statistic, double degrees_of_freedom);
/// P(|X| >= |z|) for X of the standard normal distribution.
double normal_p_value(double z);

struct ChiSquareResult {
  double statistic = 0;
  double degrees_of_freedom = 0; ///< bins after pooling, less one
  double p_value = 1;
};

/// Pearson's test of counts against expected counts of the same total. Bins that expect fewer than
/// `min_expected` are pooled, smallest first, until each group expects enough. A count where nothing is
/// expected (0 or less, as quadrature may say) gives p = 0. Fewer than two groups: no test, p = 1.
ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected,
                                double min_expected = 5);

/// Mean and variance of values as they come (Welford 1962).
class RunningStatistics {
public:
  void add(double x) {
    ++count_;
    double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    m2_ += delta * (x - mean_);
  }
  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased, of the values.
  double variance() const { return count_ > 1 ? m2_ / static_cast<double>(count_ - 1) : 0; }
  double variance_of_mean() const { return count_ > 0 ? variance() / static_cast<double>(count_) : 0; }

private:
  std::size_t count_ = 0;
  double mean_ = 0, m2_ = 0;
};

/// p-value of a sample mean against a known one; many independent values of finite variance are assumed.
/// `rounding` is the error that both may have without being wrong: without any variance the means must agree
/// to within it.
double z_test(const RunningStatistics& sample, double expected, double rounding = 0);
/// Of two sample means being equal.
double z_test(const RunningStatistics& a, const RunningStatistics& b, double rounding = 0);

} // namespace candela::test
