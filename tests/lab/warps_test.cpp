#include "lab/warps.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

int warp_count() { return static_cast<int>(warp_fields()[0].choices.size()); }

WarpLesson finished(const WarpOptions& options, std::uint64_t samples, SamplerType type, std::uint64_t seed) {
  WarpLesson lesson(options, {type, seed}, samples);
  lesson.advance(samples);
  return lesson;
}

std::vector<WarpOptions> every_warp() {
  std::vector<WarpOptions> all;
  for (int i = 0; i < warp_count(); ++i) all.push_back({static_cast<Warp>(i)});
  for (float angle : {0.1f, 120.0f, 180.0f}) all.push_back({Warp::cone, radians(angle)});
  return all;
}

TEST(Warps, TheirDensitiesIntegrateToOne) {
  for (const WarpOptions& options : every_warp())
    EXPECT_NEAR(WarpLesson(options, {}, 1).histogram().integral(), 1, 3e-6)
        << static_cast<int>(options.warp) << ' ' << degrees(options.cone_angle);
}

TEST(Warps, ChartsInvertAndKeepTheirMeasure) {
  for (const WarpOptions& options : every_warp()) {
    if (options.cone_angle < radians(1.0f)) continue; // too small to measure by differences of floats
    SCOPED_TRACE(static_cast<int>(options.warp));
    const WarpMap warp(options);
    for (float y : {0.21f, 0.5f, 0.83f})
      for (float x : {0.13f, 0.4f, 0.77f}) {
        const vec2 q(x, y);
        const vec2 back = warp.chart(warp.from_chart(q));
        EXPECT_NEAR(back.x, x, 3e-6f);
        EXPECT_NEAR(back.y, y, 3e-6f);
        const float h = 2e-3f; // the area of the image of a small square of the chart
        const vec3 dx = warp.from_chart(q + vec2(h, 0)) - warp.from_chart(q - vec2(h, 0));
        const vec3 dy = warp.from_chart(q + vec2(0, h)) - warp.from_chart(q - vec2(0, h));
        const double area = static_cast<double>(glm::length(glm::cross(dx, dy)) / (4 * h * h));
        EXPECT_NEAR(area / warp.chart_measure(q), 1, 2e-3);
      }
  }
}

TEST(WarpsStatistical, EveryDensityIsWhatIsSampled) {
  SCOPED_TRACE(seed_note());
  const auto all = every_warp();
  for (const WarpOptions& options : all) {
    const auto lesson = finished(options, 300000, SamplerType::independent, fresh_seed());
    EXPECT_EQ(lesson.histogram().outside, 0);
    EXPECT_GT(lesson.histogram().chi_square().p_value, sidak_threshold(static_cast<int>(all.size())))
        << static_cast<int>(options.warp) << ' ' << degrees(options.cone_angle);
  }
}

TEST(WarpsStatistical, AWrongDensityShows) {
  SCOPED_TRACE(seed_note());
  const auto seed = fresh_seed();
  Histogram cosine = finished({Warp::cosine_hemisphere}, 100000, SamplerType::independent, seed).histogram();
  Histogram uniform = finished({Warp::hemisphere}, 100000, SamplerType::independent, seed).histogram();
  std::swap(cosine.expected, uniform.expected);
  EXPECT_LT(cosine.chi_square().p_value, 1e-6);
  EXPECT_LT(uniform.chi_square().p_value, 1e-6);
  std::swap(cosine.expected, uniform.expected);
  EXPECT_GT(cosine.chi_square().p_value, kFalseAlarm);
  for (double& share : cosine.expected) share *= 1.1; // a constant that is 10 % off
  EXPECT_LT(cosine.chi_square().p_value, 1e-6) << "a density that does not integrate to 1";
}

TEST(Warps, DoNotDependOnTheSteps) {
  WarpLesson whole({Warp::disc}, {SamplerType::sobol, 4}, 1000), steps = whole;
  whole.advance(1000);
  while (!steps.finished()) steps.advance(77);
  EXPECT_EQ(whole.histogram().counts, steps.histogram().counts);
  EXPECT_EQ(whole.histogram().total, 1000);
  // Replayed draws are in the same cells.
  std::vector<double> counts(whole.histogram().counts.size());
  for (std::uint64_t i = 0; i < 1000; ++i)
    ++counts[whole.histogram().grid.cell(whole.warp().chart(whole.replay(i)))];
  EXPECT_EQ(counts, whole.histogram().counts);
}

} // namespace
} // namespace candela::test
