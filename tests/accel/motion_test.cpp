// What moves is hit, at every time, exactly as if it stood still where it is then.

#include "accel/brute_force.h"
#include "support/seed.h"

namespace {

using namespace candela;
using namespace candela::test;

Ray random_ray(Random& random, float time) {
  const vec3 origin = random.in_cube(3), target = random.in_cube(1.5f);
  Ray ray{origin, 0, (target - origin) * random.uniform(0.2f, 3), kInfinity, time};
  if (random.below(3) == 0) ray.t_max = random.uniform(0, 3);
  return ray;
}

struct HitCount {
  int hits = 0, misses = 0;
};

/// Alone and in a packet with rays of other times.
void expect_same_hits(const Accel& moving, const Accel& frozen, std::span<const Ray> rays,
                      std::uint32_t instance_bit, PrimitiveKind moved, HitCount& seen) {
  std::vector<const Ray*> pointers;
  for (const Ray& ray : rays) pointers.push_back(&ray);
  std::vector<Hit> together(rays.size());
  const auto occluded = std::make_unique<bool[]>(rays.size());
  moving.intersect(pointers, together);
  moving.occluded(pointers, {occluded.get(), rays.size()});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    auto expected = frozen.intersect(rays[i]);
    const auto hit = moving.intersect(rays[i]);
    ASSERT_EQ(hit.has_value(), expected.has_value());
    ASSERT_EQ(moving.occluded(rays[i]), hit.has_value());
    ASSERT_EQ(occluded[i], hit.has_value());
    ASSERT_EQ(together[i].t, hit ? hit->t : kInfinity);
    ++(hit ? seen.hits : seen.misses);
    if (!hit) continue;
    if (expected->instance != kNoInstance)
      expected->instance |= instance_bit;
    else if (expected->kind == PrimitiveKind::triangle)
      expected->kind = moved;
    ASSERT_EQ(hit->kind, expected->kind);
    ASSERT_EQ(hit->primitive, expected->primitive);
    ASSERT_EQ(hit->instance, expected->instance);
    ASSERT_EQ(hit->t, expected->t);
    ASSERT_EQ(hit->u, expected->u);
    ASSERT_EQ(hit->v, expected->v);
    ASSERT_EQ(together[i].primitive, hit->primitive);
  }
}

TEST(MotionStatistical, TrianglesAreHitAsThoseOfTheTime) {
  SCOPED_TRACE(seed_note());
  Random random(fresh_seed());
  HitCount seen;
  for (int count : {1, 9, 400}) {
    std::vector<vec3> begin, end;
    std::vector<uvec3> triangles;
    for (int i = 0; i < count; ++i) {
      const auto first = static_cast<std::uint32_t>(begin.size());
      const vec3 center = random.in_cube(), way = random.in_cube();
      for (int k = 0; k < 3; ++k) {
        begin.push_back(center + random.in_cube(0.4f));
        end.push_back(begin.back() + way + random.in_cube(0.4f));
      }
      triangles.emplace_back(first, first + 1, first + 2);
    }
    AccelInput input;
    input.moving_vertices = begin, input.moving_vertices_end = end, input.moving_triangles = triangles;
    const Accel moving = Accel::build(input);
    EXPECT_EQ(moving.stats().count(PrimitiveKind::moving_triangle), static_cast<std::size_t>(count));
    for (float time : {0.0f, 1.0f, random.uniform(), random.uniform(), random.uniform()}) {
      std::vector<vec3> now;
      for (std::size_t i = 0; i < begin.size(); ++i) now.push_back(at_time(begin[i], end[i], time));
      AccelInput still;
      still.vertices = now, still.triangles = triangles;
      const Accel frozen = Accel::build(still);
      std::vector<Ray> rays;
      for (int i = 0; i < 1000; ++i) rays.push_back(random_ray(random, time));
      ASSERT_NO_FATAL_FAILURE(
          expect_same_hits(moving, frozen, rays, 0, PrimitiveKind::moving_triangle, seen));
    }
  }
  EXPECT_GT(seen.hits, 1000);
  EXPECT_GT(seen.misses, 1000);
}

