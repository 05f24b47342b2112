// Difficult inputs for builders: empty, invalid, coincident, needle-shaped and huge primitives.

#include "accel/accel.h"
#include "accel/layout.h"
#include "brute_force.h"
#include "support/seed.h"

namespace {

using namespace candela;
using namespace candela::test;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const Ray kRay{{0.2f, 0.2f, -5}, 0, {0, 0, 1}, kInfinity};

TEST(AccelDegenerate, NothingAtAll) {
  for (const Accel& accel : {Accel(), Accel::build({})}) {
    EXPECT_FALSE(accel.intersect(kRay));
    EXPECT_FALSE(accel.occluded(kRay));
    EXPECT_TRUE(accel.bounds().empty());
    EXPECT_EQ(accel.stats().leaves, 0u);
  }
}

TEST(AccelDegenerate, LeavesOutWhatCannotBeHit) {
  TestScene scene;
  scene.add_triangle({0, 0, 0}, {1, kNaN, 0}, {0, 1, 0});
  scene.add_triangle({0, 0, 0}, {1, 0, kInfinity}, {0, 1, 0});
  scene.add_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  scene.add_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  scene.add_triangle({0, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0});
  scene.triangles.push_back({0, 1, 1000});
  scene.spheres = {
      {{0, 0, 0}, 0}, {{0, 0, 0}, -1}, {{0, kNaN, 0}, 1}, {{0, 0, 0}, kNaN}, {{0, 0, 0}, kInfinity}};
  scene.discs = {{{0, 0, 0}, 0, {0, 0, 1}}, {{0, 0, 0}, 1, {0, 0, 0}}, {{0, 0, 0}, 1, {0, kNaN, 1}}};
  Accel empty;
  TestScene object;
  object.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Accel inner = Accel::build(object.input());
  scene.instances = {{nullptr, mat4(1)},
                     {&empty, mat4(1)},
                     {&inner, glm::scale(mat4(1), vec3(1, 0, 1))},
                     {&inner, mat4(kNaN)}};
  std::size_t bad = 6 + 5 + 3 + 4;
  Accel accel = Accel::build(scene.input());
  EXPECT_EQ(accel.stats().skipped, bad);
  EXPECT_FALSE(accel.intersect(kRay));
  EXPECT_TRUE(accel.bounds().empty());

  // Among them, good ones keep their indices.
  scene.add_triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  accel = Accel::build(scene.input());
  EXPECT_EQ(accel.stats().skipped, bad);
  EXPECT_EQ(accel.stats().count(PrimitiveKind::triangle), 1u);
  auto hit = accel.intersect(kRay);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->primitive, scene.triangles.size() - 1);
  EXPECT_EQ(accel.bounds(), (Bounds3{vec3(-1, -1, 0), vec3(3, 3, 0)}));
}

TEST(AccelDegenerate, CopiesInOnePlace) {
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
    TestScene scene;
    for (int i = 0; i < 5000; ++i) scene.add_triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    for (int i = 0; i < 500; ++i) scene.spheres.push_back({{0, 0, 5}, 1});
    Accel accel = Accel::build(scene.input(), quality);
    auto hit = accel.intersect(kRay);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 5);
    EXPECT_LE(accel.stats().depth, 12);
    EXPECT_EQ(accel.stats().count(PrimitiveKind::triangle), 5000u);
  }
}

TEST(AccelDegenerate, ConcentricAndFlat) {
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  TestScene concentric, flat;
  for (int i = 1; i <= 300; ++i) concentric.spheres.push_back({{0, 0, 0}, static_cast<float>(i) * 0.01f});
  for (int i = 0; i < 500; ++i) {
    vec3 c = random.in_cube(), a = c + random.in_cube(0.1f), b = c + random.in_cube(0.1f);
    flat.add_triangle({a.x, a.y, 0}, {b.x, b.y, 0}, {c.x, c.y, 0});
  }
  for (const TestScene* scene : {&concentric, &flat}) {
    Accel accel = Accel::build(scene->input());
    RayCount count;
    for (int i = 0; i < 500; ++i) {
      vec3 origin = random.in_cube(4), target = random.in_cube(0.7f);
      target.z = 0;
      ASSERT_NO_FATAL_FAILURE(check_ray(*scene, accel, {origin, 0, target - origin, kInfinity}, count));
    }
    EXPECT_GT(count.certain_hits, 20);
    // Within the plane of the flat one: nothing to hit, nothing to go wrong.
    Ray in_plane{{-3, 0.1f, 0}, 0, {1, 0, 0}, kInfinity};
    accel.intersect(in_plane);
  }
}

/// Sizes and places over 36 powers of two: every split peels off a few, and the tree grows deep; the limit on
/// its depth (and so the traversal's stack) must hold.
TEST(AccelDegenerate, DepthStaysBounded) {
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
    TestScene scene;
    float x = 1e-10f;
    for (int i = 0; i < 3000; ++i, x *= 1.016f) scene.add_triangle({x, 0, 0}, {x, x, 0}, {x, 0, x});
    Accel accel = Accel::build(scene.input(), quality);
    EXPECT_EQ(accel.stats().skipped, 0u);
    EXPECT_LT(accel.stats().depth, kMaxDepth);
    int hits = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); i += 100) {
      vec3 p = scene.vertices[scene.triangles[i].x];
      Ray ray{{0, p.x * 0.25f, p.x * 0.25f}, 0.999f * p.x, {1, 0, 0}, 1.001f * p.x};
      auto hit = accel.intersect(ray);
      hits += hit && hit->primitive == i;
    }
    EXPECT_EQ(hits, 30);
  }
}

TEST(AccelDegenerate, RaysOfNonsenseEnd) {
  Random random(7);
  TestScene scene;
  for (int i = 0; i < 200; ++i) {
    vec3 c = random.in_cube(), a = random.in_cube();
    scene.add_triangle(c, a, random.in_cube());
    scene.spheres.push_back({random.in_cube(), 0.1f});
    scene.discs.push_back({random.in_cube(), 0.1f, {0, 0, 1}});
  }
  Accel accel = Accel::build(scene.input());
  for (float bad : {kNaN, kInfinity, -kInfinity, 1e38f, 1e-42f, 0.0f})
    for (int where = 0; where < 8; ++where) {
      Ray ray{{0, 0, -2}, 0, {0.1f, 0.1f, 1}, kInfinity};
      if (where < 3) ray.origin[where] = bad;
      if (where >= 3 && where < 6) ray.direction[where - 3] = bad;
      if (where == 6) ray.t_min = bad;
      if (where == 7) ray.t_max = bad;
      accel.intersect(ray);
      accel.occluded(ray);
    }
  EXPECT_FALSE(accel.intersect({{0, 0, -2}, 0, {0, 0, 0}, kInfinity}));
}

} // namespace
