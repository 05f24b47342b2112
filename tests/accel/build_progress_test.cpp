// Progress and cancellation of builds. The tree depends only on the input.

#include "accel/accel.h"
#include "brute_force.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <thread>

namespace {

using namespace candela;
using namespace candela::test;

TestScene many_triangles(int count) {
  Random random(fresh_seed());
  TestScene scene;
  for (int i = 0; i < count; ++i) {
    const vec3 c = random.in_cube();
    scene.add_triangle(c, c + random.in_cube(0.01f), c + random.in_cube(0.01f));
  }
  return scene;
}

TEST(BuildProgress, CancelledBeforehandItEndsAtOnce) {
  const TestScene scene = many_triangles(20000);
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
    Progress progress;
    progress.expect(Accel::build_work(scene.triangles.size()));
    progress.cancel();
    EXPECT_THROW(Accel::build(scene.input(), quality, &progress), Cancelled);
    EXPECT_EQ(progress.share(), 0);
  }
}

// From another thread, in each stage. Where the build was quicker than the hand, it is tried again.
TEST(BuildProgress, CancelledMeanwhileItEndsEarly) {
  const TestScene scene = many_triangles(300000);
  for (double at : {0.01, 0.3, 0.6, 0.8, 0.9}) {
    bool cancelled = false;
    for (int attempt = 0; attempt < 50 && !cancelled; ++attempt) {
      Progress progress;
      progress.expect(Accel::build_work(scene.triangles.size()));
      std::atomic<bool> over{false};
      std::thread hand([&] {
        while (progress.share() < at && !over) std::this_thread::yield();
        progress.cancel();
      });
      try {
        Accel::build(scene.input(), BuildQuality::high, &progress);
      } catch (const Cancelled&) {
        cancelled = true;
        EXPECT_GE(progress.share(), at);
        EXPECT_LT(progress.share(), 1);
      }
      over = true;
      hand.join();
    }
    EXPECT_TRUE(cancelled) << "at " << at;
  }
}

TEST(BuildProgress, ShareGrowsAndEndsAtOne) {
  Random random(fresh_seed());
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high})
    for (int count : {0, 1, 3000, 150000}) {
      TestScene scene = many_triangles(count);
      scene.add_triangle({1, 0, 0}, {1, 0, 0}, {1, 0, 0}); // left out
      for (int i = 0; i < 5; ++i) scene.spheres.push_back({random.in_cube(), 0.1f});
      Progress progress;
      progress.expect(Accel::build_work(scene.triangles.size() + scene.spheres.size()));
      std::vector<double> shares;
      std::atomic<bool> over{false};
      std::thread watch([&] {
        while (!over) {
          if (shares.empty() || progress.share() != shares.back()) shares.push_back(progress.share());
          std::this_thread::yield();
        }
      });
      const Accel accel = Accel::build(scene.input(), quality, &progress);
      over = true;
      watch.join();
      EXPECT_EQ(progress.share(), 1) << count;
      EXPECT_TRUE(std::ranges::is_sorted(shares));
    }
}

TEST(BuildProgress, MoreToDoNeverLowersTheShare) {
  Progress progress;
  EXPECT_EQ(progress.share(), 0);
  progress.expect(100);
  progress.advance(50);
  EXPECT_EQ(progress.share(), 0.5);
  progress.expect(100);
  EXPECT_EQ(progress.share(), 0.5);
  progress.advance(100);
  EXPECT_EQ(progress.share(), 0.75);
  {
    ProgressPart part(progress, 50);
    part.reach(0.5);
    EXPECT_EQ(progress.share(), 0.875);
    part.reach(0.25);
    EXPECT_EQ(progress.share(), 0.875);
  }
  EXPECT_EQ(progress.share(), 1);
}

TEST(BuildProgress, WatchedTheTreeIsTheSame) {
  const TestScene scene = many_triangles(50000);
  Progress progress;
  progress.expect(1); // less than there is
  const Accel plain = Accel::build(scene.input()),
              watched = Accel::build(scene.input(), BuildQuality::high, &progress);
  EXPECT_EQ(progress.share(), 1);
  EXPECT_EQ(plain.stats().nodes, watched.stats().nodes);
  EXPECT_EQ(plain.stats().sah_cost, watched.stats().sah_cost);
  Random random(fresh_seed());
  for (int i = 0; i < 1000; ++i) {
    Ray ray;
    ray.origin = random.in_cube(2), ray.direction = random.direction();
    const auto a = plain.intersect(ray), b = watched.intersect(ray);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) { EXPECT_EQ(a->t, b->t); }
    EXPECT_EQ(plain.cost(ray).nodes, watched.cost(ray).nodes);
  }
}

} // namespace
