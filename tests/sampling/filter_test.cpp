#include "sampler_draws.h"
#include "sampling/filter.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <functional>

namespace candela::test {
namespace {

constexpr FilterType kFilters[] = {FilterType::box, FilterType::tent, FilterType::gaussian,
                                   FilterType::blackman_harris, FilterType::mitchell};
constexpr int kFilterCount = static_cast<int>(std::size(kFilters));

/// Integral of g over [a, b] by Simpson's rule.
double integrate(const std::function<double(double)>& g, double a, double b, int steps = 2000) {
  double h = (b - a) / steps, sum = g(a) + g(b);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * g(a + i * h);
  return sum * h / 3;
}

TEST(Filter, ValuesAreThoseOfTheirFormulas) {
  for (FilterType type : kFilters) {
    EXPECT_EQ(filter_value(type, 1.001), 0);
    for (double x : {0.0, 0.2, 0.5, 0.77, 1.0}) EXPECT_EQ(filter_value(type, x), filter_value(type, -x));
    auto f = [&](double x) { return filter_value(type, x); };
    double whole = 0; // the tent and the cubics in their pieces
    for (double a : {-1.0, -0.5, 0.0, 0.5}) whole += integrate(f, a, a + 0.5);
    EXPECT_NEAR(whole, filter_integral(type), 1e-10) << static_cast<int>(type);
  }
  EXPECT_EQ(filter_value(FilterType::tent, 0.25), 0.75);
  EXPECT_NEAR(filter_value(FilterType::gaussian, 1.0 / 3), std::exp(-0.5), 1e-15);
  for (double x : {0.0, 0.1, 0.45, 0.9, 1.0}) { // Harris' table counts from the edge
    double w = std::numbers::pi * (1 + x);
    EXPECT_NEAR(filter_value(FilterType::blackman_harris, x),
                0.35875 - 0.48829 * std::cos(w) + 0.14128 * std::cos(2 * w) - 0.01168 * std::cos(3 * w),
                1e-14);
  }
  // Mitchell & Netravali's family, eq. 8; its copies at whole steps sum to 1, and reproduce a line.
  const double B = 1.0 / 3, C = 1.0 / 3;
  auto mitchell = [&](double t) { return filter_value(FilterType::mitchell, t / 2); };
  for (double t = 0; t <= 2; t += 0.125) {
    double eq8 = t < 1 ? ((12 - 9 * B - 6 * C) * t * t * t + (-18 + 12 * B + 6 * C) * t * t + 6 - 2 * B) / 6
                       : ((-B - 6 * C) * t * t * t + (6 * B + 30 * C) * t * t + (-12 * B - 48 * C) * t +
                          8 * B + 24 * C) /
                             6;
    EXPECT_NEAR(mitchell(t), eq8, 1e-14) << t;
  }
  for (double t = 0; t < 1; t += 0.1) {
    double sum = 0, line = 0;
    for (int k = -2; k <= 2; ++k) {
      sum += mitchell(t - k);
      line += k * mitchell(t - k);
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(line, t, 1e-14);
  }
}

TEST(Filter, SamplesAreMonotonicAndWithinTheRadius) {
  for (FilterType type : kFilters) {
    for (float radius : {0.5f, 2.0f}) {
      PixelFilter filter(type, radius);
      float last = -radius, largest = 0;
      for (std::uint32_t i = 0; i < (1u << 24); i += 251) {
        FilterSample s = filter.sample(vec2(static_cast<float>(i) * 0x1p-24f, 0.5f));
        ASSERT_GE(s.offset.x, last);
        ASSERT_LE(s.offset.x, radius);
        ASSERT_TRUE(std::isfinite(s.weight));
        largest = std::max(largest, std::abs(s.weight));
        last = s.offset.x;
      }
      for (vec2 u : {vec2(0), vec2(kOneMinusEpsilon), vec2(0, kOneMinusEpsilon)}) {
        FilterSample s = filter.sample(u);
        ASSERT_TRUE(std::isfinite(s.weight) && std::abs(s.offset.x) <= radius &&
                    std::abs(s.offset.y) <= radius);
      }
      EXPECT_GT(largest, type == FilterType::mitchell ? 1.144f : 0.999f);
      EXPECT_LT(largest, type == FilterType::mitchell ? 1.2f : 1.005f) << static_cast<int>(type);
    }
  }
}

TEST(Filter, InversionIsExactWhereThereIsNoTable) {
  for (FilterType type : {FilterType::box, FilterType::tent, FilterType::gaussian}) {
    PixelFilter filter(type, 1);
    for (float u = 0.01f; u < 1; u += 0.033f) {
      FilterSample s = filter.sample({0.5f, u});
      EXPECT_EQ(s.weight, 1);
      auto f = [&](double x) { return filter_value(type, x); };
      double y = static_cast<double>(s.offset.y);
      double share = integrate(f, -1, std::min(y, 0.0)) + (y > 0 ? integrate(f, 0, y) : 0);
      EXPECT_NEAR(share / filter_integral(type), static_cast<double>(u), 2e-6) << static_cast<int>(type);
    }
  }
}

/// Where the samples fall: |f|, in two dimensions. The table's error is too small to be seen.
TEST(FilterStatistical, OffsetsFollowTheFilter) {
  SCOPED_TRACE(seed_note());
  constexpr std::size_t kCells = 24;
  constexpr int kDraws = 200000;
  for (FilterType type : kFilters) {
    constexpr float kRadius = 1.7f;
    PixelFilter filter(type, kRadius);
    std::array<double, kCells> axis{};
    double total = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
      double a = 2.0 * double(i) / kCells - 1;
      axis[i] = integrate([&](double x) { return std::abs(filter_value(type, x)); }, a, a + 2.0 / kCells);
      total += axis[i];
    }
    std::vector<double> observed(kCells * kCells), expected;
    for (double y : axis)
      for (double x : axis) expected.push_back(kDraws * x * y / (total * total));
    Sampler sampler(SamplerType::independent, fresh_seed());
    for (std::uint32_t i = 0; i < kDraws; ++i) {
      sampler.start({0, 0}, i);
      FilterSample s = filter.sample(sampler.get_2d(Dimension::film));
      auto cell = [&](float offset) {
        return std::min(static_cast<std::size_t>((offset / kRadius + 1) * 0.5f * kCells), kCells - 1);
      };
      observed[cell(s.offset.y) * kCells + cell(s.offset.x)] += 1;
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(kFilterCount))
        << static_cast<int>(type);
  }
}

/// Weighted means are integrals with f / (integral of f): of 1, of the moments, and of the share of each cell
/// (negative where f is).
TEST(FilterStatistical, WeightedMeansAreIntegralsWithTheFilter) {
  SCOPED_TRACE(seed_note());
  using Function = std::function<double(double)>;
  std::vector<Function> functions = {[](double) { return 1.0; }, [](double x) { return x; },
                                     [](double x) { return x * x; }, [](double x) { return x * x * x * x; },
                                     [](double x) { return std::cos(3 * x); }};
  for (int i = 0; i < 8; ++i)
    functions.emplace_back([=](double x) { return std::floor((x + 1) * 4) == i ? 1.0 : 0.0; });
  const int tests = kFilterCount * static_cast<int>(functions.size() + 1);
  for (FilterType type : kFilters) {
    constexpr float kRadius = 2;
    PixelFilter filter(type, kRadius);
    std::vector<RunningStatistics> means(functions.size());
    RunningStatistics cross; // the axes are independent
    Sampler sampler(SamplerType::independent, fresh_seed() + 1);
    for (std::uint32_t i = 0; i < 400000; ++i) {
      sampler.start({0, 0}, i);
      FilterSample s = filter.sample(sampler.get_2d(Dimension::film));
      double weight = static_cast<double>(s.weight);
      double x = static_cast<double>(s.offset.x / kRadius), y = static_cast<double>(s.offset.y / kRadius);
      for (std::size_t k = 0; k < functions.size(); ++k)
        means[k].add(weight * functions[k](k % 2 == 0 ? x : y));
      cross.add(weight * x * y);
    }
    for (std::size_t k = 0; k < functions.size(); ++k) {
      double exact = 0; // in the cells' pieces; the ends of a cell belong to one of two, hence the midpoints
      for (int c = 0; c < 8; ++c) {
        for (int j = 0; j < 2000; ++j) {
          double x = (c + (j + 0.5) / 2000) / 4 - 1;
          exact += functions[k](x) * filter_value(type, x) / 8000 / filter_integral(type);
        }
      }
      EXPECT_GT(z_test(means[k], exact, 1e-6), sidak_threshold(tests))
          << static_cast<int>(type) << ' ' << k << ' ' << means[k].mean() << ' ' << exact;
    }
    EXPECT_GT(z_test(cross, 0, 1e-7), sidak_threshold(tests)) << static_cast<int>(type);
  }
}

} // namespace
} // namespace candela::test
