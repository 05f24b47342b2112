// Curves in the tree against all of them one by one.

#include "accel/curve_samples.h"
#include "accel/traversal.h"

namespace candela::test {
namespace {

using accel_detail::CurveRay;
using accel_detail::intersect_curve;

/// All lanes of either implementation, and the tree, give what one curve after the other gives.
TEST(CurvesStatistical, TreesFindWhatTestsOneByOneFind) {
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  std::vector<CurveSegment> curves;
  for (int i = 0; i < 60; ++i)
    for (const CurveSegment& c : wavy_strand(random, 5, random.uniform() < 0.5f ? 0.02f : 0.003f,
                                             i % 3 == 0 ? CurveSegment::ribbon : CurveSegment::tube))
      curves.push_back(c);
  TestScene other; // and other kinds among them
  for (int i = 0; i < 20; ++i) other.spheres.push_back({random.in_cube(), 0.03f});
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
    AccelInput input = other.input();
    input.curves = curves;
    const Accel accel = Accel::build(input, quality);
    EXPECT_EQ(accel.stats().count(PrimitiveKind::curve), curves.size());
    const Accel spheres = Accel::build(other.input(), quality);
    std::vector<Ray> rays;
    for (int i = 0; i < 4000; ++i) {
      Ray ray{random.in_cube(1.5f), 0, random.direction(), kInfinity};
      if (i % 2 == 0)
        ray = ray_near(random, curves[random.below(static_cast<std::uint32_t>(curves.size()))], 0.02f);
      if (i % 3 == 0) ray.t_min = random.uniform(0, 2), ray.t_max = ray.t_min + random.uniform(0, 3);
      rays.push_back(ray);
    }
    int hits = 0;
    for (const Ray& ray : rays) {
      std::optional<float> t;
      std::uint32_t which = 0;
      const CurveRay seen(ray, ray.t_min, ray.t_max);
      for (std::uint32_t k = 0; k < curves.size(); ++k)
        if (const auto hit = intersect_curve(curves[k], seen); hit && (!t || hit->t < *t))
          t = hit->t, which = k;
      const auto ball = spheres.intersect(ray);
      const bool curve_first = t && (!ball || *t < ball->t);
      const auto found = accel.intersect(ray);
      ASSERT_EQ(found.has_value(), t || ball);
      ASSERT_EQ(accel.occluded(ray), found.has_value());
      if (!curve_first) continue;
      ++hits;
      ASSERT_EQ(found->kind, PrimitiveKind::curve);
      ASSERT_EQ(found->primitive, which);
      ASSERT_EQ(found->t, *t);
      const auto alone = intersect_curve(curves[which], seen);
      ASSERT_EQ(found->u, alone->u);
      Hit portable;
      ASSERT_TRUE(
          (accel_detail::trace<simd::PortableFloat8, false>(*AccelAccess::tree(accel), ray, portable)));
      ASSERT_EQ(portable.t, *t);
      ASSERT_EQ(portable.primitive, which);
    }
    EXPECT_GT(hits, 600);
    std::vector<const Ray*> together;
    for (const Ray& ray : rays) together.push_back(&ray);
    std::vector<Hit> batch(rays.size());
    accel.intersect(together, batch);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto found = accel.intersect(rays[i]);
      ASSERT_EQ(batch[i].t, found ? found->t : kInfinity);
    }
  }
}

TEST(Curves, DegenerateOnesAreLeftOut) {
  std::vector<CurveSegment> curves(5);
  curves[0].points = {vec4(0, 0, 0, 0), vec4(1, 0, 0, 0), vec4(2, 0, 0, 0), vec4(3, 0, 0, 0)}; // no width
  curves[1].points = {vec4(0, 0, 0, 1), vec4(kInfinity, 0, 0, 1), vec4(2, 0, 0, 1), vec4(3, 0, 0, 1)};
  curves[2].points = {vec4(0, 0, 0, std::nanf("")), vec4(1, 0, 0, 1), vec4(2, 0, 0, 1), vec4(3, 0, 0, 1)};
  curves[3].points = {vec4(0, 0, 0, 1), vec4(0, 0, 0, 1), vec4(0, 0, 0, 1), vec4(0, 0, 0, 1)}; // a ball
  curves[3].flags = kClosed;
  curves[4].points = {vec4(9, 0, 0, 1), vec4(9, 0, 0, 0), vec4(9, 0, 0, 0), vec4(9, 0, 0, 1)};
  AccelInput input;
  input.curves = curves;
  const Accel accel = Accel::build(input);
  EXPECT_EQ(accel.stats().skipped, 3u);
  const auto ball = accel.intersect({{0, 0, 5}, 0, {0, 0, -1}, kInfinity});
  ASSERT_TRUE(ball);
  EXPECT_NEAR(ball->t, 4, 1e-6f);
  accel.intersect({{9, 0, 5}, 0, {0, 0, -1}, kInfinity}); // ends
}

} // namespace
} // namespace candela::test
