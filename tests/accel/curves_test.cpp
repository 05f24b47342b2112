// Curves against balls along them in double precision, and closed forms.

#include "accel/curve_samples.h"
#include "support/seed.h"

namespace candela::test {
namespace {

using accel_detail::CurveHit;
using accel_detail::CurveRay;
using accel_detail::intersect_curve;

/// What a ray that begins outside of the balls along a curve enters first, sampled densely.
struct DenseHit {
  double nearest_miss = -1e300; ///< the greatest of r - distance of the line to the axis, in front
  double nearest_u = 0;         ///< where that is
  double t = 1e300, u = 0;
};
DenseHit dense_hit(const CurveSegment& c, const Ray& ray) {
  const glm::dvec3 o(ray.origin), d = glm::normalize(glm::dvec3(ray.direction));
  DenseHit hit;
  auto look = [&](double u) {
    const glm::dvec4 p = curve_at(c, u);
    const glm::dvec3 f = glm::dvec3(p) - o;
    const double z = glm::dot(f, d), beside = glm::length(f - z * d), half = p.w * p.w - beside * beside;
    if (z > 0 && p.w - beside > hit.nearest_miss) hit.nearest_miss = p.w - beside, hit.nearest_u = u;
    const double s = half >= 0 ? z - std::sqrt(half) : 1e300;
    if (s > 0 && s < hit.t) hit.t = s, hit.u = u;
  };
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i) look(i / static_cast<double>(kSteps));
  auto refine = [&](const double& best) {
    for (double step = 1.0 / kSteps; step > 1e-10; step *= 0.25) {
      const double middle = best;
      for (int i = -4; i <= 4; ++i) look(std::clamp(middle + i * step / 4, 0.0, 1.0));
    }
  };
  refine(hit.nearest_u);
  if (hit.t < 1e300) refine(hit.u);
  if (hit.t < 1e300) hit.t /= static_cast<double>(glm::length(ray.direction));
  return hit;
}

bool begins_outside(const CurveSegment& c, vec3 o) {
  for (int i = 0; i <= 200; ++i) {
    const glm::dvec4 p = curve_at(c, i / 200.0);
    if (glm::length(glm::dvec3(p) - glm::dvec3(o)) < 1.05 * p.w + 0.01) return false;
  }
  return true;
}

TEST(CurvesStatistical, TubesAreHitWhereTheirBallsAre) {
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  int hits = 0, misses = 0;
  for (float radius : {0.3f, 0.05f, 0.004f})
    for (float bend : {0.0f, 0.1f, 1.0f})
      for (int i = 0; i < 220; ++i) {
        const CurveSegment c = random_curve(random, bend, radius, kClosed);
        const Ray ray = ray_near(random, c, 1.5f * radius);
        if (!begins_outside(c, ray.origin)) continue;
        const auto hit = intersect_curve(c, CurveRay(ray, 0, kInfinity));
        const DenseHit dense = dense_hit(c, ray);
        if (dense.nearest_miss < -1e-7) {
          ++misses;
          ASSERT_FALSE(hit) << radius << ' ' << bend;
        } else if (dense.t < 1e300) {
          ++hits;
          ASSERT_TRUE(hit) << radius << ' ' << bend << " t " << dense.t << " depth " << dense.nearest_miss;
          ASSERT_NEAR(hit->t, dense.t, 2e-6 * (1 + dense.t)) << radius << ' ' << bend;
        }
      }
  EXPECT_GT(hits, 400);
  EXPECT_GT(misses, 200);
}

TEST(Curves, PiecesThatAreAlmostStraightKeepTheirHits) {
  // The first ray passes the balls by, comes near, draws off again and then enters, all within a piece; the
  // second one enters the end, towards which the entries first rise.
  struct Case {
    CurveSegment curve;
    Ray ray;
  };
  Case passes{{{vec4{-0x1.9e552p-4f, -0x1.777a1p-1f, -0x1.8e8ecp-4f, 0x1.7f9394p-4f},
                {0x1.d1af2ep-1f, -0x1.83d4dcp+0f, 0x1.26a158p-2f, 0x1.1a3f66p-2f},
                {-0x1.13196p-5f, -0x1.cf314cp-1f, 0x1.084042p+0f, 0x1.a750dap-3f},
                {0x1.f731ccp-3f, -0x1.0adb9cp+0f, 0x1.939308p-1f, 0x1.3c2fdp-3f}}},
              {{-0x1.40028ap-1f, 0x1.01a5e8p-2f, -0x1.31f19ep+0f},
               0,
               {0x1.4323f2p-1f, -0x1.c2a582p-1f, 0x1.1416d4p+0f},
               kInfinity}};
  Case rises{{{vec4{-0x1.d9e5cp-1f, 0x1.863bbp-1f, -0x1.cee02p-2f, 0x1.b6215ap-4f},
               {-0x1.8de54p-1f, 0x1.a75f12p-1f, -0x1.964e36p-4f, 0x1.b5a62cp-4f},
               {-0x1.e82308p-2f, 0x1.ad9288p-1f, 0x1.606694p-3f, 0x1.1e0d52p-3f},
               {-0x1.91f94cp-2f, 0x1.c87a38p-1f, 0x1.8956ap-2f, 0x1.31b8f6p-2f}}},
             {{0x1.c28e8p-6f, -0x1.66f89cp+1f, 0x1.77aa48p+1f},
              0,
              {-0x1.e66aaep-3f, 0x1.67304cp+0f, -0x1.122108p+0f},
              kInfinity}};
  for (Case* c : {&passes, &rises}) {
    c->curve.flags = kClosed;
    const auto hit = intersect_curve(c->curve, CurveRay(c->ray, 0, kInfinity));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, dense_hit(c->curve, c->ray).t, 2e-6);
  }
}

