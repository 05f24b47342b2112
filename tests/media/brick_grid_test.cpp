#include "media/brick_grid.h"
#include "media/medium_desc.h"
#include "support/volumes.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

struct TestRandom {
  explicit TestRandom(std::uint64_t seed) : engine(seed) {}
  float next() { return std::uniform_real_distribution<float>(0, 1)(engine); }
  vec3 in_box(vec3 low, vec3 high) { return glm::mix(low, high, vec3(next(), next(), next())); }
  std::mt19937_64 engine;
};

/// Trilinear between the centres of cells, without bricks.
float plain_density(const VolumeGrid& grid, vec3 place) {
  const vec3 p = glm::clamp(place, vec3(0), vec3(grid.cells - 1));
  double sum = 0;
  for (int z = 0; z < grid.cells.z; ++z)
    for (int y = 0; y < grid.cells.y; ++y)
      for (int x = 0; x < grid.cells.x; ++x) {
        const vec3 share = glm::max(1.0f - glm::abs(p - vec3(x, y, z)), vec3(0));
        sum += static_cast<double>(share.x * share.y * share.z * grid.density[cell_index(grid, x, y, z)]);
      }
  return static_cast<float>(sum);
}

TEST(BrickGrid, IsTrilinearBetweenTheCentresOfCells) {
  for (const glm::ivec3 cells : {glm::ivec3(1, 1, 1), glm::ivec3(9, 8, 17), glm::ivec3(10, 2, 5)}) {
    const VolumeGrid grid = random_grid(cells, 7);
    const BrickGrid bricks(grid);
    TestRandom random(3);
    for (int i = 0; i < 500; ++i) {
      const vec3 place = random.in_box(vec3(-0.5f), vec3(cells) - 0.5f);
      EXPECT_NEAR(bricks.density(place), plain_density(grid, place), 2e-5f);
    }
    EXPECT_EQ(bricks.density(vec3(-0.6f, 0, 0)), 0);
    EXPECT_EQ(bricks.density(vec3(0, 0, static_cast<float>(cells.z) - 0.4f)), 0);
  }
}

/// Along any ray the bricks follow one another without gaps, over all that lies in the box, and their bounds
/// hold for what is found in them.
TEST(BrickGrid, RaysWalkThroughAllOfTheBox) {
  const VolumeGrid grid = random_grid({20, 9, 33}, 11);
  const BrickGrid bricks(grid);
  const vec3 low(-0.5f), high = vec3(grid.cells) - 0.5f;
  TestRandom random(5);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec3 origin = random.in_box(vec3(-8), vec3(30));
    vec3 direction = random.in_box(vec3(-1), vec3(1));
    if (i % 3 == 0) direction[i / 3 % 3] = 0;                        // along a face
    if (i % 7 == 0) direction = vec3(i % 2, 0, i % 2 == 0 ? -1 : 0); // along an axis
    double enter = 0, leave = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        if (origin[axis] < low[axis] || origin[axis] > high[axis]) leave = -1;
        continue;
      }
      const double a = static_cast<double>((low[axis] - origin[axis]) / direction[axis]);
      const double b = static_cast<double>((high[axis] - origin[axis]) / direction[axis]);
      enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    float reached = -1;
    double length = 0;
    bricks.walk(origin, direction, 0, kInfinity, [&](const BrickGrid::Place& brick, float first, float last) {
      if (reached >= 0) { EXPECT_EQ(first, reached); }
      EXPECT_LT(first, last);
      reached = last, length += static_cast<double>(last - first);
      const BrickBounds& bounds = bricks.bounds(brick);
      for (int k = 0; k < 4; ++k) {
        const vec3 place = origin + glm::mix(first, last, random.next()) * direction;
        const float density = bricks.density(brick, place);
        EXPECT_NEAR(density, bricks.density(place), 1e-3f);
        EXPECT_LE(density, bounds.most * 1.000001f);
        EXPECT_LE(std::abs(density - bounds.mean), bounds.spread * 1.00001f);
      }
      return true;
    });
    EXPECT_NEAR(length, std::max(leave - enter, 0.0), 1e-3 * (1 + length));
    met += length > 0;
  }
  EXPECT_GT(met, 300);
}

