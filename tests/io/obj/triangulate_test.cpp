#include "io/obj/triangulate.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace candela {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// Signed area times two of a triangle or polygon in the xy plane.
double area(const std::vector<vec3>& p, std::span<const int> corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    vec3 a = p[static_cast<std::size_t>(corners[i])],
         b = p[static_cast<std::size_t>(corners[(i + 1) % corners.size()])];
    sum += static_cast<double>(a.x) * static_cast<double>(b.y) -
           static_cast<double>(a.y) * static_cast<double>(b.x);
  }
  return sum;
}

/// Checks for n - 2 triangles of the polygon's orientation whose areas sum to the polygon's: then they cover
/// it exactly once.
void expect_partition(const std::vector<vec3>& polygon) {
  Triangles triangles;
  triangulate(polygon, triangles);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  std::vector<int> all(polygon.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  double whole = area(polygon, all), sum = 0;
  std::set<int> used;
  for (const auto& t : triangles) {
    double part = area(polygon, t);
    EXPECT_GT(part * whole, 0) << "orientation of " << t[0] << " " << t[1] << " " << t[2];
    sum += part;
    used.insert(t.begin(), t.end());
  }
  EXPECT_NEAR(sum / whole, 1, 1e-9);
  EXPECT_EQ(used.size(), polygon.size());
}

TEST(Triangulate, ConcavePentagon) {
  // A house with its roof pushed in below its eaves: a fan from corner 0 would leave it.
  std::vector<vec3> house = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}};
  expect_partition(house);
  for (int start = 1; start < 5; ++start) {
    std::rotate(house.begin(), house.begin() + 1, house.end());
    expect_partition(house);
  }
  std::reverse(house.begin(), house.end());
  expect_partition(house);
}

TEST(Triangulate, ConcaveQuadrilateral) {
  std::vector<vec3> dart = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}};
  for (int start = 0; start < 4; ++start) {
    expect_partition(dart);
    std::rotate(dart.begin(), dart.begin() + 1, dart.end());
  }
}

TEST(Triangulate, ConvexQuadrilateralIsCutAlongItsFirstDiagonal) {
  Triangles triangles;
  triangulate(std::vector<vec3>{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, triangles);
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, CornersOnAnEdge) {
  expect_partition({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  expect_partition({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}});
}

TEST(Triangulate, BridgeToAHole) {
  // A square ring, cut open between (0, 0) and (1, 1): both points are visited twice.
  expect_partition({{0, 0, 0},
                    {3, 0, 0},
                    {3, 3, 0},
                    {0, 3, 0},
                    {0, 0, 0},
                    {1, 1, 0},
                    {1, 2, 0},
                    {2, 2, 0},
                    {2, 1, 0},
                    {1, 1, 0}});
}

TEST(Triangulate, RandomStars) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  std::uniform_real_distribution<float> radius(0.2f, 5);
  for (int round = 0; round < 300; ++round) {
    int n = 5 + round % 60;
    std::vector<vec3> star;
    for (int i = 0; i < n; ++i) {
      float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(n), r = radius(random);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
    if (round % 2) std::reverse(star.begin(), star.end());
    expect_partition(star);
  }
}

TEST(Triangulate, EveryPlaneAndSize) {
  std::vector<vec3> flat = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}};
  Triangles expected;
  triangulate(flat, expected);
  for (float scale : {1e-15f, 1.0f, 1e15f})
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<vec3> turned;
      for (vec3 p : flat) {
        vec3 q;
        q[(axis + 1) % 3] = p.x * scale, q[(axis + 2) % 3] = p.y * scale, q[axis] = scale;
        turned.push_back(q);
      }
      Triangles triangles;
      triangulate(turned, triangles);
      EXPECT_EQ(triangles, expected) << axis << " " << scale;
    }
}

TEST(Triangulate, DegenerateAndCrossedPolygonsEnd) {
  for (const std::vector<vec3>& polygon :
       {std::vector<vec3>(7, vec3(1)),
        std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}},
        std::vector<vec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 3, 0}, {1, -3, 0}}}) {
    Triangles triangles;
    triangulate(polygon, triangles);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    for (const auto& t : triangles)
      for (int i : t) EXPECT_TRUE(i >= 0 && i < static_cast<int>(polygon.size()));
  }
  Triangles none;
  triangulate(std::vector<vec3>{{0, 0, 0}, {1, 0, 0}}, none);
  EXPECT_TRUE(none.empty());
}

} // namespace
} // namespace candela
