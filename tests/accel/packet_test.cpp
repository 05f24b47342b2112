// A ray's hit depends neither on the other rays of its packet nor on the tree.

#include "accel/packet.h"
#include "brute_force.h"
#include "support/seed.h"

namespace {

using namespace candela;
using namespace candela::test;

/// A grid of n x n squares over [-1, 1]^2 at a height, each of two triangles: edges and vertices are shared,
/// boxes have no thickness if it is flat.
template <class Height>
void add_grid(TestScene& scene, int n, Height height) {
  auto at = [&](int i, int j) {
    const vec2 p = vec2(i, j) * (2.0f / static_cast<float>(n)) - 1.0f;
    return vec3(p, height(p));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      scene.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      scene.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

void add_round(TestScene& scene, Random& random, int count) {
  for (int i = 0; i < count; ++i) {
    const vec3 center = random.in_cube(), normal = random.direction();
    scene.spheres.push_back({random.in_cube(), random.uniform(0.01f, 0.2f)});
    scene.discs.push_back({center, random.uniform(0.01f, 0.2f), normal});
  }
}

vec3 some_vertex(const TestScene& scene, Random& random) {
  return scene.vertices[random.below(static_cast<std::uint32_t>(scene.vertices.size()))];
}

bool same(const Hit& a, const Hit& b) {
  return a.t == b.t && a.u == b.u && a.v == b.v && a.primitive == b.primitive && a.instance == b.instance &&
         a.kind == b.kind;
}

class AccelTies : public testing::Test {
protected:
  Random random{fresh_seed()};
  testing::ScopedTrace trace{__FILE__, __LINE__, seed_note()};
};

/// Where primitives are hit at the same t, as they are along shared edges, at shared vertices and where they
/// coincide.
TEST_F(AccelTies, ATreeDoesNotShow) {
  TestScene scene;
  add_grid(scene, 40, [](vec2) { return 0.0f; });
  add_grid(scene, 40, [](vec2 p) { return 0.25f * p.x - 0.5f; });
  add_round(scene, random, 100);
  for (std::size_t i = 0; i < 50; ++i) { // each once more, under other numbers
    scene.spheres.push_back(scene.spheres[i]);
    scene.discs.push_back(scene.discs[i]);
    scene.triangles.push_back(scene.triangles[i * 17]);
  }
  const Accel fast = Accel::build(scene.input(), BuildQuality::fast),
              high = Accel::build(scene.input(), BuildQuality::high);
  for (int i = 0; i < 100000; ++i) {
    const vec3 origin = vec3(random.in_cube(1.5f));
    const vec3 vertex = some_vertex(scene, random);
    vec3 target = vertex;
    if (i % 3 == 1) target = 0.5f * (vertex + some_vertex(scene, random));
    if (i % 3 == 2) target = random.in_cube();
    const Ray ray{i % 2 ? origin : vec3(vertex.x, vertex.y, origin.z), 0, target - origin, kInfinity};
    const auto a = fast.intersect(ray), b = high.intersect(ray);
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (a) { ASSERT_TRUE(same(*a, *b)) << i << ": " << a->primitive << " and " << b->primitive; }
  }
}

TEST_F(AccelTies, TheFirstOfCoincidentPrimitivesIsFound) {
  TestScene part;
  part.add_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  part.add_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  const Accel object = Accel::build(part.input());
  TestScene scene;
  const mat4 aside = glm::translate(mat4(1), vec3(20, 0, 0));
  for (int i = 0; i < 30; ++i) {
    scene.add_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    scene.spheres.push_back({{10, 0, 0}, 1});
    scene.discs.push_back({{0, 10, 0}, 1, {0, 0, 1}});
    scene.instances.push_back({&object, aside});
  }
  const Accel accel = Accel::build(scene.input());
  for (const vec3 place : {vec3(0), vec3(10, 0, 0), vec3(0, 10, 0), vec3(20, 0, 0)})
    for (int i = 0; i < 100; ++i) {
      const vec3 origin = place + vec3(random.in_cube(0.2f)) + vec3(0, 0, 3);
      const auto hit = accel.intersect({origin, 0, place - origin, kInfinity});
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->primitive, 0u);
      EXPECT_EQ(hit->instance, place.x == 20 ? 0 : kNoInstance);
    }
}

/// The ways in which rays can be neighbours, or not.
enum class Bundle { pinhole, lens, parallel, to_a_light, just_far_enough, diagonal, one, none };

std::vector<Ray> make_packet(Bundle bundle, const TestScene& scene, Random& random, std::size_t count) {
  const vec3 eye = random.in_cube(3), target = some_vertex(scene, random);
  const float spread = std::exp(random.uniform(-7, 0));
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 near_eye = eye + spread * random.in_cube(), near_target = target + spread * random.in_cube();
    // Every fourth goes to a vertex: through edges, along flat boxes.
    const vec3 there = i % 4 ? near_target : target;
    switch (bundle) {
    case Bundle::pinhole: rays.push_back({eye, 0, glm::normalize(there - eye), kInfinity}); break;
    case Bundle::lens: rays.push_back({near_eye, 0, glm::normalize(there - near_eye), kInfinity}); break;
    case Bundle::parallel: rays.push_back({near_eye, 0, target - eye, kInfinity}); break;
    case Bundle::to_a_light: rays.push_back({near_target, 0, eye - near_target, 1}); break;
    case Bundle::just_far_enough: { // or from just too far on
      const float t_min = i % 3 ? 0 : 1 + 0x1p-21f;
      rays.push_back({near_eye, t_min, target - near_eye, 1 + 0x1p-20f});
      break;
    }
    case Bundle::diagonal: { // some advance most along one axis, some along another
      const vec3 from = target + glm::length(eye) * vec3(1, 1 + random.uniform(-1, 1) * 0x1p-22f, 0.3f);
      rays.push_back({from, 0, target - from, kInfinity});
      break;
    }
    case Bundle::one: rays.assign({{eye, 0, target - eye, kInfinity}}); break;
    case Bundle::none: {
      const vec3 from = random.in_cube(3);
      rays.push_back({from, random.uniform(), some_vertex(scene, random) - from, random.uniform(0, 3)});
    }
    }
  }
  return rays;
}

class AccelPackets : public testing::Test {
protected:
  Random random{fresh_seed()};
  testing::ScopedTrace trace{__FILE__, __LINE__, seed_note()};
  std::size_t hits = 0, misses = 0;

