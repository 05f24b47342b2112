#include "app/lab/lens_lesson.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

LensLesson finished(const LensOptions& options, std::uint64_t samples = 20000) {
  LensLesson lesson(options, {}, samples);
  while (!lesson.finished()) lesson.advance(4096);
  return lesson;
}

TEST(LensLesson, LightIsThatOfTheLens) {
  LensOptions options;
  options.film_height = 14;
  const LensLesson lesson = finished(options);
  EXPECT_NEAR(lesson.illumination(), lesson.lens().relative_illumination(14), 0.005);
  EXPECT_GT(lesson.passing(), 0.5);
  EXPECT_LE(lesson.passing(), 1);
}

TEST(LensLesson, StoppedDownALensVignettesByCosinesAlone) {
  LensOptions options;
  options.f_stop = 11;
  const Plot plot = finished(options, 1).vignetting_plot();
  ASSERT_EQ(plot.series.size(), 2u);
  for (std::size_t i = 0; i < plot.series[0].points.size(); ++i)
    EXPECT_NEAR(plot.series[0].points[i].y, plot.series[1].points[i].y, 0.03 * plot.series[1].points[i].y)
        << i;
  options.f_stop = 0;
  const Plot open = finished(options, 1).vignetting_plot();
  EXPECT_LT(open.series[0].points.back().y, 0.8 * open.series[1].points.back().y);
}

TEST(LensLesson, SpotIsSmallestInFocus) {
  LensOptions options;
  options.focus = 2;
  const Plot plot = finished(options, 1).blur_plot();
  const auto& spots = plot.series.front().points;
  const auto smallest = std::ranges::min_element(spots, {}, &PlotPoint::y);
  EXPECT_NEAR(smallest->x, 2, 0.25);
}

} // namespace
} // namespace candela::test
