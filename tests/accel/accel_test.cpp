// Closest and any hits against all primitives tested one by one in double precision.

#include "accel/accel.h"
#include "brute_force.h"
#include "core/error.h"
#include "support/seed.h"

namespace {

using namespace candela;
using namespace candela::test;

TestScene random_triangles(Random& random, int count, float size) {
  TestScene scene;
  for (int i = 0; i < count; ++i) {
    vec3 c = random.in_cube();
    vec3 a = c + random.in_cube(size), b = c + random.in_cube(size);
    scene.add_triangle(c + random.in_cube(size), a, b);
  }
  return scene;
}

void add_round(Random& random, TestScene& scene, int count) {
  for (int i = 0; i < count; ++i) {
    vec3 c = random.in_cube();
    scene.spheres.push_back({c, random.uniform(0.01f, 0.3f)});
    c = random.in_cube();
    vec3 n = random.direction();
    scene.discs.push_back({c, random.uniform(0.01f, 0.4f), n});
  }
}

/// Near a primitive; instances lie within the unit cube.
vec3 random_target(const TestScene& scene, Random& random) {
  vec3 jitter = random.in_cube(0.2f);
  auto among = [&](std::size_t n) { return random.below(static_cast<std::uint32_t>(n)); };
  switch (random.below(4)) {
  case 0:
    if (!scene.triangles.empty()) {
      uvec3 t = scene.triangles[among(scene.triangles.size())];
      float u = random.uniform(), v = random.uniform();
      return glm::mix(glm::mix(scene.vertices[t.x], scene.vertices[t.y], u), scene.vertices[t.z], v) +
             0.3f * jitter;
    }
    [[fallthrough]];
  case 1:
    if (!scene.spheres.empty()) return scene.spheres[among(scene.spheres.size())].center + jitter;
    [[fallthrough]];
  case 2:
    if (!scene.discs.empty()) return scene.discs[among(scene.discs.size())].center + jitter;
  }
  return random.in_cube();
}

/// From inside and outside the unit cube, of any length, with any range of t.
Ray random_ray(const TestScene& scene, Random& random) {
  Ray ray;
  ray.origin = random.in_cube(random.uniform(0.1f, 4));
  ray.direction = (random_target(scene, random) - ray.origin) * std::exp(random.uniform(-7, 7));
  float length = glm::length(ray.direction);
  if (random.below(4) == 0) ray.t_min = random.uniform(0, 2) / length;
  if (random.below(3) == 0) ray.t_max = ray.t_min + random.uniform(0, 4) / length;
  return ray;
}

class AccelAgainstAll : public testing::Test {
protected:
  Random random{fresh_seed()};
  testing::ScopedTrace trace{__FILE__, __LINE__, seed_note()};
  RayCount seen;
  int traced = 0;

  void check_random_rays(const TestScene& scene, int rays) {
    for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
      Accel accel = Accel::build(scene.input(), quality);
      for (int i = 0; i < rays; ++i) {
        SCOPED_TRACE(testing::Message() << "ray " << i);
        ASSERT_NO_FATAL_FAILURE(check_ray(scene, accel, random_ray(scene, random), seen));
      }
      traced += rays;
    }
  }
  /// Else a test would say nothing.
  void TearDown() override {
    EXPECT_GT(seen.certain_hits, traced / 30);
    EXPECT_GT(seen.misses, 0);
  }
};

TEST_F(AccelAgainstAll, FewTriangles) {
  for (int count : {1, 2, 7, 8, 9, 17, 36}) check_random_rays(random_triangles(random, count, 0.8f), 500);
}

TEST_F(AccelAgainstAll, ManyTriangles) {
  check_random_rays(random_triangles(random, 2000, 0.1f), 1500);
  check_random_rays(random_triangles(random, 300, 1.0f), 1500);
}

TEST_F(AccelAgainstAll, Spheres) {
  for (int count : {1, 5, 300}) {
    TestScene scene;
    for (int i = 0; i < count; ++i) {
      vec3 c = random.in_cube(count == 1 ? 0.1f : 1.0f);
      scene.spheres.push_back({c, random.uniform(0.05f, 0.5f)});
    }
    check_random_rays(scene, 1000);
  }
}