TEST(CurvesStatistical, RaysAlongTheirTangentsHitTubes) {
  // End-on, several parts of a curve are within its radius of the ray.
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  for (float radius : {0.1f, 0.01f, 0.001f})
    for (int i = 0; i < 200; ++i) {
      const CurveSegment c = random_curve(random, 0.3f, radius, kClosed);
      const double u = static_cast<double>(random.uniform(0.05f, 0.95f));
      const glm::dvec4 p = curve_at(c, u);
      const vec3 tangent = glm::normalize(vec3(glm::dvec3(curve_at(c, u + 1e-4)) - glm::dvec3(p)));
      const Ray ray{vec3(p) - 4.0f * tangent + random.in_cube(0.5f * radius), 0, tangent, kInfinity};
      if (!begins_outside(c, ray.origin)) continue;
      const auto hit = intersect_curve(c, CurveRay(ray, 0, kInfinity));
      const DenseHit dense = dense_hit(c, ray);
      if (!(dense.t < 1e300)) continue;
      ASSERT_TRUE(hit);
      ASSERT_NEAR(hit->t, dense.t, 2e-3 * static_cast<double>(radius) + 2e-6 * dense.t);
    }
}

TEST(CurvesStatistical, StraightTubesAreCylinders) {
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    // Coordinates with few digits, so that floats hold points of a straight line.
    auto rounded = [](vec3 p) { return glm::round(p * 4096.0f) / 4096.0f; };
    const vec3 third = rounded(2.0f / 3 * random.direction()), from = rounded(random.in_cube());
    const vec3 axis = 1.5f * third;
    const float r = 0.02f;
    CurveSegment c;
    for (std::size_t k = 0; k < 4; ++k) c.points[k] = vec4(from + third * static_cast<float>(k), r);
    const vec3 origin = from + axis + 3.0f * random.direction();
    const vec3 at = from + axis * random.uniform(0.2f, 1.8f) + random.in_cube(1.5f * r);
    const Ray aimed{origin, 0, at - origin, kInfinity};
    const double length = glm::length(3.0 * glm::dvec3(third));
    const glm::dvec3 a = 3.0 * glm::dvec3(third) / length, f = glm::dvec3(origin) - glm::dvec3(from),
                     d(aimed.direction);
    const glm::dvec3 d2 = d - glm::dot(d, a) * a, f2 = f - glm::dot(f, a) * a;
    const double qa = glm::dot(d2, d2), qb = glm::dot(d2, f2), qc = glm::dot(f2, f2) - double{r} * double{r};
    const double disc = qb * qb - qa * qc;
    const auto hit = intersect_curve(c, CurveRay(aimed, 0, kInfinity));
    if (std::abs(disc) < 1e-4 * qa * double{r} * double{r}) continue; // grazing
    const double t = disc > 0 ? (-qb - std::sqrt(disc)) / qa : -1;
    const double along = glm::dot(f + t * d, a);
    if (disc > 0 && t > 0 && along > 0.01 && along < length - 0.01) {
      ++hits;
      ASSERT_TRUE(hit);
      ASSERT_NEAR(hit->t, t, 2e-7 * t);
      ASSERT_NEAR(hit->u, along / length, 1e-6);
    } else if (disc < 0) {
      ASSERT_FALSE(hit);
    }
  }
  EXPECT_GT(hits, 700);
}

std::optional<float> closest(std::span<const CurveSegment> strand, const Ray& ray) {
  std::optional<float> t;
  const CurveRay seen(ray, ray.t_min, ray.t_max);
  for (const CurveSegment& c : strand)
    if (const auto hit = intersect_curve(c, seen); hit && (!t || hit->t < *t)) t = hit->t;
  return t;
}

TEST(CurvesStatistical, StrandsHaveNoGaps) {
  // Rays through the axis at and near the joints, as close as floats come.
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  for (std::uint32_t form : {std::uint32_t{CurveSegment::tube}, std::uint32_t{CurveSegment::ribbon}})
    for (float radius : {0.05f, 0.002f})
      for (int i = 0; i < 3000; ++i) {
        const auto strand = wavy_strand(random, 4, radius, form);
        const CurveSegment& c = strand[1 + random.below(2)];
        const float near = random.uniform() < 0.3f ? 0 : std::exp2(random.uniform(-24, -3));
        const vec3 target = vec3(glm::vec4(curve_at(c, static_cast<double>(near))));
        const vec3 direction = random.direction(), origin = target - 3.0f * direction;
        ASSERT_TRUE(closest(strand, {origin, 0, target - origin, kInfinity}))
            << "form " << form << ", radius " << radius << ", u " << near;
      }
}

