// Triangles that are referenced on both sides of a split.

#include "accel/collapse_plan.h"
#include "accel/spatial_split.h"
#include "brute_force.h"
#include "support/seed.h"

#include <map>

namespace {

using namespace candela;
using namespace candela::accel_detail;
using namespace candela::test;

/// Small things everywhere, and a few large triangles across all of it.
TestScene room_scene(Random& random, int small, int large) {
  TestScene scene;
  for (int i = 0; i < small + large; ++i) {
    const float size = i < small ? 0.02f : 1.0f;
    const vec3 c = i < small ? random.in_cube() : vec3(0);
    const vec3 a = c + random.in_cube(size), b = c + random.in_cube(size);
    scene.add_triangle(c + random.in_cube(size), a, b);
  }
  return scene;
}

std::array<vec3, 3> corners(const TestScene& scene, std::uint32_t index) {
  const uvec3 t = scene.triangles[index];
  return {scene.vertices[t.x], scene.vertices[t.y], scene.vertices[t.z]};
}

glm::dvec3 point_on(const std::array<vec3, 3>& p, Random& random) {
  double u = static_cast<double>(random.uniform()), v = static_cast<double>(random.uniform());
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return (1 - u - v) * glm::dvec3(p[0]) + u * glm::dvec3(p[1]) + v * glm::dvec3(p[2]);
}

BuildRef ref_of(const TestScene& scene, std::uint32_t index) {
  Bounds3 b;
  for (vec3 p : corners(scene, index)) b.grow(p);
  return BuildRef::make(b, index, PrimitiveKind::triangle);
}

bool holds(const BuildBox& box, glm::dvec3 p) {
  for (int a = 0; a < 3; ++a)
    if (p[a] < static_cast<double>(box.lo()[a]) || p[a] > static_cast<double>(box.hi()[a])) return false;
  return true;
}

bool lies_in(const BuildBox& inner, const BuildBox& outer) {
  for (int a = 0; a < 3; ++a)
    if (inner.lo()[a] < outer.lo()[a] || inner.hi()[a] > outer.hi()[a]) return false;
  return true;
}

TEST(SpatialSplit, PartsHoldWhatLiesOnTheirSide) {
  Random random(fresh_seed());
  SCOPED_TRACE(seed_note());
  const TestScene scene = room_scene(random, 0, 200);
  const AccelInput input = scene.input();
  const Cutter cutter(input);
  int both = 0, one = 0;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const BuildRef ref = ref_of(scene, i);
    const BuildBox whole{ref.box()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      float plane = random.uniform(-1, 1);
      if (random.below(8) == 0) plane = corners(scene, i)[0][a]; // through a vertex
      const Parts parts = cutter.cut(ref, whole, axis, plane);
      for (const BuildBox& part : {parts.below, parts.above})
        EXPECT_TRUE(is_empty(part) || lies_in(part, whole));
      (is_empty(parts.below) || is_empty(parts.above) ? one : both)++;
      EXPECT_TRUE(is_empty(parts.below) || parts.below.hi()[a] <= plane);
      EXPECT_TRUE(is_empty(parts.above) || parts.above.lo()[a] >= plane);
      for (int k = 0; k < 50; ++k) {
        const glm::dvec3 p = point_on(corners(scene, i), random);
        EXPECT_TRUE(holds(p[a] <= static_cast<double>(plane) ? parts.below : parts.above, p))
            << i << ' ' << axis << ' ' << plane;
      }
    }
  }
  EXPECT_GT(both, 50);
  EXPECT_GT(one, 50);
}

