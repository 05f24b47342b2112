// Stratification of samplers for every seed: one point in each box.

#include "sampler_draws.h"

#include <gtest/gtest.h>

#include <set>

namespace candela::test {
namespace {

TEST(Stratification, RunsAreNetsInEveryPixelAndDimension) {
  for (SamplerType type : kNetSamplers) {
    for (std::uint32_t pixel = 0; pixel < 6; ++pixel) {
      Sampler sampler(type, pixel / 4);
      for (std::uint32_t d = 0; d < kDimensions; ++d) {
        for (std::uint32_t index : {0u, 3u}) {
          for (int m = 0; m <= 9; ++m) {
            for (std::uint32_t run : {0u, 1u, 2u, 1000u}) {
              std::vector<vec2> points;
              for (std::uint32_t i = 0; i < (1u << m); ++i)
                points.push_back(draw(sampler, {{pixel, 5}, (run << m) + i, pixel % 3, dimension(d), index}));
              ASSERT_TRUE(is_net(points, m))
                  << static_cast<int>(type) << ' ' << pixel << ' ' << d << ' ' << m << ' ' << run;
            }
          }
        }
      }
    }
  }
}

TEST(Stratification, TheNetTestSeesABrokenNet) {
  Sampler sampler(SamplerType::sobol, 1);
  std::vector<vec2> points;
  for (std::uint32_t i = 0; i < 256; ++i) points.push_back(draw(sampler, {{0, 0}, i, 0, Dimension::film, 0}));
  ASSERT_TRUE(is_net(points, 8));
  std::swap(points[3].x, points[4].x);
  EXPECT_FALSE(is_net(points, 8));
}

/// One per box of 1/columns x 1/rows. The numbers are rounded down to multiples of 2^-24.
void expect_one_per_box(const std::vector<vec2>& points, std::size_t columns, std::size_t rows) {
  std::vector<bool> taken(points.size());
  ASSERT_EQ(points.size(), columns * rows);
  for (vec2 p : points) {
    auto cell = [](float x, std::size_t n) {
      return static_cast<std::size_t>((double(x) + 0x1p-25) * double(n));
    };
    std::size_t box = cell(p.y, rows) * columns + cell(p.x, columns);
    ASSERT_FALSE(taken[box]) << columns << ' ' << rows;
    taken[box] = true;
  }
}

TEST(Stratification, HaltonRunsHaveOneInEachBoxOfBothBases) {
  for (std::uint32_t pixel = 0; pixel < 10; ++pixel) {
    Sampler sampler(SamplerType::halton, pixel / 3);
    std::uint32_t columns = 1, rows = 1;
    for (int k = 0; k < 8; ++k) {
      for (std::uint32_t run : {0u, 1u, 2u, 7u, 1000u}) {
        std::vector<vec2> points;
        for (std::uint32_t i = 0; i < columns * rows; ++i)
          points.push_back(draw(
              sampler,
              {{pixel, 5}, run * columns * rows + i, pixel % 3, dimension(pixel % kDimensions), pixel % 2}));
        expect_one_per_box(points, columns, rows);
      }
      (k % 2 == 0 ? columns *= 2 : rows *= 3);
    }
  }
}

/// The differences between points of a run are those of the lattice: a multiple of (1, a) / 2^m mod 1.
TEST(Stratification, LatticeRunsAreMovedLattices) {
  for (std::uint32_t pixel = 0; pixel < 10; ++pixel) {
    Sampler sampler(SamplerType::lattice, pixel / 3);
    for (int m = 0; m <= 9; ++m) {
      for (std::uint32_t run : {0u, 1u, 6u, 1000u}) {
        std::uint32_t n = 1u << m;
        std::vector<bool> taken(n);
        vec2 origin(0);
        for (std::uint32_t i = 0; i < n; ++i) {
          vec2 p = draw(sampler, {{pixel, 5}, run * n + i, pixel % 3, dimension(pixel % kDimensions), 0});
          if (i == 0) origin = p;
          double dx = double(p.x) - double(origin.x), dy = double(p.y) - double(origin.y);
          auto k = static_cast<std::int64_t>(std::llround(dx * n));
          ASSERT_LT(std::abs(dx * n - double(k)), 1e-3);
          double y = double(k) * double(kLatticeGenerator % n) - dy * n; // a multiple of n
          ASSERT_LT(std::abs(y / n - std::round(y / n)), 1e-3 / n) << m << ' ' << run;
          auto place = static_cast<std::size_t>(k + n) % n;
          ASSERT_FALSE(taken[place]);
          taken[place] = true;
        }
      }
    }
  }
}

/// The points of `samples` samples of an aligned square of pixels.
std::vector<vec2> square_of_pixels(Sampler& sampler, uvec2 corner, std::uint32_t side, std::uint32_t samples,
                                   std::uint32_t d) {
  std::vector<vec2> points;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      for (std::uint32_t i = 0; i < samples; ++i)
        points.push_back(draw(sampler, {corner + uvec2(x, y), i, d % 3, dimension(d), d % 2}));
  return points;
}

TEST(Stratification, NeighboursOfBlueNoiseFillEachOthersGaps) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Sampler sampler(SamplerType::blue_noise, seed);
    for (std::uint32_t d = 0; d < kDimensions; ++d) {
      for (int k = 0; k <= 4; ++k) {
        std::uint32_t side = 1u << k;
        uvec2 corner(side * 7, side * 5);
        // One sample a pixel: a net in both coordinates.
        ASSERT_TRUE(is_net(square_of_pixels(sampler, corner, side, 1, d), 2 * k)) << d << ' ' << k;
        // Any power of two: a net in each.
        for (int log_samples = 1; log_samples <= 5; ++log_samples) {
          auto points = square_of_pixels(sampler, corner, side, 1u << log_samples, d);
          auto columns = points, rows = points;
          for (std::size_t i = 0; i < points.size(); ++i) columns[i].y = rows[i].x = 0;
          expect_one_per_box(columns, points.size(), 1);
          expect_one_per_box(rows, 1, points.size());
        }
      }
    }
  }
}

