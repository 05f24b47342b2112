// Lines on a ground, by hand and against their mean over many points.

#include "support/patterns.h"
#include "textures/grid_texture.h"

namespace candela {
namespace {

using test::Random;

GridTexture grid(float squares, float width) {
  GridTexture t;
  t.squares = squares, t.line_width = width;
  return t;
}

TEST(GridTexture, IsAPattern) {
  for (float width : {0.0f, 0.1f, 1.0f}) test::expect_pattern(grid(3, width));
}

TEST(GridTexture, HasLinesAboutTheIntegers) {
  const GridTexture t = grid(4, 0.2f);
  const TextureUse use;
  for (float cell : {-3.0f, 0.0f, 2.0f, 100.0f})
    for (auto [x, expected] : {std::pair{0.0f, 1.0f},
                               {0.09f, 1.0f},
                               {-0.09f, 1.0f},
                               {0.11f, 0.0f},
                               {-0.11f, 0.0f},
                               {0.5f, 0.0f},
                               {0.89f, 0.0f}}) {
      EXPECT_EQ(t.share(use, {(cell + x) / 4, 0.125f}), expected) << cell << ' ' << x;
      EXPECT_EQ(t.share(use, {0.125f, (cell + x) / 4}), expected) << cell << ' ' << x;
    }
  EXPECT_EQ(t.share(use, {0, 0}), 1) << "lines cross";
  EXPECT_EQ(grid(4, 0).share(use, {0, 0}), 0);
  EXPECT_EQ(grid(4, 1).share(use, {0.125f, 0.125f}), 1);
}

TEST(GridTexture, CoversItsShareOfThePlane) {
  SCOPED_TRACE(test::seed_note());
  for (float width : {0.02f, 0.3f, 0.9f}) {
    const GridTexture t = grid(5, width);
    const float expected = 1 - sqr(1 - width);
    // One square, by many lookups; an area of many squares, by one.
    EXPECT_NEAR(test::sampled_share(t, {}, {vec2(3.1f), {{0.2f, 0}, {0, 0.2f}}}, 600), expected, 5e-3);
    EXPECT_NEAR(t.mean_share({}, {vec2(0.3f), {{0, 1e3f}, {1e3f, 0}}}), expected, 1e-4);
    EXPECT_NEAR(t.mean_share({}, {vec2(0.3f), {{0, 1e9f}, {1e9f, 0}}}), expected, 1e-4);
  }
}

TEST(GridTexture, UprightFootprintsGiveTheExactMean) {
  SCOPED_TRACE(test::seed_note());
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const GridTexture t = grid(1 + 3 * random(), 0.05f + 0.9f * random());
    const vec2 sides(0.02f + random(), 0.02f + random());
    const TexturePoint at(random.in_square(20), {{sides.x, 0}, {0, sides.y}});
    EXPECT_NEAR(t.mean_share({}, at), test::sampled_share(t, {}, at, 500), 1e-2) << i;
  }
}

} // namespace
} // namespace candela
