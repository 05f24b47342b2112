#include "sampling/warp.h"
#include "support/direction_statistics.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

class Uniform {
public:
  explicit Uniform(std::uint64_t stream) : random_(fresh_seed() + stream) {}
  float one() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
  vec2 two() {
    float x = one();
    return {x, one()};
  }

private:
  std::mt19937_64 random_;
};

/// Points of the unit square with its edges and corners.
std::vector<vec2> square_grid() {
  std::vector<float> ticks = {0, 0x1p-24f, 0.5f, 0.5f - 0x1p-24f, kOneMinusEpsilon};
  for (int i = 1; i < 64; ++i) ticks.push_back(static_cast<float>(i) / 64);
  std::vector<vec2> grid;
  for (float x : ticks)
    for (float y : ticks) grid.push_back({x, y});
  return grid;
}

constexpr int kDraws = 400000;

double disc_p_value(const std::function<vec2(vec2)>& warp, std::uint64_t stream) {
  constexpr int kRings = 16, kSectors = 16;
  std::vector<double> observed(kRings * kSectors),
      expected(kRings * kSectors, double(kDraws) / (kRings * kSectors));
  Uniform u(stream);
  for (int i = 0; i < kDraws; ++i) {
    vec2 p = warp(u.two());
    double r2 = glm::dot(p, p), turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5;
    int ring = std::min(static_cast<int>(r2 * kRings), kRings - 1);
    int sector = std::min(static_cast<int>(turn * kSectors), kSectors - 1);
    observed[static_cast<std::size_t>(ring * kSectors + sector)] += 1;
  }
  return chi_square_test(observed, expected).p_value;
}

TEST(Warp, StaysInItsDomain) {
  for (vec2 u : square_grid()) {
    vec2 disc = sample_uniform_disc(u);
    EXPECT_LE(glm::length(disc), 1 + 1e-6f);
    for (vec3 w : {sample_uniform_sphere(u), sample_uniform_hemisphere(u), sample_cosine_hemisphere(u),
                   sample_uniform_cone(u, 0.3f), sample_uniform_cone(u, 1e-10f)})
      EXPECT_NEAR(glm::length(w), 1, 1e-6) << u.x << ' ' << u.y;
    EXPECT_GE(sample_uniform_hemisphere(u).z, 0);
    EXPECT_GE(sample_cosine_hemisphere(u).z, 0);
    vec3 b = sample_uniform_triangle(u);
    EXPECT_GE(min_component(b), 0);
    EXPECT_NEAR(b.x + b.y + b.z, 1, 1e-6);
  }
}

TEST(Warp, ConcentricDiscTakesSquaresToCircles) {
  for (vec2 u : square_grid()) {
    vec2 p = 2.0f * u - 1.0f;
    vec2 d = sample_uniform_disc(u);
    EXPECT_NEAR(glm::length(d), std::max(std::abs(p.x), std::abs(p.y)), 2e-7f);
    // And goes around them at constant speed: an eighth of a turn for half a side.
    if (p.x > std::abs(p.y)) {
      EXPECT_NEAR(std::atan2(d.y, d.x), kPi / 4 * p.y / p.x, 4e-7f);
    } else if (p.y > std::abs(p.x)) {
      EXPECT_NEAR(std::atan2(d.x, d.y), kPi / 4 * p.x / p.y, 4e-7f);
    }
  }
}

TEST(WarpStatistical, DiscIsUniform) {
  SCOPED_TRACE(seed_note());
  EXPECT_GT(disc_p_value(sample_uniform_disc, 1), kFalseAlarm);
}

TEST(WarpStatistical, DirectionsHaveTheirDensities) {
  SCOPED_TRACE(seed_note());
  struct Case {
    const char* name;
    std::function<vec3(vec2)> warp;
    std::function<double(vec3)> pdf;
  };
  float cap = 0.3f;
  const Case cases[] = {
      {"sphere", sample_uniform_sphere, [](vec3) { return kUniformSpherePdf; }},
      {"hemisphere", sample_uniform_hemisphere, [](vec3 w) { return w.z >= 0 ? kUniformHemispherePdf : 0; }},
      // A few draws lie in the horizon itself.
      {"cosine", sample_cosine_hemisphere,
       [](vec3 w) { return w.z == 0 ? 1e-9f : cosine_hemisphere_pdf(w.z); }},
      {"cone", [=](vec2 u) { return sample_uniform_cone(u, cap); },
       // A cosine is rounded to 6e-8.
       [=](vec3 w) { return 1 - w.z < cap + 2e-7f ? uniform_cone_pdf(cap) : 0; }},
  };
  std::uint64_t stream = 10;
  for (const Case& c : cases) {
    Uniform u(stream++);
    SphereBins bins;
    DirectionTest t = test_directions(
        bins, kDraws, [&](std::size_t) { return c.warp(u.two()); }, c.pdf);
    EXPECT_GT(t.chi_square.p_value, sidak_threshold(std::size(cases))) << c.name;
    EXPECT_NEAR(t.pdf_integral, 1, 1e-4) << c.name;
  }
}