  void expect_same_as_alone(const Accel& accel, const std::vector<Ray>& rays) {
    std::vector<const Ray*> pointers;
    for (const Ray& ray : rays) pointers.push_back(&ray);
    std::vector<Hit> together(rays.size());
    accel.intersect(pointers, together);
    const auto occluded = std::make_unique<bool[]>(rays.size());
    accel.occluded(pointers, {occluded.get(), rays.size()});
    const AccelTree& tree = *AccelAccess::tree(accel);
    const auto first = std::span(pointers).first(std::min(accel_detail::kPacketSize, pointers.size()));
    std::vector<Hit> portable(first.size());
    accel_detail::Packet<simd::PortableFloat8>(tree, first).intersect(portable);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto alone = accel.intersect(rays[i]);
      ++(alone ? hits : misses);
      ASSERT_EQ(occluded[i], alone.has_value()) << i;
      ASSERT_EQ(together[i].t < kInfinity, alone.has_value()) << i;
      if (alone) { ASSERT_TRUE(same(together[i], *alone)) << i << ": " << alone->primitive; }
      if (i >= portable.size()) continue;
      ASSERT_EQ(portable[i].t < kInfinity, alone.has_value()) << i;
      if (alone) { ASSERT_TRUE(same(portable[i], *alone)) << i; }
    }
  }
  void check(const TestScene& scene, int packets) {
    const Accel accel = Accel::build(scene.input());
    for (Bundle bundle : {Bundle::pinhole, Bundle::lens, Bundle::parallel, Bundle::to_a_light,
                          Bundle::just_far_enough, Bundle::diagonal, Bundle::one, Bundle::none})
      for (int i = 0; i < packets; ++i) {
        SCOPED_TRACE(testing::Message() << "bundle " << static_cast<int>(bundle) << ", packet " << i);
        const std::size_t count = 1 + random.below(3 * accel_detail::kPacketSize);
        ASSERT_NO_FATAL_FAILURE(expect_same_as_alone(accel, make_packet(bundle, scene, random, count)));
      }
    EXPECT_GT(hits, static_cast<std::size_t>(packets) * 60);
    EXPECT_GT(misses, static_cast<std::size_t>(packets) * 10);
  }
};

