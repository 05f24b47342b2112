// Display settings applied to pictures: automatic exposure, false colours.

#include "core/color.h"
#include "imaging/display_transform.h"
#include "imaging/exposure.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

DisplayTransform transform_of(const std::vector<vec3>& linear, int width, const DisplaySettings& display,
                              View view, float scale = 1) {
  return display_transform(linear, width, static_cast<int>(linear.size()) / width, display, view, scale);
}

TEST(AutomaticExposure, AGreyPictureBecomesMiddleGrey) {
  for (float grey : {1e-4f, 0.18f, 3.0f, 1e5f}) {
    const std::vector<vec3> linear(50 * 30, vec3(grey));
    EXPECT_NEAR(automatic_exposure(linear, 50, 30), std::log2(0.18f / grey), 1e-4f) << grey;
  }
}

TEST(AutomaticExposure, IsTheLogAverageOfItsCells) {
  // Half of the picture is 16 times as bright: the mean of the logarithms is two stops above the darker half.
  std::vector<vec3> linear;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) linear.emplace_back(x < 64 ? 0.1f : 1.6f);
  EXPECT_NEAR(automatic_exposure(linear, 128, 128), std::log2(0.18f / 0.4f), 1e-4f);
  for (vec3& pixel : linear)
    if (pixel.x < 1) pixel = vec3(0); // black has no logarithm: the rest decides
  EXPECT_NEAR(automatic_exposure(linear, 128, 128), std::log2(0.18f / 1.6f), 1e-4f);
}

TEST(AutomaticExposure, BlackAndNonFinitePixelsDoNoHarm) {
  EXPECT_EQ(automatic_exposure(std::vector<vec3>(12, vec3(0)), 4, 3), 0);
  EXPECT_EQ(automatic_exposure(std::vector<vec3>(12, vec3(-1)), 4, 3), 0);
  std::vector<vec3> linear(100, vec3(1));
  linear[3] = vec3(std::nanf("")), linear[40] = vec3(kInfinity);
  EXPECT_NEAR(automatic_exposure(linear, 10, 10), std::log2(0.18f), 1e-4f);
}

TEST(AutomaticExposureStatistical, StandsStillWhileThePictureRefines) {
  // Pixels of one sample: one in twenty is lit, with twenty times the mean. A mean of pixels' logarithms
  // would be wrong by stops.
  std::mt19937_64 random(fresh_seed());
  std::uniform_int_distribution<int> chance(0, 19);
  std::vector<vec3> noisy(640 * 640);
  for (vec3& pixel : noisy) pixel = vec3(chance(random) == 0 ? 20.0f : 0.0f);
  // A cell has 100 pixels, of which 5 +- 2.2 are lit: the mean logarithm is lower by 1 / (2 ln 2) of the
  // relative variance 0.19, and 4096 cells average out the rest. Empty cells (0.6 %) are skipped.
  EXPECT_NEAR(automatic_exposure(noisy, 640, 640), std::log2(0.18f), 0.25f) << seed_note();
}

TEST(DisplayTransform, ExposuresAdd) {
  const std::vector<vec3> linear(16, vec3(0.09f));
  DisplaySettings display;
  display.exposure = 0.5f;
  EXPECT_EQ(transform_of(linear, 4, display, View::radiance).tone.exposure, 0.5f);
  display.auto_exposure = true;
  const DisplayTransform automatic = transform_of(linear, 4, display, View::radiance);
  EXPECT_NEAR(automatic.automatic_exposure, 1, 1e-4f);
  EXPECT_NEAR(automatic.tone.exposure, 1.5f, 1e-4f);
  EXPECT_FALSE(automatic.tone.auto_exposure);
  EXPECT_EQ(transform_of(linear, 4, display, View::albedo).tone.exposure, 0) << "a reflectance is no light";
  std::vector<std::uint8_t> rgb(3 * linear.size());
  display.exposure = 0;
  display.dither = false;
  display_rgb8(linear, {4}, transform_of(linear, 4, display, View::radiance), rgb);
  EXPECT_EQ(rgb[0], srgb8_from_linear(0.18f));
}

TEST(DisplayTransform, ColoursScalarViewsAloneUnlessAsked) {
  const std::vector<vec3> linear(16, vec3(0.5f));
  for (int view = 0; view <= static_cast<int>(View::nonfinite); ++view) {
    DisplaySettings display;
    EXPECT_EQ(transform_of(linear, 4, display, View{view}).false_color.has_value(),
              is_scalar_view(View{view}));
    display.false_color = FalseColor::off;
    EXPECT_FALSE(transform_of(linear, 4, display, View{view}).false_color);
    display.false_color = FalseColor::magma;
    ASSERT_TRUE(transform_of(linear, 4, display, View{view}).false_color);
    EXPECT_EQ(transform_of(linear, 4, display, View{view}).false_color->map, ColorMap::magma);
  }
  EXPECT_TRUE(is_scalar_view(View::depth));
  EXPECT_FALSE(is_scalar_view(View::normal));
}

