// Placements that change in time, and the boxes that hold them.

#include "core/moving_transform.h"
#include "support/seed.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <random>

namespace {

using namespace candela;
using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

class Random {
public:
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(engine_) == 1; }
  dvec3 point(double size) {
    const double x = number(-size, size), y = number(-size, size);
    return {x, y, number(-size, size)};
  }
  dvec3 direction() {
    for (;;)
      if (const dvec3 v = point(1); glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
  }
  /// Now and then along an axis of the world, still, of several turns, or without scaling.
  MovingTransform transform() {
    MovingTransform m;
    m.world_from_object = glm::translate(dmat4(1), point(one_in(4) ? 1e4 : 5));
    m.world_from_object *= dmat4(rotation_about(direction(), number(0, 6)));
    m.world_from_object *= glm::scale(dmat4(1), dvec3(number(0.1, 3), number(0.1, 3), number(0.1, 3)));
    if (!one_in(3)) m.pivot = point(2);
    if (!one_in(3)) m.translation = point(one_in(3) ? 20 : 2);
    m.axis = one_in(4) ? dvec3(0, 1, 0) : direction();
    if (!one_in(5)) m.angle = one_in(3) ? number(-60, 60) : number(-7, 7);
    if (one_in(2)) m.scale = {number(0.1, 4), number(0.1, 4), number(0.1, 4)};
    return m;
  }
  Bounds3 box() {
    const vec3 a(point(2)), b(point(2));
    return {glm::min(a, b), glm::max(a, b)};
  }

private:
  std::mt19937_64 engine_{test::fresh_seed()};
};

dvec3 point_in(Random& random, const Bounds3& box) {
  dvec3 p;
  for (int a = 0; a < 3; ++a) {
    const double u = random.number(-0.5, 1.5); // corners, edges and faces, too
    p[a] = glm::mix(double(box.lo[a]), double(box.hi[a]), std::clamp(u, 0.0, 1.0));
  }
  return p;
}

TEST(MovingTransformStatistical, EveryPointIsInTheBoundsAtAllTimes) {
  SCOPED_TRACE(test::seed_note());
  Random random;
  for (int i = 0; i < 300; ++i) {
    const MovingTransform m = random.transform();
    const Bounds3 box = random.box(), bounds = m.bounds(box);
    for (int k = 0; k < 400; ++k) {
      const double time = random.one_in(20) ? 1 : random.number(0, 1);
      const vec3 p(m.at(time) * dvec4(point_in(random, box), 1));
      for (int a = 0; a < 3; ++a) {
        ASSERT_GE(p[a], bounds.lo[a]) << "axis " << a << ", time " << time << ", angle " << m.angle;
        ASSERT_LE(p[a], bounds.hi[a]) << "axis " << a << ", time " << time << ", angle " << m.angle;
      }
    }
  }
}

/// Else a tree of moving things would be a list.
TEST(MovingTransformStatistical, TheBoundsAreHardlyLargerThanTheyMustBe) {
  SCOPED_TRACE(test::seed_note());
  Random random;
  for (int i = 0; i < 50; ++i) {
    MovingTransform m = random.transform();
    m.world_from_object[3] = dvec4(random.point(5), 1);
    const Bounds3 box = random.box(), bounds = m.bounds(box);
    Bounds3 seen;
    for (int k = 0; k <= 20000; ++k)
      for (int corner = 0; corner < 8; ++corner)
        seen.grow(
            vec3(m.at(k / 20000.0) * dvec4(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                                           corner & 4 ? box.hi.z : box.lo.z, 1)));
    const float size = max_component(seen.diagonal());
    EXPECT_LT(max_component(glm::abs(bounds.lo - seen.lo)), 0.02f * size) << m.angle;
    EXPECT_LT(max_component(glm::abs(bounds.hi - seen.hi)), 0.02f * size) << m.angle;
  }
}

TEST(MovingTransform, ADiscThatSpinsInItsPlaneStaysFlat) {
  MovingTransform m;
  m.angle = 100;
  const Bounds3 bounds = m.bounds({vec3(-1, -1, 0), vec3(1, 1, 0)});
  EXPECT_EQ(bounds.lo.z, 0);
  EXPECT_EQ(bounds.hi.z, 0);
  EXPECT_NEAR(bounds.hi.x, std::sqrt(2.0), 0.01);
}

TEST(MovingTransformStatistical, BelowHalfATurnItIsTheSlerpOfQuaternions) {
  SCOPED_TRACE(test::seed_note());
  Random random;
  for (int i = 0; i < 200; ++i) {
    MovingTransform m;
    m.world_from_object = dmat4(rotation_about(random.direction(), random.number(0, 6)));
    m.axis = random.direction(), m.angle = random.number(0, 3.1);
    m.translation = random.point(3);
    const glm::dquat begin = glm::quat_cast(dmat3(m.at(0))), end = glm::quat_cast(dmat3(m.at(1)));
    const double time = random.number(0, 1);
    const dmat3 turned = glm::mat3_cast(glm::slerp(begin, end, time)), mine(m.at(time));
    for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(turned[c] - mine[c]), 1e-9);
    EXPECT_LT(glm::length(dvec3(m.at(time)[3]) - time * m.translation), 1e-12);
  }
}

TEST(MovingTransformStatistical, ThePivotGoesStraightAndTheObjectGrowsAlongItsOwnAxes) {
  SCOPED_TRACE(test::seed_note());
  Random random;
  for (int i = 0; i < 100; ++i) {
    const MovingTransform m = random.transform();
    const double time = random.number(0, 1), size = glm::length(dvec3(m.world_from_object[3])) + 50;
    const dvec3 start(m.at(0) * dvec4(m.pivot, 1)), there(m.at(time) * dvec4(m.pivot, 1));
    EXPECT_LT(glm::length(there - start - time * m.translation), 1e-12 * size);
    EXPECT_LT(glm::length(start - dvec3(m.world_from_object * dvec4(m.pivot, 1))), 1e-12 * size);
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(glm::length(dvec3(m.at(time)[a])),
                  glm::length(dvec3(m.world_from_object[a])) * (1 + time * (m.scale[a] - 1)), 1e-9);
  }
}

TEST(MovingTransformStatistical, AxisAndAngleGiveTheRotationBack) {
  SCOPED_TRACE(test::seed_note());
  Random random;
  const double pi = std::numbers::pi;
  for (int i = 0; i < 200; ++i)
    for (double angle : {0.0, 1e-9, 1e-5, random.number(0, pi), pi - 1e-9, pi}) {
      const dmat3 r = rotation_about(random.one_in(3) ? dvec3(0, 0, -1) : random.direction(), angle);
      const AxisAngle found = axis_angle(r);
      const dmat3 again = rotation_about(found.axis, found.angle);
      for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(r[c] - again[c]), 1e-5) << angle;
    }
}

} // namespace
