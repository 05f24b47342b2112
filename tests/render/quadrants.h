#pragma once
// Estimates of an image's expectation: means of its quadrants with their variances.

#include "render/render_testing.h"

#include <array>

namespace candela::test {

inline constexpr int kBlocks = 4, kValues = 3 * kBlocks;

struct Estimate {
  std::array<double, kValues> mean{}, variance{};
};

/// Means of the four quadrants. The variance is that of independent samples; the better spread ones of the
/// other samplers have no more, so that a test by it is on the safe side.
inline Estimate estimate(const Film& film) {
  Estimate e;
  int w = film.width() / 2, h = film.height() / 2;
  double n = w * h;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        auto i = static_cast<std::size_t>(3 * (y / h * 2 + x / w) + c);
        e.mean[i] += static_cast<double>(film.mean(x, y)[c]) / n;
        e.variance[i] += static_cast<double>(film.variance_of_mean(x, y)[c]) / (n * n);
      }
  return e;
}

/// The two agree, with one false alarm in a million over `settings` such comparisons.
inline void expect_same(const Estimate& a, const Estimate& b, int settings) {
  for (std::size_t i = 0; i < kValues; ++i) {
    // Where there is no variance, rounding is left.
    double rounding = 1e-6 * std::abs(a.mean[i]) + 1e-30;
    double sigma = std::sqrt(a.variance[i] + b.variance[i] + rounding * rounding);
    EXPECT_GT(normal_p_value((a.mean[i] - b.mean[i]) / sigma), sidak_threshold(settings * kValues))
        << "block " << i / 3 << ", channel " << i % 3 << ": " << a.mean[i] << " against " << b.mean[i]
        << " +- " << sigma << "; " << seed_note();
  }
}

} // namespace candela::test