/// How deep a point lies inside of the balls along a curve; negative outside.
double depth_inside(const CurveSegment& c, glm::dvec3 x) {
  double depth = -1e300, best = 0;
  auto look = [&](double u) {
    const glm::dvec4 p = curve_at(c, u);
    if (const double d = p.w - glm::length(glm::dvec3(p) - x); d > depth) depth = d, best = u;
  };
  for (int i = 0; i <= 1000; ++i) look(i / 1000.0);
  for (double step = 1e-3; step > 1e-9; step *= 0.25) {
    const double middle = best;
    for (int i = -4; i <= 4; ++i) look(std::clamp(middle + i * step / 4, 0.0, 1.0));
  }
  return depth;
}

TEST(CurvesStatistical, RaysLeaveTubesFromInside) {
  // A ray along a bent tube may leave it and enter it again: then it comes from outside. Pieces are straight
  // but for a thousandth of the radius.
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  int entered = 0;
  for (float bend : {0.0f, 0.02f})
    for (int i = 0; i < 3000; ++i) {
      CurveSegment c = random_curve(random, bend, 0.05f, kClosed);
      for (vec4& p : c.points) p.w = 0.05f;
      const double u = static_cast<double>(random.uniform(0.2f, 0.8f));
      const vec3 inside = vec3(glm::vec4(curve_at(c, u))) + 0.04f * random.direction();
      const Ray ray{inside, 0, random.direction(), kInfinity};
      const auto hit = intersect_curve(c, CurveRay(ray, 0, kInfinity));
      if (!hit) continue;
      ++entered;
      const double before = static_cast<double>(hit->t) - 1e-4;
      EXPECT_LT(depth_inside(c, glm::dvec3(ray.origin) + before * glm::dvec3(ray.direction)), 1e-3 * 0.05)
          << bend << " t " << hit->t;
    }
  EXPECT_LT(entered, 10);
}

TEST(CurvesStatistical, RaysLeaveRibbonsWhereTheyBegin) {
  // All but rays nearly along them: the tube about a ribbon is taken for straight, and not for endless.
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  int left = 0;
  for (float bend : {0.0f, 0.02f})
    for (int i = 0; i < 3000; ++i) {
      CurveSegment c = random_curve(random, bend, 0.02f, CurveSegment::ribbon | kCut);
      for (vec4& p : c.points) p.w = 0.02f;
      const Ray ray = ray_near(random, c, 0.01f);
      const auto hit = intersect_curve(c, CurveRay(ray, 0, kInfinity));
      if (!hit) continue;
      const Ray leaving{ray.at(hit->t), 0, random.direction(), kInfinity};
      const vec3 chord = glm::normalize(vec3(c.points[3] - c.points[0]));
      const float limit = bend > 0 ? 0.9f : 0.9997f;
      if (std::abs(glm::dot(chord, glm::normalize(leaving.direction))) > limit) continue;
      ++left;
      ASSERT_FALSE(intersect_curve(c, CurveRay(leaving, 0, kInfinity)));
    }
  EXPECT_GT(left, 3000);
}

/// The share of the square [-1, 1]^2 that parallel rays along -z find covered.
double coverage(const CurveSegment& c, int n) {
  int hits = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const vec2 p =
          (2.0f * (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / static_cast<float>(n)) - 1.0f;
      hits += intersect_curve(c, CurveRay({vec3(p, 2), 0, {0, 0, -1}, kInfinity}, 0, kInfinity)).has_value();
    }
  return hits / static_cast<double>(n) / n;
}

TEST(Curves, RibbonsCoverTheirWidthTimesTheirLength) {
  const std::uint32_t flags = CurveSegment::ribbon | kCut;
  constexpr int kGrid = 600;
  const double tolerance = 2 * 3.2 / kGrid / 4 * 1.5; // the outline's pixels
  // Straight, tapered, and going away from the viewer: only its length is seen foreshortened.
  const CurveSegment straight{{vec4(-0.7f, -0.4f, 0, 0.1f), vec4(-0.2333f, -0.1333f, -0.3f, 0.0833f),
                               vec4(0.2333f, 0.1333f, -0.6f, 0.0667f), vec4(0.7f, 0.4f, -0.9f, 0.05f)},
                              flags};
  const double seen = std::hypot(1.4, 0.8);
  EXPECT_NEAR(coverage(straight, kGrid), seen * 0.15 / 4, tolerance);
  // A quarter of a circle of radius 0.8: a strip along an arc has the area of its width times the arc.
  const float k = 0.8f * 0.5522848f;
  const CurveSegment arc{
      {vec4(0.8f, 0, 0, 0.1f), vec4(0.8f, k, 0, 0.1f), vec4(k, 0.8f, 0, 0.1f), vec4(0, 0.8f, 0, 0.1f)},
      flags};
  EXPECT_NEAR(coverage(arc, kGrid), 0.2 * 0.8 * std::numbers::pi / 2 / 4, tolerance);
}

} // namespace
} // namespace candela::test
