// Noise: what is known of it at every seed, and its statistics over fresh ones.

#include "support/patterns.h"
#include "support/statistics.h"
#include "textures/noise_texture.h"

namespace candela {
namespace {

using test::Random;
using enum NoiseType;

NoiseTexture noise(NoiseType type, int seed = 7) {
  NoiseTexture t;
  t.pattern = type, t.seed = seed, t.frequency = 1;
  return t;
}

TEST(NoiseTexture, IsAPattern) {
  for (NoiseType type : {perlin, fbm, turbulence})
    for (int octaves : {1, 16}) {
      NoiseTexture t = noise(type);
      t.octaves = octaves, t.lacunarity = 8, t.gain = 1;
      test::expect_pattern(t);
    }
}

/// Perlin 2002 in two dimensions, as textbooks have it.
double reference_noise(glm::dvec2 p, std::uint32_t seed) {
  const glm::dvec2 cell = glm::floor(p), f = p - cell;
  auto fade = [](double t) { return 6 * std::pow(t, 5) - 15 * std::pow(t, 4) + 10 * std::pow(t, 3); };
  double sum = 0;
  for (int j : {0, 1})
    for (int i : {0, 1}) {
      const auto x = static_cast<std::uint32_t>(static_cast<std::int64_t>(cell.x) + i);
      const auto y = static_cast<std::uint32_t>(static_cast<std::int64_t>(cell.y) + j);
      const double angle = 2 * std::numbers::pi * (hash32(x + hash32(y + seed)) >> 28) / 16.0;
      const double slope = std::cos(angle) * (f.x - i) + std::sin(angle) * (f.y - j);
      sum += (i == 1 ? fade(f.x) : fade(1 - f.x)) * (j == 1 ? fade(f.y) : fade(1 - f.y)) * slope;
    }
  return std::numbers::sqrt2 * sum;
}

TEST(GradientNoise, IsThatOfTheTextbook) {
  SCOPED_TRACE(test::seed_note());
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const vec2 p = random.in_square(2000);
    const auto seed = static_cast<std::uint32_t>(random.integer());
    ASSERT_NEAR(gradient_noise(p, seed), reference_noise(p, seed), 2e-6) << p.x << ' ' << p.y;
  }
}

TEST(GradientNoise, IsZeroAtTheLatticeAndWithinBounds) {
  SCOPED_TRACE(test::seed_note());
  Random random(6);
  float most = 0;
  for (int i = 0; i < 300000; ++i) {
    const auto seed = static_cast<std::uint32_t>(random.integer());
    const vec2 p = random.in_square(1000);
    ASSERT_EQ(gradient_noise(glm::floor(p), seed), 0);
    const float n = gradient_noise(p, seed), middle = gradient_noise(glm::floor(p) + 0.5f, seed);
    most = std::max({most, std::abs(n), std::abs(middle)});
  }
  EXPECT_LE(most, 1 + 1e-6f);
  EXPECT_GT(most, 0.99f) << "the range is used";
  NoiseTexture t = noise(perlin);
  for (vec2 uv : {vec2(0), vec2(3, -2), vec2(-100, 57)}) EXPECT_EQ(t.share({}, uv), 0.5f);
}

TEST(GradientNoise, IsSmooth) {
  SCOPED_TRACE(test::seed_note());
  Random random(7);
  const double h = 1e-3;
  for (int i = 0; i < 20000; ++i) {
    const auto seed = static_cast<std::uint32_t>(random.integer());
    const vec2 q = random.in_square(16);
    // Across a line of the lattice, and anywhere: slopes are bounded and change little.
    const glm::dvec2 p(i % 2 == 0 ? std::floor(q.x) : q.x, q.y);
    auto at = [&](double x, double y) {
      return static_cast<double>(gradient_noise(vec2(static_cast<float>(x), static_cast<float>(y)), seed));
    };
    const double left = (at(p.x, p.y) - at(p.x - h, p.y)) / h, right = (at(p.x + h, p.y) - at(p.x, p.y)) / h;
    const double up = (at(p.x, p.y + h) - at(p.x, p.y)) / h;
    EXPECT_LT(std::hypot(right, up), 4);
    EXPECT_NEAR(left, right, 0.05) << "no crease";
  }
}

TEST(GradientNoise, HasTheStatisticsOfItsKindStatistical) {
  SCOPED_TRACE(test::seed_note());
  Random random(8);
  RunningStatistics mean, square, crease, tensor, crossed;
  const float h = 1e-2f;
  for (int i = 0; i < 400000; ++i) {
    const auto seed = static_cast<std::uint32_t>(random.integer()); // each from a pattern of its own
    const vec2 p = random.in_square(1000);
    const double n = gradient_noise(p, seed);
    mean.add(n);
    square.add(n * n);
    crease.add(std::abs(n));
    const double x = (gradient_noise(p + vec2(h, 0), seed) - gradient_noise(p - vec2(h, 0), seed)) / (2 * h);
    const double y = (gradient_noise(p + vec2(0, h), seed) - gradient_noise(p - vec2(0, h), seed)) / (2 * h);
    tensor.add(x * x - y * y);
    crossed.add(x * y);
  }
  const double threshold = test::sidak_threshold(5);
  EXPECT_GT(test::z_test(mean, 0), threshold);
  // E n^2 = 2 sum_i E w_i^2 E (g . d_i)^2 = sum_i E w_i^2 |d_i|^2, as gradients are independent and their
  // outer product has the mean 1/2: 4 * 2 * (integral of fade(1-x)^2 x^2) * (integral of fade(x)^2).
  double fade2 = 0, fade2x2 = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = (i + 0.5) / 100000, y = 1 - x, fade = y * y * y * (y * (y * 6 - 15) + 10);
    fade2 += fade * fade / 100000, fade2x2 += fade * fade * x * x / 100000;
  }
  EXPECT_GT(test::z_test(square, 8 * fade2 * fade2x2), threshold)
      << square.mean() << ' ' << 8 * fade2 * fade2x2;
  EXPECT_GT(test::z_test(crease, NoiseTexture::kMeanCrease, 2e-4), threshold);
  EXPECT_GT(test::z_test(tensor, 0), threshold) << "as steep along u as along v";
  EXPECT_GT(test::z_test(crossed, 0), threshold) << "and along both diagonals";
}

