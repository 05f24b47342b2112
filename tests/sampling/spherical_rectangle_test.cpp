#include "core/basis.h"
#include "sampling/spherical_rectangle.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

/// The rectangle [x0, x1] x [y0, y1] at height z above the origin, the signed sum of its four quadrant
/// corners' solid angles, each atan(x y / (z r)).
double closed_form(double x0, double x1, double y0, double y1, double z) {
  auto corner = [z](double x, double y) { return std::atan(x * y / (z * std::sqrt(x * x + y * y + z * z))); };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

struct Case {
  const char* name;
  double x0, x1, y0, y1, z;
};

const Case kCases[] = {
    {"cube face", -1, 1, -1, 1, 1},       {"ceiling light", -0.25, 0.25, -0.2, 0.2, 1.9},
    {"off axis", 3, 4, -2, 5, 1.5},       {"below a corner", 0, 2, 0, 1, 0.7},
    {"beside an edge", -2, 0, 1, 3, 0.5}, {"nearly a hemisphere", -100, 100, -80, 120, 0.1},
    {"touching", -1, 1, -1, 1, 1e-4},     {"edge-on", 1, 2, -0.5, 0.5, 0.01},
    {"far away", 30, 30.5, 20, 20.4, 40}, {"narrow", -5, 5, 1, 1.01, 2},
};

/// The case's rectangle somewhere in space: its axes are rotated and moved.
struct Placed {
  vec3 corner, edge_x, edge_y, origin;
};
Placed place(const Case& c, vec3 normal, vec3 at) {
  Basis basis = Basis::from_normal(glm::normalize(normal));
  auto point = [&](double x, double y, double z) {
    return at + basis.to_world(vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
  };
  return {point(c.x0, c.y0, c.z), basis.s * static_cast<float>(c.x1 - c.x0),
          basis.t * static_cast<float>(c.y1 - c.y0), at};
}

TEST(SphericalRectangle, SolidAngleHasItsClosedForm) {
  for (const Case& c : kCases) {
    double exact = closed_form(c.x0, c.x1, c.y0, c.y1, c.z);
    for (vec3 normal : {vec3(0, 0, 1), vec3(1, 2, -3), vec3(-1, 0.1f, 0)}) {
      Placed p = place(c, normal, vec3(0));
      float solid_angle = SphericalRectangle(p.corner, p.edge_x, p.edge_y, p.origin).solid_angle;
      // Rotating in floats displaces the corners by some 1e-7 of their distance.
      EXPECT_NEAR(solid_angle / exact, 1, 1e-4) << c.name;
      // The other way round it is the same, and from the other side of it.
      vec3 far_corner = p.corner + p.edge_x;
      EXPECT_NEAR(SphericalRectangle(far_corner, -p.edge_x, p.edge_y, p.origin).solid_angle / exact, 1, 1e-4)
          << c.name;
    }
  }
  SphericalRectangle face({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0});
  EXPECT_NEAR(face.solid_angle, 4 * kPi / 6, 1e-6);
}

TEST(SphericalRectangle, SmallSolidAnglesKeepTheirDigits) {
  // area cos / d^2 is right to second order of size over distance.
  for (float size : {1e-2f, 1e-3f, 1e-5f}) {
    vec3 corner(3, 4, 12);
    SphericalRectangle r(corner, {size, 0, 0}, {0, size, 0}, {0, 0, 0});
    double exact = double(size) * double(size) * 12 / std::pow(169.0, 1.5);
    EXPECT_NEAR(r.solid_angle / exact, 1, 0.3 * double(size) + 2e-6) << size;
  }
}

TEST(SphericalRectangle, SeenFromItsOwnPlaneItIsNothing) {
  for (vec3 origin : {vec3(0.5f, 0.5f, 0), vec3(3, 0.5f, 0), vec3(0, 0, 0)})
    EXPECT_EQ(SphericalRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, origin).solid_angle, 0);
}

TEST(SphericalRectangle, CornersOfTheSquareAreCornersOfTheRectangle) {
  for (const Case& c : kCases) {
    Placed p = place(c, {0, 0, 1}, vec3(0));
    SphericalRectangle r(p.corner, p.edge_x, p.edge_y, p.origin);
    auto tolerance = static_cast<float>(2e-3 * (c.x1 - c.x0 + c.y1 - c.y0));
    EXPECT_LT(glm::length(r.sample({0, 0}) - p.corner), tolerance) << c.name;
    EXPECT_LT(glm::length(r.sample({1, 1}) - (p.corner + p.edge_x + p.edge_y)), tolerance) << c.name;
  }
}

/// Counts of samples in a grid over the rectangle against the grid cells' own solid angles.
double chi_square_p(const Case& c, vec3 normal, vec3 at, std::mt19937_64& random) {
  constexpr int kCells = 16, kDraws = 200000;
  Placed p = place(c, normal, at);
  SphericalRectangle rectangle(p.corner, p.edge_x, p.edge_y, p.origin);
  std::vector<double> observed(kCells * kCells), expected(kCells * kCells);
  double length2_x = length_squared(p.edge_x), length2_y = length_squared(p.edge_y);
  double whole = closed_form(c.x0, c.x1, c.y0, c.y1, c.z);
  // Floats place a point to within this, as a share of the shorter edge.
  double rounding = 1e-6 * double(glm::length(p.corner) + glm::length(p.edge_x) + glm::length(p.edge_y)) /
                    std::sqrt(std::min(length2_x, length2_y));
  int outside = 0;
  for (int i = 0; i < kDraws; ++i) {
    vec2 u;
    u.x = static_cast<float>(random() >> 40) * 0x1p-24f;
    u.y = static_cast<float>(random() >> 40) * 0x1p-24f;
    vec3 d = rectangle.sample(u) - p.corner;
    double s = glm::dot(d, p.edge_x) / length2_x, t = glm::dot(d, p.edge_y) / length2_y;
    outside += !(std::min(s, t) >= -rounding && std::max(s, t) <= 1 + rounding);
    auto cell = [](double x) { return static_cast<std::size_t>(std::clamp(x, 0.0, 1 - 1e-9) * kCells); };
    observed[cell(t) * kCells + cell(s)] += 1;
  }
  EXPECT_EQ(outside, 0) << c.name;
  for (std::size_t j = 0; j < kCells; ++j) {
    for (std::size_t i = 0; i < kCells; ++i) {
      auto x = [&](std::size_t k) { return c.x0 + (c.x1 - c.x0) * static_cast<double>(k) / kCells; };
      auto y = [&](std::size_t k) { return c.y0 + (c.y1 - c.y0) * static_cast<double>(k) / kCells; };
      expected[j * kCells + i] = kDraws * closed_form(x(i), x(i + 1), y(j), y(j + 1), c.z) / whole;
    }
  }
  return chi_square_test(observed, expected).p_value;
}

TEST(SphericalRectangleStatistical, SamplesAreUniformInSolidAngle) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed() + 1);
  double threshold = sidak_threshold(2 * static_cast<int>(std::size(kCases)));
  for (const Case& c : kCases) {
    EXPECT_GT(chi_square_p(c, {0, 0, 1}, vec3(0), random), threshold) << c.name;
    EXPECT_GT(chi_square_p(c, {1, -2, 0.5f}, {2, 3, 5}, random), threshold) << c.name;
  }
}