TEST(MotionStatistical, InstancesAreHitAsThoseOfTheTime) {
  SCOPED_TRACE(seed_note());
  Random random(fresh_seed());
  TestScene object;
  for (int i = 0; i < 40; ++i) {
    const vec3 c = random.in_cube(0.5f);
    object.add_triangle(c, c + random.in_cube(0.3f), c + random.in_cube(0.3f));
  }
  object.spheres.push_back({random.in_cube(0.5f), 0.2f});
  object.discs.push_back({random.in_cube(0.5f), 0.3f, random.direction()});
  const Accel shared = Accel::build(object.input());
  std::vector<MovingInstanceGeometry> placed;
  for (int i = 0; i < 20; ++i) {
    MovingTransform m;
    m.world_from_object = glm::translate(glm::dmat4(1), glm::dvec3(random.in_cube()));
    m.world_from_object *= glm::dmat4(rotation_about(random.direction(), random.uniform(0, 6)));
    const glm::dvec3 size(random.uniform(0.3f, 1), random.uniform(0.3f, 1), random.uniform(0.3f, 1));
    m.world_from_object *= glm::scale(glm::dmat4(1), i % 3 ? size : -size);
    m.pivot = random.in_cube();
    m.translation = random.in_cube();
    m.axis = random.direction();
    m.angle = random.uniform(-9, 9);
    m.scale = {random.uniform(0.5f, 2), random.uniform(0.5f, 2), 1};
    placed.push_back({&shared, m});
  }
  AccelInput input;
  input.moving_instances = placed;
  const Accel moving = Accel::build(input);
  HitCount seen;
  for (int round = 0; round < 8; ++round) {
    const float time = round == 0 ? 0 : round == 1 ? 1 : random.uniform();
    std::vector<InstanceGeometry> still;
    for (const MovingInstanceGeometry& instance : placed)
      still.push_back({&shared, mat4(instance.placement.at(static_cast<double>(time)))});
    AccelInput frozen_input;
    frozen_input.instances = still;
    const Accel frozen = Accel::build(frozen_input);
    std::vector<Ray> rays;
    for (int i = 0; i < 1500; ++i) rays.push_back(random_ray(random, time));
    ASSERT_NO_FATAL_FAILURE(
        expect_same_hits(moving, frozen, rays, kMovingInstance, PrimitiveKind::triangle, seen));
  }
  EXPECT_GT(seen.hits, 1000);
  EXPECT_GT(seen.misses, 1000);
}

/// Rays of different times in one packet, and none that moves in the way of those that do not.
TEST(MotionStatistical, PacketsMixTimes) {
  SCOPED_TRACE(seed_note());
  Random random(fresh_seed());
  TestScene object;
  object.spheres.push_back({vec3(0), 0.3f});
  const Accel ball = Accel::build(object.input());
  TestScene wall;
  wall.add_triangle({-30, -30, 2}, {30, -30, 2}, {0, 40, 2});
  MovingTransform flight;
  flight.world_from_object = glm::translate(glm::dmat4(1), glm::dvec3(-2, 0, 0));
  flight.translation = {4, 0, 0};
  const std::vector<MovingInstanceGeometry> placed{{&ball, flight}};
  AccelInput input = wall.input();
  input.moving_instances = placed;
  const Accel accel = Accel::build(input);
  std::vector<Ray> rays;
  for (int i = 0; i < 64; ++i) {
    const float time = random.uniform();
    rays.push_back({{-2 + 4 * time + (i % 2 ? 0.0f : 0.5f), 0, -5}, 0, {0, 0, 1}, kInfinity, time});
  }
  std::vector<const Ray*> pointers;
  for (const Ray& ray : rays) pointers.push_back(&ray);
  std::vector<Hit> hits(rays.size());
  accel.intersect(pointers, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].kind, i % 2 ? PrimitiveKind::sphere : PrimitiveKind::triangle);
    EXPECT_NEAR(hits[i].t, i % 2 ? 4.7f : 7.0f, 1e-5f);
  }
}

TEST(Motion, ObjectsThatHoldInstancesAreRefused) {
  TestScene object;
  object.spheres.push_back({vec3(0), 1});
  const Accel ball = Accel::build(object.input());
  const std::vector<MovingInstanceGeometry> placed{{&ball, {}}};
  AccelInput input;
  input.moving_instances = placed;
  const Accel moving = Accel::build(input);
  const std::vector<InstanceGeometry> around{{&moving, mat4(1)}};
  AccelInput outer;
  outer.instances = around;
  EXPECT_ANY_THROW(Accel::build(outer));
}

TEST(Motion, WhatHasNoPlaceIsLeftOut) {
  TestScene object;
  object.spheres.push_back({vec3(0), 1});
  const Accel ball = Accel::build(object.input()), nothing;
  MovingTransform flat, far;
  flat.world_from_object = glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 1));
  far.translation = glm::dvec3(1e30, 0, 0);
  const std::vector<MovingInstanceGeometry> placed{
      {&ball, flat}, {&ball, far}, {&nothing, {}}, {nullptr, {}}};
  AccelInput input;
  input.moving_instances = placed;
  const Accel accel = Accel::build(input);
  EXPECT_EQ(accel.stats().skipped, 4u);
  EXPECT_FALSE(accel.intersect({{0, 0, -5}, 0, {0, 0, 1}, kInfinity}));
}

} // namespace