TEST(BrickGrid, WalksEndWhereTheVisitorEndsThem) {
  const BrickGrid bricks(random_grid({64, 8, 8}, 1));
  int visited = 0;
  bricks.walk({-5, 4, 4}, {1, 0, 0}, 0, kInfinity,
              [&](const BrickGrid::Place&, float, float) { return ++visited < 3; });
  EXPECT_EQ(visited, 3);
}

/// The mean is the integral of what lies in it.
TEST(BrickGrid, MeansAreThoseOfTheVolume) {
  const VolumeGrid grid = random_grid({9, 9, 9}, 2); // one brick between the first and the last centre
  const BrickGrid bricks(grid);
  double sum = 0;
  constexpr int n = 48;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        sum += static_cast<double>(bricks.density((vec3(x, y, z) + 0.5f) * (8.0f / n)));
  bricks.walk({0, 4, 4}, {1, 0, 0}, 0, 8, [&](const BrickGrid::Place& brick, float, float) {
    EXPECT_NEAR(static_cast<double>(bricks.bounds(brick).mean), sum / (n * n * n), 1e-4);
    return true;
  });
}

/// Also where nearly all of it is dense, and little is far below the mean.
TEST(BrickGrid, SpreadsHoldOnBothSides) {
  VolumeGrid grid = random_grid({9, 9, 9}, 1);
  std::ranges::fill(grid.density, 1.0f);
  grid.density[cell_index(grid, 4, 4, 4)] = 0;
  const BrickGrid bricks(grid);
  bricks.walk({0, 4, 4}, {1, 0, 0}, 0, 8, [&](const BrickGrid::Place& brick, float, float) {
    const BrickBounds& bounds = bricks.bounds(brick);
    EXPECT_GE(bounds.spread, bounds.mean - bricks.density(brick, vec3(4)));
    return true;
  });
}

/// The faces of a medium's box are half a cell off the outermost centres.
TEST(GridMedium, ItsBoxIsThatOfTheDescription) {
  MediumDesc desc;
  GridMediumModel model;
  model.center = {1, 2, 3}, model.size = {2, 4, 8};
  model.grid = std::make_shared<const VolumeGrid>(random_grid({5, 6, 7}, 1));
  desc.model = model;
  const Medium made = make_medium(desc);
  const auto& medium = std::get<GridMedium>(made);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(medium.to_cells({0, 0, -1})[axis], -0.5f, 1e-5f);
    EXPECT_NEAR(medium.to_cells({2, 4, 7})[axis], static_cast<float>(model.grid->cells[axis]) - 0.5f, 1e-5f);
  }
}

TEST(BrickGrid, UniformBricksTakeNoMemoryAndVaryByNothing) {
  VolumeGrid grid = random_grid({40, 40, 40}, 3);
  std::ranges::fill(grid.density, 0.7f);
  const BrickGrid bricks(grid);
  EXPECT_LT(bricks.memory_bytes(), 40u * 40u * 40u);
  EXPECT_EQ(bricks.density({3.3f, 20.7f, 39.2f}), 0.7f);
  bricks.walk({0, 1, 2}, {1, 1, 1}, 0, 30, [&](const BrickGrid::Place& brick, float, float) {
    EXPECT_EQ(bricks.bounds(brick).spread, 0);
    return true;
  });
}

TEST(VolumeGrid, SaysWhatIsWrong) {
  const VolumeGrid good = random_grid({3, 4, 5}, 1);
  EXPECT_EQ(volume_grid_problem(good), "");
  const auto problem = [&](auto change) {
    VolumeGrid bad = good;
    change(bad);
    return volume_grid_problem(bad).substr(0, 7);
  };
  EXPECT_EQ(problem([](VolumeGrid& g) { g.density[7] = -1; }), "density");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.density[7] = kInfinity; }), "density");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.density.pop_back(); }), "density");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.temperature = {1}; }), "tempera");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.color.assign(60, vec3(2)); }), "color: ");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.cells.x = 0; }), "cells: ");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.cells = {2000, 2000, 2000}; }), "cells: ");
  EXPECT_EQ(problem([](VolumeGrid& g) { g.bounds.hi.y = g.bounds.lo.y; }), "bounds:");
}

} // namespace
} // namespace candela::test