TEST(SphericalRectangleStatistical, UniformDownToTheSmallestSolidAngle) {
  SCOPED_TRACE(seed_note());
  std::mt19937_64 random(fresh_seed() + 2);
  const double minimum = SphericalRectangle::kMinSolidAngle;
  // Squares of just that solid angle: far away, far aside, and edge-on.
  const double size = std::sqrt(minimum) * 1.001;
  const Case cases[] = {
      {"far", 0, size, 0, size, 1},
      {"far aside", 4, 4 + 12 * size, -3, -3 + 12 * size, 1},
      {"edge-on", 2, 3, 0, 1, 1.4 * minimum * 12},
      {"long and edge-on", 1, 2, -1000, 1000, minimum * 1.05},
      {"strip", -0.5, 0.5, 1, 1 + 4 * minimum, 1},
  };
  for (const Case& c : cases) {
    double solid_angle = closed_form(c.x0, c.x1, c.y0, c.y1, c.z);
    EXPECT_TRUE(solid_angle > minimum && solid_angle < 20 * minimum) << c.name << ' ' << solid_angle;
    EXPECT_GT(chi_square_p(c, {0, 0, 1}, vec3(0), random), sidak_threshold(std::size(cases))) << c.name;
  }
}

TEST(SphericalRectangle, CosineAndSine) {
  for (int i = 0; i <= 100000; ++i) {
    double angle = 2 * std::numbers::pi * i / 100000;
    auto [c, s] = detail::cos_sin(angle);
    ASSERT_NEAR(c, std::cos(angle), 1.5e-15) << angle;
    ASSERT_NEAR(s, std::sin(angle), 1.5e-15) << angle;
  }
}

