#include "bsdf/bsdf_test_models.h"
#include "materials/normal_map.h"
#include "sampling/warp.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

void expect_close(vec3 a, vec3 b, float tolerance) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << ", not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// A surface with skewed tangents of any length, and a shading normal that is near to its own.
struct Surface {
  vec3 dpdu, dpdv, geometric, shading;

  explicit Surface(RandomNumbers& random) {
    dpdu = random.direction() * (0.3f + 2 * random.one());
    do dpdv = random.direction() * (0.3f + 2 * random.one());
    while (std::abs(glm::dot(glm::normalize(dpdu), glm::normalize(dpdv))) > 0.8f);
    geometric = glm::normalize(glm::cross(dpdu, dpdv)) * (random.one() < 0.5f ? -1.0f : 1.0f);
    shading = glm::normalize(geometric + 0.3f * random.direction());
  }
};

TEST(NormalMap, FlatMapChangesNothing) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(1);
  for (int i = 0; i < 1000; ++i) {
    const Surface at(random);
    const Basis basis = texture_basis(at.shading, at.dpdu, at.dpdv);
    for (const float strength : {0.0f, 1.0f, 7.0f})
      expect_close(mapped_normal(basis, at.geometric, {0.5f, 0.5f, 1}, strength), at.shading, 1e-6f);
    expect_close(mapped_normal(basis, at.geometric, {0.3f, 0.6f, 0.9f}, 0), at.shading, 1e-6f);
    expect_close(bumped_normal(at.shading, at.geometric, at.dpdu, at.dpdv, {0, 0}), at.shading, 1e-6f);
  }
}

TEST(NormalMap, BasisFollowsTheTexture) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(2);
  for (int i = 0; i < 1000; ++i) {
    const Surface at(random);
    const Basis basis = texture_basis(at.shading, at.dpdu, at.dpdv);
    EXPECT_NEAR(glm::length(basis.s), 1, 1e-5);
    EXPECT_NEAR(glm::length(basis.t), 1, 1e-5);
    EXPECT_NEAR(glm::dot(basis.s, basis.t), 0, 1e-5);
    EXPECT_NEAR(glm::dot(basis.s, basis.n), 0, 1e-5);
    EXPECT_GT(glm::dot(basis.s, at.dpdu), 0);
    EXPECT_GE(glm::dot(basis.t, at.dpdv), 0);
  }
}

TEST(NormalMap, AMapOfOneNormalIsATiltedPlane) {
  // z = 0.4 x - 0.7 y, once as geometry and once as a map on the plane z = 0 (and on its mirror image).
  const vec3 tilted = glm::normalize(vec3(-0.4f, 0.7f, 1));
  for (const float mirror : {1.0f, -1.0f}) {
    const Basis basis = texture_basis({0, 0, 1}, {2, 0, 0}, {0, 3 * mirror, 0});
    const vec3 rgb = 0.5f * vec3(tilted.x, mirror * tilted.y, tilted.z) + 0.5f;
    expect_close(mapped_normal(basis, {0, 0, 1}, rgb), tilted, 1e-6f);
    expect_close(
        bumped_normal({0, 0, 1}, {0, 0, 1}, {2, 0, 0}, {0, 3 * mirror, 0}, {0.4f * 2, -0.7f * 3 * mirror}),
        tilted, 1e-6f);
    // Twice the slopes.
    expect_close(mapped_normal(basis, {0, 0, 1}, rgb, 2), glm::normalize(vec3(-0.8f, 1.4f, 1)), 1e-6f);
  }
}

TEST(NormalMap, BumpOfALinearRamp) {
  SCOPED_TRACE(seed_note());
  // The tangents of p(u, v) + h(u, v) n on a plane, and their cross product.
  RandomNumbers random(3);
  for (int i = 0; i < 1000; ++i) {
    const Surface at(random);
    const vec2 gradient(2 * random.one() - 1, 2 * random.one() - 1);
    vec3 exact =
        glm::normalize(glm::cross(at.dpdu + gradient.x * at.geometric, at.dpdv + gradient.y * at.geometric));
    exact = glm::dot(exact, at.geometric) < 0 ? -exact : exact;
    expect_close(bumped_normal(at.geometric, at.geometric, at.dpdu, at.dpdv, gradient),
                 kept_above(exact, at.geometric), 2e-5f);
  }
}

