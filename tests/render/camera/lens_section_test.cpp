#include "render/camera/lens_section.h"
#include "render/camera/lenses.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

LensSystem lens_named(std::string_view key, float f_stop = 0, float focus = kInfinity) {
  const LensPrescription& lens = *find_lens(key);
  return LensSystem(lens.interfaces, {lens.focal_length, f_stop, focus, 17.5f, 0, 0});
}

TEST(LensSection, HasAnOutlineForEachGlass) {
  // The double Gauss has six elements in four groups: two pairs are cemented.
  const LensSection section = lens_section(lens_named("double_gauss"));
  EXPECT_EQ(section.elements.size(), 6u);
  for (const auto& outline : section.elements) EXPECT_EQ(outline.front(), outline.back());
  EXPECT_GT(section.stop_rim, section.stop_radius);
  EXPECT_LT(section.film_z, 0);
}

TEST(LensSection, StopClosesWithTheFNumber) {
  const float wide = lens_section(lens_named("double_gauss", 2.8f)).stop_radius;
  EXPECT_NEAR(lens_section(lens_named("double_gauss", 5.6f)).stop_radius, 0.5f * wide, 1e-4f * wide);
}

TEST(LensSection, PathsPassWhereTheLensTraces) {
  const LensSystem lens = lens_named("double_gauss", 4);
  const auto paths = lens_paths(lens, 5, 41, 30);
  ASSERT_EQ(paths.size(), 41u);
  int passing = 0;
  for (const LensPath& path : paths) {
    EXPECT_EQ(path.points.front(), vec2(-lens.film_distance(), 5));
    if (!path.passes) continue;
    ++passing;
    // The film, each interface, and the end.
    EXPECT_EQ(path.points.size(), lens.surfaces().size() + 2);
    EXPECT_GT(path.points.back().x, lens.front_vertex());
    const vec2 at_stop =
        path.points[1 + static_cast<std::size_t>(
                            std::ranges::find_if(lens.surfaces(), [](const auto& s) { return s.stop; }) -
                            lens.surfaces().begin())];
    EXPECT_LE(std::abs(at_stop.y), lens_section(lens).stop_radius * 1.0001f);
  }
  EXPECT_GT(passing, 5);
  EXPECT_LT(passing, 40);
}

TEST(LensSection, PathAlongTheAxisIsStraight) {
  const LensSystem lens = lens_named("wide_angle");
  const auto paths = lens_paths(lens, 0, 1, 10);
  ASSERT_TRUE(paths[0].passes);
  for (vec2 p : paths[0].points) EXPECT_NEAR(p.y, 0, 1e-5f);
}

TEST(LensBlur, IsThatOfAThinLensWhereTheLensIsStoppedDown) {
  // Far from the lens, where it does not matter from which of its planes one measures.
  const LensSystem lens = lens_named("double_gauss", 11, 5000);
  for (float distance : {2000.0f, 3000.0f, 10000.0f, 50000.0f}) {
    const float thin = thin_lens_blur(lens, distance);
    EXPECT_NEAR(lens_blur(lens, distance), thin, 0.04f * thin + 2e-4f) << distance;
  }
  EXPECT_LT(lens_blur(lens, 5000), 0.1f * lens_blur(lens, 3000));
}

TEST(LensBlur, OfAThinLensIsTheTextbooksFormula) {
  // A 50 mm lens at f/11 focused at 5 m, a point at 3 m: A |d - s| / d times the magnification f / (s - f).
  const LensSystem lens = lens_named("double_gauss", 11, 5000);
  EXPECT_NEAR(thin_lens_blur(lens, 3000), 50.0f / 11 * (2000.0f / 3000) * (50.0f / 4950), 2e-5f);
  const LensSystem infinite = lens_named("double_gauss", 11);
  EXPECT_NEAR(thin_lens_blur(infinite, 3000), 50.0f * 50 / 11 / 3000, 1e-4f);
}

} // namespace
} // namespace candela::test
