// Noise in space: what is known of it at every seed, and its statistics over fresh ones.

#include "core/noise.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

class Places {
public:
  explicit Places(std::uint64_t stream) : random_(hash_combine(fresh_seed(), stream)) {}
  vec3 in_cube(float side) {
    std::uniform_real_distribution<float> coordinate(-0.5f * side, 0.5f * side);
    const float x = coordinate(random_), y = coordinate(random_);
    return {x, y, coordinate(random_)};
  }
  std::uint32_t seed() { return static_cast<std::uint32_t>(random_()); }

private:
  std::mt19937_64 random_;
};

TEST(SpaceNoise, IsZeroAtTheLatticeAndWithinBounds) {
  SCOPED_TRACE(seed_note());
  Places places(1);
  float most = 0;
  for (int i = 0; i < 300000; ++i) {
    const vec3 p = places.in_cube(1000);
    const std::uint32_t seed = places.seed();
    ASSERT_EQ(gradient_noise(glm::floor(p), seed), 0);
    const float n = gradient_noise(p, seed), middle = gradient_noise(glm::floor(p) + 0.5f, seed);
    most = std::max({most, std::abs(n), std::abs(middle)});
  }
  EXPECT_LE(most, 1 + 1e-6f);
  EXPECT_GT(most, 0.75f) << "the range is used";
  EXPECT_EQ(gradient_noise(vec3(1e30f, 0, 0), 1), 0);
  EXPECT_EQ(gradient_noise(vec3(0, std::nanf(""), 0), 1), 0);
}

TEST(SpaceNoise, ItsSlopeIsItsDerivative) {
  SCOPED_TRACE(seed_note());
  Places places(2);
  for (int i = 0; i < 20000; ++i) {
    const vec3 p = places.in_cube(8);
    const std::uint32_t seed = places.seed();
    const NoiseSlope n = gradient_noise_slope(p, seed);
    for (int a = 0; a < 3; ++a) {
      vec3 step(0);
      step[a] = 1.0f / 256;
      const float difference = (gradient_noise(p + step, seed) - gradient_noise(p - step, seed)) * 128;
      ASSERT_NEAR(n.slope[a], difference, 2e-3f) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(SpaceNoise, CurlsHaveNoSources) {
  SCOPED_TRACE(seed_note());
  Places places(3);
  double size = 0;
  constexpr int kPlaces = 5000;
  for (int i = 0; i < kPlaces; ++i) {
    vec3 p = places.in_cube(8);
    p = glm::floor(p) + 0.02f + 0.96f * glm::fract(p); // at faces of cells third derivatives jump
    const std::uint32_t seed = places.seed();
    float divergence = 0;
    for (int a = 0; a < 3; ++a) {
      vec3 step(0);
      step[a] = 1.0f / 256;
      divergence += (curl_noise(p + step, seed)[a] - curl_noise(p - step, seed)[a]) * 128;
    }
    ASSERT_NEAR(divergence, 0, 0.02f);
    size += static_cast<double>(glm::length(curl_noise(p, seed))) / kPlaces;
  }
  EXPECT_GT(size, 0.5);
}

TEST(SpaceNoise, DistancesAreThoseToTheNearestPoint) {
  SCOPED_TRACE(seed_note());
  Places places(4);
  for (int i = 0; i < 3000; ++i) {
    const vec3 p = places.in_cube(50);
    const std::uint32_t seed = places.seed();
    const float d = nearest_point_distance(p, seed);
    ASSERT_GT(d, 0);
    ASSERT_LE(d, std::sqrt(3.0f));
    // No distance changes faster than the place: with searches that miss points it would.
    const vec3 q = p + 0.01f * places.in_cube(1);
    ASSERT_LE(std::abs(nearest_point_distance(q, seed) - d), glm::distance(p, q) + 1e-5f);
  }
}

TEST(SpaceNoiseStatistical, HasNoMeanAndNoTwoSeedsAreAlike) {
  SCOPED_TRACE(seed_note());
  Places places(5);
  RunningStatistics mean, octaves, product;
  for (int i = 0; i < 200000; ++i) {
    const vec3 p = places.in_cube(1e4f);
    const std::uint32_t seed = places.seed();
    const float a = gradient_noise(p, seed), b = gradient_noise(p, seed + 1);
    mean.add(static_cast<double>(a));
    octaves.add(static_cast<double>(noise_octaves(p, 4, seed)));
    product.add(static_cast<double>(a * b));
  }
  for (const RunningStatistics& statistics : {mean, octaves, product})
    EXPECT_GT(z_test(statistics, 0), sidak_threshold(3));
}

} // namespace
} // namespace candela::test
