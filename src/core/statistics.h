#pragma once
// Moments of values as they come, and Pearson's chi-square test.

#include <cmath>
#include <cstddef>
#include <span>

namespace candela {

/// Regularised incomplete gamma functions P(a, x) and Q(a, x) = 1 - P for a > 0, x >= 0: the power series
/// below x = a + 1, Lentz's continued fraction above (DLMF 8.11.4, 8.9.2).
double regularized_gamma_p(double a, double x);
double regularized_gamma_q(double a, double x);

/// P(X >= statistic) for X of a chi-square distribution.
double chi_square_p_value(double statistic, double degrees_of_freedom);

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

/// The value below which `percent` of 0..100 of the values lie, linear between the two nearest (R's type 7,
/// Hyndman and Fan 1996); 0 of no values.
double percentile(std::span<const double> values, double percent);

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

} // namespace candela
