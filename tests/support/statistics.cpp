#include "support/statistics.h"

namespace candela::test {

namespace {

double z_p_value(double difference, double variance, double rounding) {
  double excess = std::abs(difference) - rounding;
  if (std::isnan(excess)) return 0;
  if (excess <= 0) return 1;
  return variance > 0 ? normal_p_value(excess / std::sqrt(variance)) : 0;
}

} // namespace

double sidak_threshold(int tests, double family) { return -std::expm1(std::log1p(-family) / tests); }

double normal_p_value(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double z_test(const RunningStatistics& sample, double expected, double rounding) {
  return z_p_value(sample.mean() - expected, sample.variance_of_mean(), rounding);
}

double z_test(const RunningStatistics& a, const RunningStatistics& b, double rounding) {
  return z_p_value(a.mean() - b.mean(), a.variance_of_mean() + b.variance_of_mean(), rounding);
}

} // namespace candela::test