TEST_F(AccelPackets, OverAMesh) {
  TestScene scene;
  add_grid(scene, 60, [](vec2 p) { return 0.2f * std::sin(5 * p.x) * std::cos(7 * p.y); });
  check(scene, 300);
}

/// All boxes are flat, all planes and edges where rays point.
TEST_F(AccelPackets, OverFlatWalls) {
  TestScene scene;
  add_grid(scene, 30, [](vec2) { return 0.3f; });
  for (int axis = 0; axis < 2; ++axis) {
    TestScene wall;
    add_grid(wall, 20, [](vec2) { return -0.7f; });
    for (const uvec3& t : wall.triangles) {
      auto turned = [&](std::uint32_t i) {
        const vec3 p = wall.vertices[i];
        return axis == 0 ? vec3(p.z, p.x, p.y) : vec3(p.y, p.z, p.x);
      };
      scene.add_triangle(turned(t.x), turned(t.y), turned(t.z));
    }
  }
  check(scene, 500);
}

/// Far from the origin of the world, where coordinates are coarse.
TEST_F(AccelPackets, FarAway) {
  TestScene scene;
  add_grid(scene, 30, [](vec2 p) { return 0.1f * p.x; });
  const Accel near = Accel::build(scene.input());
  for (vec3& p : scene.vertices) p += vec3(5000, -3000, 9000);
  const Accel accel = Accel::build(scene.input());
  for (int i = 0; i < 1000; ++i) {
    std::vector<Ray> rays = make_packet(i % 2 ? Bundle::pinhole : Bundle::one, scene, random, 50);
    for (Ray& ray : rays) {
      const vec3 eye = vec3(5000, -3000, 9000) + vec3(0.1f, 0.2f, 3);
      ray.direction = some_vertex(scene, random) * (i % 3 ? 1.0f : 1 + 0x1p-22f) - eye;
      ray.origin = eye;
    }
    ASSERT_NO_FATAL_FAILURE(expect_same_as_alone(accel, rays));
  }
}

TEST_F(AccelPackets, OverAllKinds) {
  TestScene part, scene;
  add_grid(part, 5, [](vec2 p) { return 0.5f * p.x * p.y; });
  add_round(part, random, 5);
  const Accel object = Accel::build(part.input());
  add_grid(scene, 20, [](vec2 p) { return 0.2f * std::sin(5 * p.x) * std::cos(7 * p.y); });
  add_round(scene, random, 100);
  for (int i = 0; i < 40; ++i) {
    mat4 m = glm::translate(mat4(1), random.in_cube());
    m = glm::rotate(m, random.uniform(0, 6), random.direction());
    scene.instances.push_back({&object, glm::scale(m, vec3(random.uniform(0.05f, 0.2f)))});
  }
  check(scene, 200);
}