TEST(WarpStatistical, TinyConesAreUniform) {
  SCOPED_TRACE(seed_note());
  for (float theta_max : {1e-2f, 1e-4f, 1e-7f}) {
    float one_minus_cos_max = one_minus_cos_from_sin2(sqr(std::sin(theta_max)));
    EXPECT_NEAR(one_minus_cos_max / (0.5 * double(theta_max) * double(theta_max)), 1, 1e-4);
    // Uniform in solid angle: uniform in (2 sin(theta / 2))^2 = 2 (1 - cos), which for such angles is sin^2.
    auto projected = [&](vec2 u) {
      vec3 w = sample_uniform_cone(u, one_minus_cos_max);
      return vec2(w) / theta_max;
    };
    EXPECT_GT(disc_p_value(projected, 20), sidak_threshold(3)) << theta_max;
  }
}

TEST(WarpStatistical, TriangleIsUniform) {
  SCOPED_TRACE(seed_note());
  // Cut into n^2 congruent triangles by lines parallel to the sides.
  constexpr int n = 16;
  std::vector<double> observed(n * n), expected(n * n, double(kDraws) / (n * n));
  Uniform u(30);
  for (int i = 0; i < kDraws; ++i) {
    vec3 b = sample_uniform_triangle(u.two());
    double x = double(b.x) * n, y = double(b.y) * n;
    int column = std::min(static_cast<int>(x), n - 1), row = std::min(static_cast<int>(y), n - 1 - column);
    bool upper = (x - column) + (y - row) > 1 && column + row < n - 1;
    // Along a column there are 2 (n - column) - 1 triangles.
    int before = column * (2 * n - column);
    observed[static_cast<std::size_t>(before + 2 * row + (upper ? 1 : 0))] += 1;
  }
  EXPECT_GT(chi_square_test(observed, expected).p_value, kFalseAlarm);
}

TEST(Warp, ErfInvInvertsErf) {
  for (double x = -3.2; x <= 3.2; x += 0.01) {
    auto y = static_cast<float>(std::erf(x));
    if (std::abs(y) > 0.99999f) continue;
    // The rounding of y, and 1e-6 of the result.
    double slope = 0.5 * std::sqrt(std::numbers::pi) * std::exp(x * x);
    EXPECT_NEAR(erf_inv(y), x, 1e-6 * std::abs(x) + 6e-8 * std::abs(double(y)) * slope) << x;
  }
}

TEST(WarpStatistical, TruncatedGaussian) {
  SCOPED_TRACE(seed_note());
  struct Case {
    float sigma, radius;
  };
  const Case cases[] = {{0.5f, 1.5f}, {0.3f, 0.5f}, {2, 0.5f}, {0.1f, 1}};
  for (Case c : cases) {
    TruncatedGaussian gaussian(c.sigma, c.radius);
    constexpr int kBins = 64;
    std::vector<double> observed(kBins), expected(kBins);
    Uniform u(40);
    for (int i = 0; i < kDraws; ++i) {
      float x = gaussian.sample(u.one());
      ASSERT_LE(std::abs(x), c.radius);
      observed[std::min<std::size_t>(static_cast<std::size_t>((x / c.radius + 1) * 0.5f * kBins),
                                     kBins - 1)] += 1;
    }
    double scale = 1 / (double(c.sigma) * std::numbers::sqrt2), radius = c.radius;
    double pdf_sum = 0;
    for (int i = 0; i < kBins; ++i) {
      double a = radius * (2.0 * i / kBins - 1), b = radius * (2.0 * (i + 1) / kBins - 1);
      double mass = (std::erf(b * scale) - std::erf(a * scale)) / (2 * std::erf(radius * scale));
      expected[static_cast<std::size_t>(i)] = kDraws * mass;
      pdf_sum += (b - a) * double(gaussian.pdf(static_cast<float>(0.5 * (a + b))));
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(std::size(cases))) << c.sigma;
    EXPECT_NEAR(pdf_sum, 1, 1e-3);
    EXPECT_EQ(gaussian.pdf(c.radius * 1.01f), 0);
    // Where the ends carry weight, numbers reach them.
    if (c.radius <= 3 * c.sigma) {
      EXPECT_NEAR(gaussian.sample(0), -c.radius, 1e-3f * c.radius);
      EXPECT_NEAR(gaussian.sample(kOneMinusEpsilon), c.radius, 1e-3f * c.radius);
    }
    EXPECT_NEAR(gaussian.sample(0.5f), 0, 1e-6);
  }
  EXPECT_EQ(sample_box(0, 0.5f), -0.5f);
  EXPECT_LT(sample_box(kOneMinusEpsilon, 0.5f), 0.5f);
}

} // namespace
} // namespace candela::test
