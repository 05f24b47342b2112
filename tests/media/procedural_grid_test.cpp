// Clouds, smoke and flames that are computed.

#include "media/grid_cache.h"
#include "media/medium_desc.h"
#include "media/procedural_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace candela::test {
namespace {

ProceduralGrid small(int pattern) {
  ProceduralGrid desc;
  desc.pattern = pattern;
  desc.resolution = 40;
  return desc;
}

class ProceduralGrids : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Patterns, ProceduralGrids, ::testing::Values(0, 1, 2), [](const auto& info) {
  return std::string(ProceduralGrid::kPatterns[static_cast<std::size_t>(info.param)]);
});

TEST_P(ProceduralGrids, AreTheSameWhateverTheThreads) {
  const auto one = make_procedural_grid(small(GetParam()), nullptr, 1);
  EXPECT_EQ(*one, *make_procedural_grid(small(GetParam()), nullptr, 3));
  EXPECT_EQ(*one, *make_procedural_grid(small(GetParam()), nullptr, 16));
}

TEST_P(ProceduralGrids, AreValidAndFillTheirBoxInPart) {
  const auto grid = make_procedural_grid(small(GetParam()));
  EXPECT_EQ(volume_grid_problem(*grid), "");
  const vec3 half = procedural_proportions(GetParam());
  EXPECT_EQ(grid->bounds, (Bounds3{-half, half}));
  EXPECT_EQ(std::max({grid->cells.x, grid->cells.y, grid->cells.z}), 40);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(grid->cells[a], 40 * half[a], 0.5f);
  const auto filled =
      static_cast<double>(std::ranges::count_if(grid->density, [](float d) { return d > 0; })) /
      static_cast<double>(grid->density.size());
  EXPECT_GT(filled, 0.05);
  EXPECT_LT(filled, 0.6) << "most of the box is empty, so that rays pass through it fast";
  EXPECT_LE(*std::ranges::max_element(grid->density), 1);
  EXPECT_GT(*std::ranges::max_element(grid->density), 0.5f);
  EXPECT_EQ(grid->temperature.empty(), GetParam() != 2);
  for (std::size_t i = 0; i < grid->temperature.size(); ++i) {
    ASSERT_LE(grid->temperature[i], 1);
    ASSERT_EQ(grid->temperature[i] > 0, grid->density[i] > 0);
  }
  // The faces of the box cut nothing off.
  std::size_t cell = 0;
  for (int z = 0; z < grid->cells.z; ++z)
    for (int y = 0; y < grid->cells.y; ++y)
      for (int x = 0; x < grid->cells.x; ++x, ++cell) {
        const glm::ivec3 c(x, y, z);
        if (glm::any(glm::equal(c, glm::ivec3(0))) || glm::any(glm::equal(c, grid->cells - 1))) {
          ASSERT_LT(grid->density[cell], 0.2f) << x << ' ' << y << ' ' << z;
        }
      }
}

TEST_P(ProceduralGrids, DependOnEveryValue) {
  const auto plain = make_procedural_grid(small(GetParam()));
  const auto differs = [&](auto change) {
    ProceduralGrid desc = small(GetParam());
    change(desc);
    return make_procedural_grid(desc)->density != plain->density;
  };
  EXPECT_TRUE(differs([](ProceduralGrid& d) { d.seed = 2; }));
  EXPECT_TRUE(differs([](ProceduralGrid& d) { d.frequency = 7; }));
  EXPECT_TRUE(differs([](ProceduralGrid& d) { d.octaves = 2; }));
  EXPECT_TRUE(differs([](ProceduralGrid& d) { d.coverage = 0.9f; }));
  EXPECT_TRUE(differs([](ProceduralGrid& d) { d.softness = 0.9f; }));
  EXPECT_TRUE(differs([](ProceduralGrid& d) { d.resolution = 48; }));
}

TEST_P(ProceduralGrids, MoreCoverageIsMoreMatter) {
  double before = 0;
  for (float coverage : {0.0f, 0.5f, 1.0f}) {
    ProceduralGrid desc = small(GetParam());
    desc.coverage = coverage;
    double sum = 0;
    const auto grid = make_procedural_grid(desc);
    for (float d : grid->density) sum += static_cast<double>(d);
    EXPECT_GT(sum, before) << coverage;
    before = sum;
  }
}

TEST_P(ProceduralGrids, ExtremeValuesAreValid) {
  for (float frequency : {0.5f, 64.0f})
    for (float share : {0.0f, 1.0f})
      for (int octaves : {1, 10}) {
        ProceduralGrid desc = small(GetParam());
        desc.resolution = 16;
        desc.frequency = frequency, desc.octaves = octaves;
        desc.coverage = share, desc.softness = 1 - share;
        desc.seed = 1000000000;
        EXPECT_EQ(volume_grid_problem(*make_procedural_grid(desc)), "");
      }
}

TEST(ProceduralGrid, IsGivenUp) {
  Progress progress;
  progress.cancel();
  EXPECT_THROW(make_procedural_grid(small(0), &progress), Cancelled);
}

TEST(ProceduralGrid, ACumulusHasAFlatBase) {
  const auto grid = make_procedural_grid(small(0));
  // Of the columns with cloud, most begin within two cells of each other.
  std::vector<int> lowest;
  for (int z = 0; z < grid->cells.z; ++z)
    for (int x = 0; x < grid->cells.x; ++x)
      for (int y = 0; y < grid->cells.y; ++y)
        if (grid->density[static_cast<std::size_t>((z * grid->cells.y + y) * grid->cells.x + x)] > 0) {
          lowest.push_back(y);
          break;
        }
  std::ranges::sort(lowest);
  ASSERT_GT(lowest.size(), 100u);
  EXPECT_LE(lowest[lowest.size() / 2] - lowest[0], 2);
}

TEST(GridCache, KeepsWhatItMadeUntilAnotherSeedIsAskedFor) {
  MediumDesc medium;
  medium.name = "cloud";
  medium.model = ProceduralMediumModel{{}, small(0)};
  const auto values = [](const Medium& made) { return std::get<GridMedium>(made).values; };
  GridCache first;
  const auto grid = values(make_medium(medium, {.grids = &first}));
  EXPECT_EQ(values(make_medium(medium, {.grids = &first})), grid);
  first.trim();
  medium.scale = 3;
  std::get<ProceduralMediumModel>(medium.model).size = vec3(5);
  GridCache second(&first);
  EXPECT_EQ(values(make_medium(medium, {.grids = &second})), grid) << "it does not depend on that";
  second.trim();
  EXPECT_GE(second.memory_bytes(), grid->density.size() * sizeof(float));
  std::get<ProceduralMediumModel>(medium.model).seed = 9;
  Progress progress;
  progress.cancel();
  GridCache cancelled(&second, &progress);
  EXPECT_THROW(make_medium(medium, {.grids = &cancelled}), Cancelled);
  GridCache third(&second);
  const auto other = values(make_medium(medium, {.grids = &third}));
  EXPECT_NE(other, grid);
  EXPECT_NE(other->density, grid->density);
}

} // namespace
} // namespace candela::test