/// Seen nearly edge-on, a triangle may be hit before its box is entered, by more than boxes are padded for.
/// Rays go through an edge that lies along the box's, on in the triangle's plane; what ends them, or hides
/// it, is as far away.
TEST_F(AccelPackets, OverTrianglesSeenEdgeOn) {
  for (int i = 0; i < 10000; ++i) {
    TestScene scene;
    const vec3 foot(vec2(random.in_cube()), 0), tip = foot + vec3(random.uniform(), random.uniform(), 0.5f);
    scene.add_triangle(foot, foot + vec3(0, 0, 1), tip);
    for (int k = 0; k < (i % 2 ? 60 : 1000); ++k) { // a tree of one node, and deeper ones
      const vec3 at = 2.0f * random.in_cube();
      scene.add_triangle(at, at + 0.1f * random.in_cube(), at + 0.1f * random.in_cube());
    }
    const Accel accel = Accel::build(scene.input());
    const vec3 way = 3 * random.uniform(0.5f, 1) * (tip - foot) + vec3(0, 0, random.uniform(-1, 1));
    std::vector<Ray> rays;
    for (int k = 0; k < 16; ++k) {
      const vec3 edge = foot + vec3(0, 0, random.uniform(0.3f, 0.6f)), from = edge - way;
      rays.push_back({from, 0, edge - from + 2e-7f * random.in_cube(), 1 + random.uniform(-1e-3f, 1e-3f)});
    }
    ASSERT_NO_FATAL_FAILURE(expect_same_as_alone(accel, rays)) << i;
  }
  EXPECT_GT(hits, 1000u);
}

/// Bit by bit what the test of one ray with eight boxes says.
TEST_F(AccelPackets, BoxesAreMetAsByRaysAlone) {
  using F = simd::Float8;
  TestScene scene;
  add_grid(scene, 30, [](vec2 p) { return p.x > 0 ? 0.3f : 0.1f * p.y; });
  const Accel accel = Accel::build(scene.input());
  const AccelTree& tree = *AccelAccess::tree(accel);
  int lanes_hit = 0, missed = 0;
  for (int i = 0; i < 100000; ++i) {
    std::vector<Ray> rays = make_packet(i % 2 ? Bundle::lens : Bundle::none, scene, random, 8);
    for (Ray& ray : rays)
      if (random.below(8) == 0) ray.direction[static_cast<int>(random.below(3))] = i % 3 ? 0.0f : -0.0f;
    std::vector<const Ray*> pointers;
    for (const Ray& ray : rays) pointers.push_back(&ray);
    accel_detail::PacketRays<F> lanes;
    lanes.load(pointers);
    const accel_detail::BoxRays<F> box_rays(lanes, 0, tree);
    const WideNode& node = tree.nodes[random.below(static_cast<std::uint32_t>(tree.nodes.size()))];
    const std::uint32_t child = random.below(kWidth);
    const float t_max = random.uniform(0, 3);
    const simd::LaneMask together = box_rays.intersect({&node, child}, F(0.0f), F(t_max));
    for (std::size_t k = 0; k < rays.size(); ++k) {
      F unused;
      const simd::LaneMask alone =
          accel_detail::BoxRay<F>(rays[k], tree).intersect(node, F(0.0f), F(t_max), unused);
      ASSERT_EQ(together >> k & 1, alone >> child & 1) << i << ", ray " << k;
      ++(alone >> child & 1 ? lanes_hit : missed);
    }
  }
  EXPECT_GT(lanes_hit, 1000);
  EXPECT_GT(missed, 1000);
}

/// What rays that go on alone rely on: they begin above leaves, nearest last, and know the box of each.
TEST_F(AccelPackets, EntryPointsStandForTheirBoxes) {
  using F = simd::Float8;
  TestScene scene;
  add_grid(scene, 60, [](vec2 p) { return 0.2f * std::sin(5 * p.x) * std::cos(7 * p.y); });
  const Accel accel = Accel::build(scene.input());
  const AccelTree& tree = *AccelAccess::tree(accel);
  std::size_t subtrees = 0, leaves = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Ray> rays = make_packet(Bundle::pinhole, scene, random, 64);
    std::vector<const Ray*> pointers;
    for (const Ray& ray : rays) pointers.push_back(&ray);
    accel_detail::PacketRays<F> lanes;
    lanes.load(pointers);
    const auto frustum = accel_detail::PacketFrustum<F>::around(lanes, tree);
    if (!frustum) continue;
    accel_detail::EntryPoints points;
    points.push({tree.root, 0}, {nullptr, 0});
    for (accel_detail::Depth depth : {accel_detail::Depth::above_leaves, accel_detail::Depth::leaves}) {
      const bool through = descend(tree, *frustum, depth, points);
      if (!through && depth == accel_detail::Depth::leaves) break; // there may be both
      for (std::size_t k = 0; k < points.count; ++k) {
        const accel_detail::ChildPlace& place = points.place[k];
        ASSERT_EQ(points.at[k].value.is_leaf(), depth == accel_detail::Depth::leaves);
        if (place.node != nullptr) { ASSERT_EQ(place.node->child[place.lane], points.at[k].value); }
        if (k > 0) { ASSERT_GE(points.at[k - 1].key, points.at[k].key); }
      }
      (depth == accel_detail::Depth::leaves ? leaves : subtrees) += points.count;
    }
  }
  EXPECT_GT(subtrees, 2000u);
  EXPECT_GT(leaves, 2000u);
}