TEST_F(AccelAgainstAll, Discs) {
  for (int count : {5, 300}) {
    TestScene scene;
    for (int i = 0; i < count; ++i) {
      vec3 c = random.in_cube();
      vec3 n = random.direction();
      scene.discs.push_back({c, random.uniform(0.05f, 0.6f), n});
    }
    check_random_rays(scene, 1000);
  }
}

TEST_F(AccelAgainstAll, MixedKinds) {
  TestScene scene = random_triangles(random, 300, 0.2f);
  add_round(random, scene, 100);
  check_random_rays(scene, 2000);
}

TEST_F(AccelAgainstAll, Instances) {
  TestScene triangles = random_triangles(random, 100, 0.5f), mixed = random_triangles(random, 5, 1.0f);
  add_round(random, mixed, 4);
  Accel first = Accel::build(triangles.input()), second = Accel::build(mixed.input());
  TestScene scene = random_triangles(random, 50, 0.2f);
  add_round(random, scene, 10);
  for (int i = 0; i < 30; ++i) {
    mat4 m = glm::translate(mat4(1), random.in_cube());
    m = glm::rotate(m, random.uniform(0, 6), random.direction());
    // Non-uniform, and mirrored every third time.
    vec3 scale(random.uniform(0.1f, 0.5f), random.uniform(0.1f, 0.5f), random.uniform(0.1f, 0.5f));
    m = glm::scale(m, i % 3 ? scale : -scale);
    m = glm::rotate(m, random.uniform(0, 6), random.direction());
    scene.instances.push_back({i % 2 ? &first : &second, m});
    scene.objects.push_back(i % 2 ? &triangles : &mixed);
  }
  check_random_rays(scene, 1500);
}

/// Directions with components of 0 and -0, from origins on the planes of boxes.
TEST_F(AccelAgainstAll, AxisParallelRays) {
  TestScene scene;
  for (int i = 0; i < 500; ++i) {
    auto lattice = [&] {
      float x = static_cast<float>(random.below(9)), y = static_cast<float>(random.below(9));
      return vec3(x, y, static_cast<float>(random.below(9)));
    };
    vec3 a = lattice(), b = lattice(), c = lattice();
    if (glm::cross(b - a, c - a) != vec3(0)) scene.add_triangle(a, b, c);
  }
  scene.spheres.push_back({{4, 4, 4}, 1});
  scene.discs.push_back({{2, 2, 2}, 2, {0, 0, 1}});
  Accel accel = Accel::build(scene.input());
  for (; traced < 2000; ++traced) {
    Ray ray;
    // Often on a plane of many boxes, but beside the edges in the other axis.
    ray.origin = {static_cast<float>(random.below(12)) - 1.5f, static_cast<float>(random.below(11)) - 1,
                  random.uniform(-1, 9)};
    ray.direction = vec3(random.below(2) ? 0.0f : -0.0f);
    ray.direction[static_cast<int>(random.below(3))] = random.below(2) ? 2.0f : -0.5f;
    if (random.below(2)) ray.direction[static_cast<int>(random.below(3))] = random.below(2) ? 1.0f : -1.0f;
    SCOPED_TRACE(testing::Message() << "ray " << traced);
    ASSERT_NO_FATAL_FAILURE(check_ray(scene, accel, ray, seen));
  }
}

TEST(AccelRange, IsOpenAtBothEnds) {
  TestScene scene;
  scene.add_triangle({-1, -1, 2}, {3, -1, 2}, {-1, 3, 2});
  scene.discs.push_back({{0, 0, 4}, 1, {0, 0, 1}});
  scene.spheres.push_back({{0, 0, 9}, 1});
  Accel accel = Accel::build(scene.input());
  auto t_in = [&](float t_min, float t_max) {
    auto hit = accel.intersect({{0, 0, 0}, t_min, {0, 0, 1}, t_max});
    EXPECT_EQ(accel.occluded({{0, 0, 0}, t_min, {0, 0, 1}, t_max}), hit.has_value());
    return hit ? hit->t : -1;
  };
  EXPECT_EQ(t_in(0, kInfinity), 2);
  EXPECT_EQ(t_in(-5, kInfinity), 2);
  EXPECT_EQ(t_in(0, 2), -1);
  EXPECT_EQ(t_in(0, std::nextafter(2.0f, 3.0f)), 2);
  EXPECT_EQ(t_in(2, kInfinity), 4);
  EXPECT_EQ(t_in(4, kInfinity), 8);
  EXPECT_EQ(t_in(8, kInfinity), 10); // the sphere's far side
  EXPECT_EQ(t_in(8, 10), -1);
  EXPECT_EQ(t_in(10, kInfinity), -1);
}