TEST(NormalMap, BumpOfASphere) {
  // A sphere of radius 2 by longitude and latitude, its height 0.02 sin(3 u) cos(2 v).
  auto point = [](double u, double v, double height) {
    return (2 + height) * glm::dvec3(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
  };
  auto height = [](double u, double v) { return 0.02 * std::sin(3 * u) * std::cos(2 * v); };
  for (double u = 0; u < 6; u += 0.7)
    for (double v = -1.3; v < 1.4; v += 0.3) {
      constexpr double e = 1e-5;
      auto moved = [&](double a, double b) { return point(a, b, height(a, b)); };
      const glm::dvec3 exact =
          glm::normalize(glm::cross(moved(u + e, v) - moved(u - e, v), moved(u, v + e) - moved(u, v - e)));
      const vec3 n = glm::normalize(point(u, v, 0));
      const vec3 dpdu = (point(u + e, v, 0) - point(u - e, v, 0)) / (2 * e);
      const vec3 dpdv = (point(u, v + e, 0) - point(u, v - e, 0)) / (2 * e);
      const vec2 gradient(0.06 * std::cos(3 * u) * std::cos(2 * v),
                          -0.04 * std::sin(3 * u) * std::sin(2 * v));
      // Blinn leaves out h dn/du: of the slope, the share 0.02 / 2.
      const float slope = glm::length(glm::cross(n, vec3(exact)));
      expect_close(bumped_normal(n, n, dpdu, dpdv, gradient), exact, 0.011f * slope + 1e-5f);
    }
}

TEST(NormalMap, AgainstMitsuba) {
  // Mitsuba 3.9.1, use_shadowing_function false, over a white diffuse BSDF, whose eval(ctx, si, wo) pi is the
  // cosine with the normal: of three wo, solved for it.
  const vec3 normal = glm::normalize(vec3(0.2f, -0.1f, 1)), geometric = glm::normalize(vec3(0.1f, 0.05f, 1));
  const vec3 dpdu(2, 0.3f, -0.215f), dpdv(0.4f, 1.5f, -0.115f);
  // normalmap of a constant (.62, .41, .9)
  expect_close(mapped_normal(texture_basis(normal, dpdu, dpdv), geometric, {0.62f, 0.41f, 0.9f}),
               {0.48389747f, -0.25488506f, 0.83718375f}, 2e-6f);
  // bumpmap of a 16 x 16 texture .6 u - .9 v; texels of half precision
  expect_close(bumped_normal(normal, geometric, dpdu, dpdv, {0.6f, -0.9f}),
               {-0.15092753f, 0.47585447f, 0.86647738f}, 2e-3f);
}

TEST(NormalMap, BumpAndNormalMapAgree) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(4);
  for (int i = 0; i < 1000; ++i) {
    const Surface at(random);
    const Basis basis = texture_basis(at.shading, at.dpdu, at.dpdv);
    const vec3 rgb(0.3f + 0.4f * random.one(), 0.3f + 0.4f * random.one(), 0.9f);
    // Slopes along s and t, hence along the tangents.
    const vec3 n = 2.0f * rgb - 1.0f;
    const vec3 slope = -(n.x * basis.s + n.y * basis.t) / n.z;
    const vec2 gradient(glm::dot(slope, at.dpdu), glm::dot(slope, at.dpdv));
    expect_close(bumped_normal(at.shading, at.geometric, at.dpdu, at.dpdv, gradient),
                 mapped_normal(basis, at.geometric, rgb), 2e-5f);
  }
}

TEST(NormalMap, StaysAboveTheSurface) {
  SCOPED_TRACE(seed_note());
  RandomNumbers random(5);
  for (int i = 0; i < 5000; ++i) {
    const Surface at(random);
    const Basis basis = texture_basis(at.shading, at.dpdu, at.dpdv);
    const vec3 rgb(random.one(), random.one(), random.one());
    const vec2 gradient((random.one() - 0.5f) * 100, (random.one() - 0.5f) * 100);
    for (const vec3 n : {mapped_normal(basis, at.geometric, rgb, 10),
                         bumped_normal(at.shading, at.geometric, at.dpdu, at.dpdv, gradient),
                         kept_above(random.direction(), at.geometric)}) {
      EXPECT_GE(glm::dot(n, at.geometric), 0.0199f);
      EXPECT_NEAR(glm::length(n), 1, 1e-5);
    }
  }
  expect_close(kept_above({0, 0, -1}, {0, 0, 1}), {0, 0, 1}, 1e-6f);
}

TEST(NormalMap, OddInputs) {
  const vec3 z(0, 0, 1);
  // No tangents, no area, black and white texels, infinite slopes.
  EXPECT_NEAR(glm::length(texture_basis(z, z, z).s), 1, 1e-6);
  EXPECT_EQ(bumped_normal(z, z, {1, 0, 0}, {2, 0, 0}, {1, 1}), z);
  EXPECT_EQ(bumped_normal(z, z, {1, 0, 0}, {0, 1, 0}, {1e30f, 0}), z);
  const Basis basis = texture_basis(z, {1, 0, 0}, {0, 1, 0});
  for (const vec3 rgb : {vec3(0), vec3(1), vec3(0.5f), vec3(0.5f, 0.5f, 0), vec3(1, 0.5f, 0.5f)})
    EXPECT_GT(mapped_normal(basis, z, rgb).z, 0);
}

} // namespace
} // namespace candela::test