TEST(Stratification, StratifiedBlocksFillEveryCellOnce) {
  for (std::uint32_t strata : {1u, 2u, 3u, 4u, 5u, 8u, 13u}) {
    std::uint32_t cells = strata * strata;
    Sampler sampler(SamplerType::stratified, 3, static_cast<int>(strata));
    std::set<std::vector<std::uint32_t>> orders;
    for (std::uint32_t block = 0; block < 20; ++block) {
      std::vector<std::uint32_t> order;
      std::vector<float> line;
      for (std::uint32_t i = 0; i < cells; ++i) {
        vec2 p =
            draw(sampler,
                 {{block / 4, 7}, block * cells + i, block % 2, dimension(block % kDimensions), block % 3});
        line.push_back(sampler.get_1d(Dimension::russian_roulette));
        // Half a step of the 24-bit grid: a cell's first values may be rounded down to below its edge.
        auto cell = [&](float x) { return static_cast<std::uint32_t>((double(x) + 0x1p-25) * strata); };
        order.push_back(cell(p.y) * strata + cell(p.x));
      }
      orders.insert(order);
      std::ranges::sort(order);
      for (std::uint32_t i = 0; i < cells; ++i) ASSERT_EQ(order[i], i) << strata << ' ' << block;
      std::ranges::sort(line);
      for (std::uint32_t i = 0; i < cells; ++i) {
        ASSERT_GE(double(line[i]), double(i) / cells - 0x1p-24);
        ASSERT_LT(double(line[i]), double(i + 1) / cells);
      }
    }
    if (strata > 3) { EXPECT_EQ(orders.size(), 20u); } // each block has an order of its own
  }
}

} // namespace
} // namespace candela::test