/// One that is not finite, or turns back, does the others no harm.
TEST_F(AccelPackets, WithRaysOfNonsense) {
  TestScene scene;
  add_grid(scene, 30, [](vec2 p) { return 0.1f * p.x; });
  const Accel accel = Accel::build(scene.input());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (float odd : {nan, kInfinity, -kInfinity, 3e38f, -3e38f, 1e-38f, 0.0f, -1.0f})
    for (int component = 0; component < 6; ++component)
      for (std::size_t at : {0u, 7u, 63u}) {
        std::vector<Ray> rays = make_packet(Bundle::pinhole, scene, random, 64);
        (component < 3 ? rays[at].origin : rays[at].direction)[component % 3] = odd;
        ASSERT_NO_FATAL_FAILURE(expect_same_as_alone(accel, rays));
      }
  EXPECT_GT(hits, 1000u);
}

TEST_F(AccelPackets, OverNothing) {
  const Accel nothing = Accel::build({});
  const Ray ray;
  const Ray* const rays[2] = {&ray, &ray};
  Hit hits_of[2];
  bool occluded[2] = {true, true};
  nothing.intersect(rays, hits_of);
  nothing.occluded(rays, occluded);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(hits_of[i].t, kInfinity);
    EXPECT_FALSE(occluded[i]);
  }
  nothing.intersect({}, {}); // no rays at all
}

/// Else nothing above would say anything: narrow packets test few triangles, those that pass the tree by
/// none, wide ones begin below the root, mixed ones there.
TEST_F(AccelPackets, BeginWhereTheirWaysPart) {
  TestScene scene;
  add_grid(scene, 200, [](vec2 p) { return 0.1f * p.x; });
  const Accel accel = Accel::build(scene.input());
  const AccelTree& tree = *AccelAccess::tree(accel);
  using Packet = accel_detail::Packet<simd::Float8>;
  struct Found {
    Packet::Way way;
    std::size_t triangles, entry_points;
  };
  auto ways = [&](vec3 target, float spread) {
    std::vector<Ray> rays;
    const vec3 eye(0.1f, 0.2f, 3);
    for (int i = 0; i < 64; ++i)
      rays.push_back({eye, 0, target + spread * random.in_cube() - eye, kInfinity});
    std::vector<const Ray*> pointers;
    for (const Ray& ray : rays) pointers.push_back(&ray);
    const Packet packet(tree, pointers);
    return Found{packet.way(), packet.triangle_count(), packet.entry_point_count()};
  };
  for (int i = 0; i < 100; ++i) {
    const vec3 target = 0.8f * vec3(vec2(random.in_cube()), 0);
    const auto narrow = ways(target, 1e-3f), wide = ways(target, 0.1f), astray = ways(vec3(5, 0, 0), 1e-3f);
    EXPECT_EQ(narrow.way, Packet::Way::few_triangles);
    EXPECT_GT(narrow.triangles, 0u);
    EXPECT_LT(narrow.triangles, 20u);
    EXPECT_EQ(wide.way, Packet::Way::subtrees);
    EXPECT_GT(wide.entry_points, 1u);
    EXPECT_EQ(astray.way, Packet::Way::few_triangles);
    EXPECT_EQ(astray.triangles, 0u);
  }
  const auto mixed = ways(vec3(0, 0, 3), 3);
  EXPECT_EQ(mixed.way, Packet::Way::root);
}

} // namespace