TEST(SphericalRectangle, AngleFromTheXAxis) {
  for (int i = 0; i <= 100000; ++i) {
    double angle = std::numbers::pi * i / 100000, radius = std::exp2(i % 64 - 32);
    double x = radius * std::cos(angle), y = radius * std::abs(std::sin(angle));
    ASSERT_NEAR(detail::angle_from_x_axis(y, x), std::atan2(y, x), 3e-11 * angle + 1e-15) << angle;
  }
  EXPECT_EQ(detail::angle_from_x_axis(0, 0), 0);
  EXPECT_EQ(detail::angle_from_x_axis(0, 2), 0);
  EXPECT_DOUBLE_EQ(detail::angle_from_x_axis(0, -2), std::numbers::pi);
  EXPECT_DOUBLE_EQ(detail::angle_from_x_axis(3, 0), std::numbers::pi / 2);
}

TEST(SphericalRectangle, ManyAtOnceAreTheSameToTheBit) {
  std::mt19937_64 random(fresh_seed() + 3);
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<double> place(-3, 3), size(0.01, 2), unit(0, 1);
  for (std::size_t count : {1u, 7u, 8u, 64u}) {
    RectangleBatch batch;
    batch.count = count;
    for (std::size_t i = 0; i < count; ++i) {
      batch.x0[i] = place(random), batch.y0[i] = place(random);
      batch.z[i] = i == 3 ? 0 : size(random); // one in its own plane
      batch.length_x[i] = size(random), batch.length_y[i] = size(random);
      batch.u[i] = unit(random), batch.v[i] = unit(random);
    }
    sample_rectangles(batch);
    for (std::size_t i = 0; i < count; ++i) {
      ProjectedRectangle one(batch.x0[i], batch.y0[i], batch.z[i], batch.length_x[i], batch.length_y[i]);
      EXPECT_EQ(batch.solid_angle[i], one.solid_angle);
      if (batch.z[i] == 0) {
        EXPECT_EQ(batch.solid_angle[i], 0);
        continue;
      }
      auto at = one.sample(batch.u[i], batch.v[i]);
      EXPECT_EQ(batch.x[i], at.x);
      EXPECT_EQ(batch.y[i], at.y);
    }
  }
}

TEST(SphericalTriangle, OctantAndSubdivision) {
  vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_NEAR(spherical_triangle_solid_angle(x, y, z), kPi / 2, 1e-6);
  EXPECT_NEAR(spherical_triangle_solid_angle(z, y, x), kPi / 2, 1e-6);
  // More than a hemisphere's quarter: three points around the equator just above it cover nearly 2 pi.
  auto above = [](float phi) { return glm::normalize(vec3(std::cos(phi), std::sin(phi), 0.01f)); };
  float wide = spherical_triangle_solid_angle(above(0), above(2 * kPi / 3), above(4 * kPi / 3));
  EXPECT_GT(wide, 2 * kPi * 0.95f);
  EXPECT_LT(wide, 2 * kPi);
  // Both halves of a rectangle make the whole.
  vec3 a = glm::normalize(vec3(1, 2, 3)), b = glm::normalize(vec3(2, 2, 3)),
       c = glm::normalize(vec3(2, 4, 3)), d = glm::normalize(vec3(1, 4, 3));
  EXPECT_NEAR(spherical_triangle_solid_angle(a, b, c) + spherical_triangle_solid_angle(a, c, d),
              closed_form(1, 2, 2, 4, 3), 1e-6);
}

} // namespace
} // namespace candela::test
