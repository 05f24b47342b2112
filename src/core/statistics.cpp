#include "core/statistics.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace candela {

namespace {

/// x^a e^-x / Gamma(a)
double gamma_prefix(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

double gamma_p_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (double n = a + 1; term > sum * std::numeric_limits<double>::epsilon(); n += 1) {
    term *= x / n;
    sum += term;
  }
  return sum * gamma_prefix(a, x);
}

double gamma_q_continued_fraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, h = d;
  for (int i = 1; i < 100000; ++i) {
    double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1 / d;
    double factor = c * d;
    h *= factor;
    if (std::abs(factor - 1) < 4 * std::numeric_limits<double>::epsilon()) break;
  }
  return h * gamma_prefix(a, x);
}

} // namespace

double regularized_gamma_p(double a, double x) {
  if (x <= 0) return 0;
  return x < a + 1 ? gamma_p_series(a, x) : 1 - gamma_q_continued_fraction(a, x);
}

double regularized_gamma_q(double a, double x) {
  if (x <= 0) return 1;
  return x < a + 1 ? 1 - gamma_p_series(a, x) : gamma_q_continued_fraction(a, x);
}

double chi_square_p_value(double statistic, double degrees_of_freedom) {
  return regularized_gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected,
                                double min_expected) {
  if (observed.size() != expected.size()) throw std::invalid_argument("as many counts as expectations");
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return expected[i]; });

  struct Group {
    double observed = 0, expected = 0;
  };
  std::vector<Group> groups;
  Group open;
  for (std::size_t i : order) {
    if (std::isnan(expected[i]) || (expected[i] <= 0 && observed[i] > 0)) return {0, 0, 0};
    open.observed += observed[i];
    open.expected += std::max(expected[i], 0.0);
    if (open.expected >= min_expected) {
      groups.push_back(open);
      open = {};
    }
  }
  if (!groups.empty()) { // too little for a group of its own
    groups.back().observed += open.observed;
    groups.back().expected += open.expected;
  }
  ChiSquareResult result;
  if (groups.size() < 2) return result;
  for (const Group& g : groups)
    result.statistic += (g.observed - g.expected) * (g.observed - g.expected) / g.expected;
  result.degrees_of_freedom = static_cast<double>(groups.size() - 1);
  result.p_value = chi_square_p_value(result.statistic, result.degrees_of_freedom);
  return result;
}

double percentile(std::span<const double> values, double percent) {
  if (values.empty()) return 0;
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const double at = std::clamp(percent, 0.0, 100.0) / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at), above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - std::floor(at)) * (sorted[above] - sorted[below]);
}

} // namespace candela