// An edge whose crossing rounds by 9 eps: the exact one is in both parts all the same.
TEST(SpatialSplit, RoundingOfACrossingIsCovered) {
  const vec3 v(-0x1.006deep-1f, -0x1.078d06p+0f, 0), w(0x1.07b084p-1f, 0x1.076d1p+0f, 0);
  const float plane = 0x1.0441dp-1f;
  TestScene scene;
  scene.add_triangle(v, w, vec3(v.x, w.y, 1));
  const AccelInput input = scene.input();
  const BuildRef ref = ref_of(scene, 0);
  const Parts parts = Cutter(input).cut(ref, BuildBox{ref.box()}, 0, plane);
  const glm::dvec3 a(v), b(w);
  const glm::dvec3 crossing = a + (b - a) * ((static_cast<double>(plane) - a.x) / (b.x - a.x));
  // Its z = 0 is the box's own border; of y the two vertices below leave the question to this crossing alone.
  EXPECT_LE(static_cast<double>(parts.above.lo()[1]), crossing.y);
  EXPECT_GE(static_cast<double>(parts.above.hi()[1]), crossing.y);
}

TEST(SpatialSplit, NoPartIsMuchTooLarge) {
  TestScene scene;
  scene.add_triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const BuildRef ref = ref_of(scene, 0);
  const AccelInput input = scene.input();
  const Parts parts = Cutter(input).cut(ref, BuildBox{ref.box()}, 0, 3);
  EXPECT_NEAR(parts.above.hi()[1], 1, 1e-5f);
  EXPECT_EQ(parts.above.lo()[0], 3);
  EXPECT_EQ(parts.below.hi()[1], 4);
}

class SpatialSplitTree : public testing::Test {
protected:
  Random random{fresh_seed()};
  testing::ScopedTrace trace{__FILE__, __LINE__, seed_note()};
  std::multimap<std::uint32_t, BuildBox> found; ///< boxes of the refs in the tree, by triangle

  BinaryBvh build(const TestScene& scene) {
    HugeVector<BuildRef> refs;
    RangeBounds bounds;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
      refs.push_back(ref_of(scene, i));
      bounds.grow(refs.back());
    }
    const AccelInput input = scene.input();
    return build_binary_bvh(input, std::move(refs), bounds, false, BuildQuality::high);
  }

  void walk(const BinaryBvh& bvh, const Subtree& s) {
    const bool leaf = s.count == 1 || CollapsePlan{bvh.nodes[s.node].plan}.is_leaf();
    if (leaf) {
      for (std::uint32_t i = s.begin; i < s.begin + s.count; ++i) {
        EXPECT_TRUE(lies_in(BuildBox{bvh.refs[i].box()}, bvh.box(s)));
        found.emplace(bvh.refs[i].index(), BuildBox{bvh.refs[i].box()});
      }
      return;
    }
    for (const Subtree& child : {bvh.left(s), bvh.right(s)}) {
      EXPECT_LE(child.count, child.capacity);
      EXPECT_TRUE(lies_in(bvh.box(child), bvh.box(s)));
      walk(bvh, child);
    }
  }
};

TEST_F(SpatialSplitTree, EveryPointOfEveryTriangleIsInABox) {
  const TestScene scene = room_scene(random, 4000, 40);
  const BinaryBvh bvh = build(scene);
  walk(bvh, bvh.root());
  EXPECT_GT(found.size(), scene.triangles.size() + 20) << "triangles are doubled";
  EXPECT_LE(found.size(), bvh.refs.size());
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    ASSERT_TRUE(found.contains(i)) << i;
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 p = point_on(corners(scene, i), random);
      bool held = false;
      for (auto [at, end] = found.equal_range(i); at != end; ++at) held |= holds(at->second, p);
      EXPECT_TRUE(held) << i;
    }
  }
}

TEST_F(SpatialSplitTree, RaysHitWhatAllTrianglesSay) {
  const TestScene scene = room_scene(random, 4000, 40);
  const Accel accel = Accel::build(scene.input());
  RayCount seen;
  for (int i = 0; i < 3000; ++i) {
    const vec3 origin = random.in_cube(random.uniform(0.1f, 3));
    const Ray ray{origin, 0, random.in_cube() - origin, kInfinity};
    ASSERT_NO_FATAL_FAILURE(check_ray(scene, accel, ray, seen)) << i;
  }
  EXPECT_GT(seen.certain_hits, 300);
}

} // namespace
