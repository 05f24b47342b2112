// No ray leaves a closed mesh from inside, through edges or vertices, at any position of the mesh.

#include "accel/accel.h"
#include "accel/intersect.h"
#include "brute_force.h"
#include "support/seed.h"

namespace {

using namespace candela;
using namespace candela::test;

/// A cube's surface of n x n x 2 triangles a side, welded, then mapped.
template <class Map>
TestScene closed_mesh(int n, Map map) {
  TestScene scene;
  std::vector<std::uint32_t> index(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), ~0u);
  auto vertex = [&](int x, int y, int z) {
    std::uint32_t& i = index[static_cast<std::size_t>((z * (n + 1) + y) * (n + 1) + x)];
    if (i == ~0u) {
      i = static_cast<std::uint32_t>(scene.vertices.size());
      scene.vertices.push_back(map(vec3(x, y, z) * (2.0f / static_cast<float>(n)) - 1.0f));
    }
    return i;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side <= n; side += n)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          auto at = [&](int a, int b) {
            return axis == 0 ? vertex(side, a, b) : axis == 1 ? vertex(a, side, b) : vertex(a, b, side);
          };
          std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if ((i + j) % 2)
            scene.triangles.insert(scene.triangles.end(), {{a, b, c}, {a, c, d}});
          else
            scene.triangles.insert(scene.triangles.end(), {{a, b, d}, {b, c, d}});
        }
  return scene;
}

/// Rays from near `inside` to vertices, to points on edges, and anywhere.
void expect_no_leak(const TestScene& scene, vec3 inside, float room, Random& random, int rays) {
  Accel accel = Accel::build(scene.input());
  ASSERT_EQ(accel.stats().skipped, 0u);
  int leaks = 0;
  for (int i = 0; i < rays; ++i) {
    vec3 origin = inside + random.in_cube(room);
    if (i % 5 == 0) origin = inside; // more rays with equal coordinates, zero components, exact diagonals
    uvec3 t = scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))];
    vec3 a = scene.vertices[t.x], b = scene.vertices[t.y];
    vec3 target = i % 3 == 0 ? a : i % 3 == 1 ? a + random.uniform() * (b - a) : origin + random.direction();
    if (i % 3 == 1 && i % 2) target = 0.5f * (a + b);
    Ray ray{origin, 0, target - origin, kInfinity};
    if (ray.direction == vec3(0)) continue;
    if (!accel.intersect(ray) || !accel.occluded(ray)) {
      if (++leaks == 1)
        ADD_FAILURE() << "leak: origin " << origin.x << " " << origin.y << " " << origin.z << " direction "
                      << ray.direction.x << " " << ray.direction.y << " " << ray.direction.z;
    }
  }
  EXPECT_EQ(leaks, 0);
}

class AccelWatertight : public testing::Test {
protected:
  Random random{fresh_seed()};
  testing::ScopedTrace trace{__FILE__, __LINE__, seed_note()};
};

TEST_F(AccelWatertight, Cube) {
  // Axis-parallel faces: boxes without thickness, edges at exact lattice points.
  expect_no_leak(closed_mesh(1, [](vec3 p) { return p; }), vec3(0), 0.5f, random, 200000);
  expect_no_leak(closed_mesh(16, [](vec3 p) { return p; }), vec3(0), 0.5f, random, 400000);
}

TEST_F(AccelWatertight, RoundAndBumpy) {
  auto bumpy = [](vec3 p) {
    vec3 d = glm::normalize(p);
    return d * (1 + 0.1f * std::sin(9 * d.x) * std::sin(8 * d.y) + 0.02f * std::sin(50 * d.z));
  };
  expect_no_leak(closed_mesh(48, bumpy), vec3(0), 0.4f, random, 1000000);
}

TEST_F(AccelWatertight, ThinAndSlanted) {
  // A long box turned out of all axes: slivers, and boxes much larger than their triangles.
  mat4 m = glm::rotate(mat4(1), 0.7f, glm::normalize(vec3(1, 2, 3)));
  m = glm::scale(m, vec3(100, 1, 0.1f));
  expect_no_leak(closed_mesh(12, [&](vec3 p) { return transform_point(m, p); }), vec3(0), 0.01f, random,
                 400000);
}

TEST_F(AccelWatertight, FarFromTheOrigin) {
  // Coordinates with few bits left for the shape, and tiny and huge ones.
  for (auto [offset, size] : {std::pair(vec3(1000, -3000, 2000), 1.0f),
                              {vec3(0), 1e-6f},
                              {vec3(0), 1e9f},
                              {vec3(16, 0, 0), 1e-3f}}) {
    auto place = [offset = offset, size = size](vec3 p) { return offset + size * glm::normalize(p); };
    expect_no_leak(closed_mesh(12, place), offset, 0.4f * size, random, 200000);
  }
}

/// Rays whose edge functions lie below the rounding error of single precision, decided as integers decide
/// them.
template <class F>
void expect_exact_edges(Random& random) {
  auto lattice = [&] { return static_cast<int>(random.below(1u << 24)) - (1 << 23); };
  auto near_0 = [&] { return static_cast<int>(random.below(3)) - 1; };
  const accel_detail::ShearedRay<F> ray(
      {{0, 0, -1}, 0, {0, 0, 1}, kInfinity}); // no shear: x and y stay exact
  int hits = 0, misses = 0;
  for (int n = 0; n < 100000; ++n) {
    int ax = lattice(), ay = lattice(), bx = -ax + near_0(), by = -ay + near_0(), cx = lattice(),
        cy = lattice();
    std::array<std::array<int, 2>, 3> p{{{ax, ay}, {bx, by}, {cx, cy}}};
    TrianglePack pack;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t lane = 0; lane < kWidth; ++lane) {
        pack.vertex[k][0][lane] = static_cast<float>(p[k][0]),
        pack.vertex[k][1][lane] = static_cast<float>(p[k][1]);
        pack.vertex[k][2][lane] = 0;
        pack.primitive[lane] = 3;
      }
    bool positive = false, negative = false;
    for (std::size_t k = 0; k < 3; ++k) {
      auto [x0, y0] = p[k];
      auto [x1, y1] = p[(k + 1) % 3];
      std::int64_t edge = std::int64_t{x0} * y1 - std::int64_t{y0} * x1;
      positive |= edge > 0, negative |= edge < 0;
    }
    if (!positive && !negative) continue; // no area
    Hit hit;
    float t_max = kInfinity;
    bool expected = positive != negative;
    ASSERT_EQ((accel_detail::intersect_triangles<F, false>(pack, ray, 0, t_max, hit)), expected)
        << ax << " " << ay << ", " << bx << " " << by << ", " << cx << " " << cy;
    ++(expected ? hits : misses);
    if (expected) {
      ASSERT_FLOAT_EQ(hit.t, 1);
      ASSERT_EQ(hit.primitive, 3u);
    }
  }
  EXPECT_GT(hits, 10000);
  EXPECT_GT(misses, 10000);
}

TEST_F(AccelWatertight, EdgesAreExact) {
  expect_exact_edges<simd::Float8>(random);
  expect_exact_edges<simd::PortableFloat8>(random);
}

} // namespace