TEST(FalseColor, RangesAreRobustAndMayBeGiven) {
  std::vector<vec3> linear;
  for (int i = 0; i < 10000; ++i) linear.emplace_back(static_cast<float>(i + 1) * 0.01f); // 0.01 to 100
  linear[17] = vec3(1e30f), linear[18] = vec3(kInfinity), linear[19] = vec3(std::nanf("")),
  linear[20] = vec3(0);
  DisplaySettings display;
  auto scale = *transform_of(linear, 100, display, View::depth).false_color;
  EXPECT_NEAR(scale.lo, 1, 0.1f);
  EXPECT_NEAR(scale.hi, 99, 0.1f);
  EXPECT_FALSE(scale.logarithmic);
  scale = *transform_of(linear, 100, display, View::variance).false_color;
  EXPECT_TRUE(scale.logarithmic);
  EXPECT_NEAR(scale.lo, 1, 0.1f);
  scale = *transform_of(linear, 100, display, View::bvh_cost).false_color;
  EXPECT_EQ(scale.lo, 0);
  scale = *transform_of(linear, 100, display, View::light_share).false_color;
  EXPECT_EQ(scale.lo, 0);
  EXPECT_EQ(scale.hi, 1);
  const std::vector<vec3> counts(100, vec3(64));
  scale = *transform_of(counts, 10, display, View::samples).false_color;
  EXPECT_EQ(scale.lo, 0);
  EXPECT_EQ(scale.hi, 64);
  display.false_color_min = -3, display.false_color_max = 5;
  scale = *transform_of(linear, 100, display, View::depth).false_color;
  EXPECT_EQ(scale.lo, -3);
  EXPECT_EQ(scale.hi, 5);
}

TEST(FalseColor, EveryPictureHasARange) {
  for (float value : {0.0f, 1.0f, -2.0f, 1e-30f, kInfinity, std::nanf("")})
    for (int view = 0; view <= static_cast<int>(View::nonfinite); ++view) {
      DisplaySettings display;
      display.false_color = FalseColor::viridis;
      const auto scale = *transform_of(std::vector<vec3>(9, vec3(value)), 3, display, View{view}).false_color;
      EXPECT_LT(scale.lo, scale.hi) << value << ' ' << view;
      EXPECT_TRUE(std::isfinite(scale.lo) && std::isfinite(scale.hi));
    }
}

TEST(FalseColor, MapsItsEndsToTheEndsOfTheColours) {
  for (bool logarithmic : {false, true}) {
    const FalseColorScale scale{ColorMap::magma, 0.25f, 64, logarithmic, false};
    EXPECT_EQ(scale.position(0.25f), 0);
    EXPECT_EQ(scale.position(64), 1);
    EXPECT_NEAR(scale.position(scale.value(0.3f)), 0.3f, 1e-5f);
  }
  EXPECT_NEAR((FalseColorScale{ColorMap::magma, 0.25f, 64, true, false}.value(0.5f)), 4, 1e-5f);

  DisplayTransform transform;
  transform.false_color = FalseColorScale{ColorMap::viridis, 1, 3, false, true};
  const std::vector<vec3> linear = {vec3(1), vec3(3), vec3(2), vec3(-5), vec3(9), vec3(std::nanf("")),
                                    vec3(0)};
  std::vector<std::uint8_t> rgb(3 * linear.size()), rgba(4 * linear.size());
  display_rgb8(linear, {7}, transform, rgb);
  display_rgba8(linear, {7}, transform, rgba);
  auto color = [&](std::size_t i) { return std::array{rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]}; };
  EXPECT_EQ(color(0), map_color(ColorMap::viridis, 0));
  EXPECT_EQ(color(1), map_color(ColorMap::viridis, 1));
  EXPECT_EQ(color(3), map_color(ColorMap::viridis, 0)) << "below: clipped";
  EXPECT_EQ(color(4), map_color(ColorMap::viridis, 1)) << "above: clipped";
  EXPECT_EQ(color(5), map_color(ColorMap::viridis, 0));
  EXPECT_EQ(color(6), (std::array<std::uint8_t, 3>{0, 0, 0})) << "no surface";
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(color(2)[c], map_color(ColorMap::viridis, 0.5f)[c], 1) << "the table's steps are small";
  for (std::size_t i = 0; i < linear.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(rgba[4 * i + c], rgb[3 * i + c]);
    EXPECT_EQ(rgba[4 * i + 3], 255);
  }
}

} // namespace
} // namespace candela::test