TEST(AccelHit, NamesVerticesAndPrimitives) {
  TestScene scene;
  scene.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Accel accel = Accel::build(scene.input());
  auto hit = accel.intersect({{0.5f, 0.25f, -1}, 0, {0, 0, 1}, kInfinity});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 1);
  EXPECT_FLOAT_EQ(hit->u, 0.5f);
  EXPECT_FLOAT_EQ(hit->v, 0.25f);
  EXPECT_EQ(hit->primitive, 0u);
  EXPECT_EQ(hit->instance, kNoInstance);
  EXPECT_EQ(hit->kind, PrimitiveKind::triangle);
  // The same from behind.
  hit = accel.intersect({{0.5f, 0.25f, 1}, 0, {0, 0, -1}, kInfinity});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->u, 0.5f);
  EXPECT_FLOAT_EQ(hit->v, 0.25f);
}

/// Where the textbook quadratic loses all digits: seen from 1000 radii away, or from 1e-4 above the ground of
/// a planet.
TEST(AccelSphere, KeepsPrecision) {
  struct Case {
    float radius, distance;
  };
  for (Case c : {Case{1, 2000}, Case{0.01f, 1000}, Case{6.4e6f, 6.4e6f + 2}, Case{1e5f, 1e5f + 0.0625f}}) {
    SphereGeometry sphere{{0, 0, c.distance}, c.radius};
    AccelInput input;
    input.spheres = {&sphere, 1};
    Accel accel = Accel::build(input);
    for (float offset : {0.0f, 0.3f, 0.7f}) {
      Ray ray{{0, 0, 0}, 0, {0, 0, 1}, kInfinity};
      float x = offset * c.radius;
      ray.origin.x = x;
      double half = std::sqrt(double(c.radius) * c.radius - double(x) * x);
      double expected = double(c.distance) - half;
      auto hit = accel.intersect(ray);
      ASSERT_TRUE(hit) << c.radius << " " << c.distance;
      // Half an ulp of what the input itself can tell: the distance.
      EXPECT_NEAR(hit->t, expected, 4 * 0x1p-24 * (half + expected)) << c.radius << " " << c.distance;
    }
  }
}

TEST(AccelInstance, KeepsTAndIndices) {
  TestScene object;
  object.add_triangle({9, 9, 0}, {10, 9, 0}, {9, 10, 0}); // never hit
  object.add_triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  Accel inner = Accel::build(object.input());
  mat4 far_one = glm::translate(mat4(1), vec3(0, 0, 10));
  mat4 near_one = glm::scale(glm::translate(mat4(1), vec3(0, 0, 4)), vec3(2, 3, -0.5f));
  TestScene scene;
  scene.instances = {{&inner, far_one}, {&inner, near_one}};
  Accel accel = Accel::build(scene.input());
  auto hit = accel.intersect({{0, 0, 0}, 0, {0, 0, 2}, kInfinity});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 2);
  EXPECT_EQ(hit->instance, 1u);
  EXPECT_EQ(hit->primitive, 1u);
  hit = accel.intersect({{0, 0, 0}, 2.5f, {0, 0, 2}, kInfinity});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 5);
  EXPECT_EQ(hit->instance, 0u);
  // Moving an Accel moves neither its tree nor those of its objects.
  Accel moved = std::move(accel), moved_object = std::move(inner);
  EXPECT_TRUE(moved.occluded({{0, 0, 0}, 0, {0, 0, 2}, kInfinity}));
  EXPECT_EQ(moved.stats().count(PrimitiveKind::instance), 2u);
}

TEST(AccelInstance, RefusesNesting) {
  TestScene object;
  object.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Accel inner = Accel::build(object.input());
  TestScene middle;
  middle.instances = {{&inner, mat4(1)}};
  Accel outer = Accel::build(middle.input());
  TestScene scene;
  scene.instances = {{&outer, mat4(1)}};
  EXPECT_THROW(Accel::build(scene.input()), Error);
}

} // namespace