TEST(NoiseTexture, DoesNotRepeat) {
  SCOPED_TRACE(test::seed_note());
  Random random(9);
  const auto seed = static_cast<std::uint32_t>(random.integer());
  for (int period = 2; period <= 600; ++period)
    for (vec2 direction : {vec2(1, 0), vec2(0, 1), vec2(1, 1), vec2(1, -1)}) {
      double difference = 0, power = 0;
      for (int i = 0; i < 500; ++i) {
        const vec2 p = random.in_square(500);
        const double a = gradient_noise(p, seed);
        const double b = gradient_noise(p + static_cast<float>(period) * direction, seed);
        difference += (a - b) * (a - b), power += a * a + b * b;
      }
      EXPECT_GT(difference / power, 0.6) << period << ' ' << direction.x << direction.y;
    }
}

TEST(NoiseTexture, SeedsMakePatternsOfTheirOwn) {
  SCOPED_TRACE(test::seed_note());
  Random random(10);
  for (NoiseType type : {perlin, fbm, turbulence}) {
    const int seed = random.integer();
    const NoiseTexture a = noise(type, seed), same = noise(type, seed);
    for (int other : {seed + 1, seed + 31, seed + 1000}) {
      double product = 0, power = 0;
      for (int i = 0; i < 4000; ++i) {
        const vec2 uv = random.in_square(300);
        EXPECT_EQ(a.share({}, uv), same.share({}, uv));
        const double mean = type == turbulence ? NoiseTexture::kMeanCrease : 0.5;
        const double x = a.share({}, uv) - mean, y = noise(type, other).share({}, uv) - mean;
        product += x * y, power += 0.5 * (x * x + y * y);
      }
      EXPECT_LT(std::abs(product / power), 0.15) << other;
    }
  }
}

TEST(NoiseTexture, OctavesAddUpAsTheGainSays) {
  SCOPED_TRACE(test::seed_note());
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const vec2 uv = random.in_square(50);
    NoiseTexture one = noise(perlin), many = noise(fbm), none = noise(fbm);
    many.octaves = 1, none.gain = 0;
    EXPECT_EQ(one.share({}, uv), many.share({}, uv));
    EXPECT_EQ(one.share({}, uv), none.share({}, uv));
    // The second octave alone, from the sums of one and two.
    NoiseTexture two = noise(fbm), half = noise(fbm);
    two.octaves = half.octaves = 2, two.gain = 1, half.gain = 0.5f;
    const float a = 2 * one.share({}, uv) - 1;
    const float b1 = 2 * (2 * two.share({}, uv) - 1) - a, b2 = 2 * (1.5f * (2 * half.share({}, uv) - 1) - a);
    EXPECT_NEAR(b1, b2, 1e-5);
    EXPECT_LE(std::abs(b1), 1 + 1e-5f);
    NoiseTexture crease = noise(turbulence);
    crease.octaves = 2, crease.gain = 1;
    EXPECT_NEAR(crease.share({}, uv), 0.5f * (std::abs(a) + std::abs(b1)), 1e-5);
  }
}

TEST(NoiseTexture, FineOctavesGiveWayToTheirMean) {
  SCOPED_TRACE(test::seed_note());
  Random random(12);
  for (NoiseType type : {perlin, fbm, turbulence}) {
    const NoiseTexture t = noise(type, random.integer());
    for (float width : {0.02f, 0.1f, 0.3f, 1.0f, 3.0f}) {
      double error = 0, aliasing = 0, mean = 0;
      const int count = 200;
      for (int i = 0; i < count; ++i) {
        const float turn = 2 * kPi * random(), stretch = 1 + 5 * random();
        const vec2 a = width * vec2(std::cos(turn), std::sin(turn)), b = vec2(-a.y, a.x) / stretch;
        const TexturePoint at(random.in_square(100), {a, b});
        const double truth = test::sampled_share(t, {}, at, 24);
        error += std::pow(t.mean_share({}, at) - truth, 2) / count;
        aliasing += std::pow(t.share({}, at.uv) - truth, 2) / count;
        mean += t.mean_share({}, at) / count;
      }
      EXPECT_LT(std::sqrt(error), 0.05) << static_cast<int>(type) << ' ' << width;
      if (width >= 0.3f) { EXPECT_LT(error, 0.35 * aliasing) << static_cast<int>(type) << ' ' << width; }
      if (width == 3) { EXPECT_NEAR(mean, type == turbulence ? NoiseTexture::kMeanCrease : 0.5f, 0.01); }
    }
  }
}

} // namespace
} // namespace candela
