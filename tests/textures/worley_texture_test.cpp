// Cells: distances against a search over all points, and their statistics over fresh seeds.

#include "support/patterns.h"
#include "support/statistics.h"
#include "textures/worley_texture.h"

namespace candela {
namespace {

using test::Random;
using enum WorleyDistance;

WorleyTexture worley(WorleyDistance distance, float jitter = 1, int seed = 3) {
  WorleyTexture t;
  t.distance = distance, t.jitter = jitter, t.seed = seed, t.frequency = 1;
  return t;
}

TEST(WorleyTexture, IsAPattern) {
  for (WorleyDistance distance : {first, second_minus_first})
    for (float jitter : {0.0f, 1.0f}) test::expect_pattern(worley(distance, jitter));
}

/// All points of 11 x 11 cells, in double.
glm::dvec2 reference_distances(glm::dvec2 p, double jitter, std::uint32_t seed) {
  std::vector<double> all;
  for (int j = -5; j <= 5; ++j)
    for (int i = -5; i <= 5; ++i) {
      const auto x = static_cast<std::int32_t>(std::floor(p.x)) + i,
                 y = static_cast<std::int32_t>(std::floor(p.y)) + j;
      const std::uint32_t h =
          hash32(static_cast<std::uint32_t>(x) + hash32(static_cast<std::uint32_t>(y) + seed));
      const glm::dvec2 random(to_unit_float(h), to_unit_float(hash32(h)));
      all.push_back(glm::length(glm::dvec2(x, y) + 0.5 + jitter * (random - 0.5) - p));
    }
  std::ranges::sort(all);
  return {all[0], all[1]};
}

TEST(CellDistances, AreThoseOfTheNearestTwoOfAllPoints) {
  SCOPED_TRACE(test::seed_note());
  Random random(13);
  float largest = 0;
  for (int i = 0; i < 200000; ++i) {
    const vec2 p = random.in_square(1000);
    const float jitter = i % 4 == 0 ? random() : 1;
    const auto seed = static_cast<std::uint32_t>(random.integer());
    const CellDistances d = cell_distances(p, jitter, seed);
    const glm::dvec2 expected = reference_distances(glm::dvec2(p), jitter, seed);
    ASSERT_NEAR(d.first, expected.x, 1e-4);
    ASSERT_NEAR(d.second, expected.y, 1e-4);
    largest = std::max(largest, d.second);
  }
  EXPECT_GT(largest, 1.3f) << "the far cells were needed";
}

TEST(CellDistances, OfARegularGrid) {
  auto at = [](vec2 p) { return cell_distances(p, 0, 1); };
  EXPECT_EQ(at({0.5f, 0.5f}).first, 0);
  EXPECT_EQ(at({-3.5f, 7.5f}).first, 0);
  EXPECT_EQ(at({0.5f, 0.5f}).second, 1);
  EXPECT_FLOAT_EQ(at({0, 0}).first, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(at({0, 0}).second, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(at({0.75f, 0.5f}).first, 0.25f);
  EXPECT_FLOAT_EQ(at({0.75f, 0.5f}).second, 0.75f);
  EXPECT_EQ(worley(second_minus_first, 0).share({}, {5, 0.3f}), 0) << "a border";
  EXPECT_EQ(worley(second_minus_first, 0).share({}, {5.5f, 0.5f}), 1) << "a point";
}

TEST(WorleyTexture, IsContinuousWithKnownSlopes) {
  SCOPED_TRACE(test::seed_note());
  Random random(14);
  for (int i = 0; i < 100000; ++i) {
    const auto seed = static_cast<std::uint32_t>(random.integer());
    const vec2 p = random.in_square(30);
    const vec2 q = p + random.in_square(i % 2 == 0 ? 0.01f : 1.0f);
    const float far = glm::length(q - p) + 1e-5f;
    const CellDistances a = cell_distances(p, 1, seed), b = cell_distances(q, 1, seed);
    ASSERT_LE(std::abs(a.first - b.first), far);
    ASSERT_LE(std::abs(a.second - b.second), far);
    ASSERT_LE(a.first, a.second);
  }
}

TEST(WorleyTexture, MeansAreKnownStatistical) {
  SCOPED_TRACE(test::seed_note());
  Random random(15);
  for (WorleyDistance distance : {first, second_minus_first})
    for (float jitter : {0.0f, 0.3f, 0.5f, 0.8f, 1.0f}) {
      RunningStatistics mean;
      for (int i = 0; i < 100000; ++i)
        mean.add(worley(distance, jitter, random.integer()).share({}, random.in_square(100)));
      EXPECT_GT(test::z_test(mean, worley(distance, jitter).mean(), 2e-3), test::sidak_threshold(10))
          << jitter << ' ' << mean.mean() << ' ' << worley(distance, jitter).mean();
    }
  // E of the distance in a square from its middle (Philip 2007, "The probability distribution of the distance
  // between two random points in a box", gives the integral).
  EXPECT_NEAR(worley(first, 0).mean(), (std::sqrt(2.0) + std::asinh(1.0)) / 6, 1e-4);
}

TEST(WorleyTexture, LooksTheSameAlongAllAxesStatistical) {
  SCOPED_TRACE(test::seed_note());
  Random random(16);
  RunningStatistics upright, slanted;
  const float h = 5e-3f;
  for (int i = 0; i < 200000; ++i) {
    const WorleyTexture t = worley(first, 1, random.integer());
    const vec2 p = random.in_square(1000);
    const double x = (t.share({}, p + vec2(h, 0)) - t.share({}, p)) / h;
    const double y = (t.share({}, p + vec2(0, h)) - t.share({}, p)) / h;
    upright.add(x * x - y * y);
    slanted.add(x * y);
  }
  const double threshold = test::sidak_threshold(2);
  EXPECT_GT(test::z_test(upright, 0), threshold);
  EXPECT_GT(test::z_test(slanted, 0, 3e-3), threshold);
}

TEST(WorleyTexture, DoesNotRepeatAndSeedsDiffer) {
  SCOPED_TRACE(test::seed_note());
  Random random(17);
  const int seed = random.integer();
  const WorleyTexture t = worley(first, 1, seed), same = worley(first, 1, seed),
                      other = worley(first, 1, seed + 1);
  double difference = 0, power = 0;
  auto compare = [&](double a, double b) {
    difference += (a - b) * (a - b);
    power += std::pow(a - t.mean(), 2) + std::pow(b - t.mean(), 2);
  };
  for (int period = 2; period <= 600; ++period)
    for (vec2 direction : {vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
      difference = power = 0;
      for (int i = 0; i < 400; ++i) {
        const vec2 p = random.in_square(500);
        compare(t.share({}, p), t.share({}, p + static_cast<float>(period) * direction));
      }
      EXPECT_GT(difference / power, 0.6) << period << ' ' << direction.x << direction.y;
    }
  difference = power = 0;
  for (int i = 0; i < 4000; ++i) {
    const vec2 p = random.in_square(500);
    EXPECT_EQ(t.share({}, p), same.share({}, p));
    compare(t.share({}, p), other.share({}, p));
  }
  EXPECT_GT(difference / power, 0.85);
}

TEST(WorleyTexture, SmallCellsGiveWayToTheirMean) {
  SCOPED_TRACE(test::seed_note());
  Random random(18);
  for (WorleyDistance distance : {first, second_minus_first}) {
    const WorleyTexture t = worley(distance, 1, random.integer());
    for (float width : {0.05f, 0.3f, 1.0f, 4.0f}) {
      double error = 0, aliasing = 0;
      for (int i = 0; i < 200; ++i) {
        const TexturePoint at(random.in_square(100), {{width, 0}, {0, width}});
        const double truth = test::sampled_share(t, {}, at, 24);
        error += std::pow(t.mean_share({}, at) - truth, 2) / 200;
        aliasing += std::pow(t.share({}, at.uv) - truth, 2) / 200;
      }
      EXPECT_LT(std::sqrt(error), 0.07) << width;
      if (width >= 1) { EXPECT_LT(error, 0.5 * aliasing) << width; }
    }
  }
}

} // namespace
} // namespace candela
