#include "lab/brdf.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

BrdfLesson finished(const Bsdf& bsdf, const BrdfOptions& options, std::uint64_t samples, std::uint64_t seed) {
  BrdfLesson lesson(bsdf, options, {SamplerType::independent, seed}, samples);
  lesson.advance(samples);
  return lesson;
}

const std::vector<Bsdf>& models() {
  static const std::vector<Bsdf> all = {Diffuse{vec3(0.7f)},         Phong{vec3(0.3f), vec3(0.5f), 60},
                                        Ggx{vec3(0.9f), 0.05f},      Ggx{vec3(0.6f), 0.4f},
                                        Ggx{{1, 0.5f, 0.2f}, 1},     Mirror{vec3(0.6f), vec3(0.4f)},
                                        Dielectric{1.5f, vec3(0.9f)}};
  return all;
}

TEST(BrdfLessonStatistical, EveryDensityIsWhatIsSampled) {
  SCOPED_TRACE(seed_note());
  const int tests = static_cast<int>(models().size()) * 3 * 3;
  for (std::size_t m = 0; m < models().size(); ++m)
    for (float theta : {0.0f, 35.0f, 80.0f})
      for (auto how : {DirectionSampling::uniform, DirectionSampling::cosine, DirectionSampling::bsdf}) {
        SCOPED_TRACE(testing::Message() << "model " << m << ", " << theta << ", " << static_cast<int>(how));
        const auto lesson = finished(models()[m], {radians(theta), how}, 100000, fresh_seed());
        EXPECT_GT(lesson.histogram().chi_square().p_value, sidak_threshold(tests));
        EXPECT_LT(lesson.histogram().integral(), 1.0001);
      }
}

TEST(BrdfLessonStatistical, TheAlbedoIsTheSameBySamplingEitherWay) {
  SCOPED_TRACE(seed_note());
  for (std::size_t m = 0; m < models().size(); ++m) {
    if (m == 2) continue; // hardly any sample over the hemisphere is in so narrow a lobe
    SCOPED_TRACE(m);
    const auto own = finished(models()[m], {radians(50.0f), DirectionSampling::bsdf}, 200000, fresh_seed());
    const auto cosine =
        finished(models()[m], {radians(50.0f), DirectionSampling::cosine}, 200000, fresh_seed() + 1);
    for (int c = 0; c < 3; ++c) {
      const float error = std::hypot(own.albedo_error()[c], cosine.albedo_error()[c]) + 1e-6f;
      EXPECT_GT(normal_p_value(static_cast<double>((own.albedo()[c] - cosine.albedo()[c]) / error)),
                sidak_threshold(18));
      EXPECT_LE(own.albedo()[c], 1 + 6 * own.albedo_error()[c] + 1e-5f);
    }
  }
}

TEST(BrdfLesson, LambertsAlbedoIsItsReflectance) {
  const auto lesson = finished(Diffuse{{0.2f, 0.5f, 0.8f}}, {}, 1000, 1);
  EXPECT_NEAR(lesson.albedo().x, 0.2f, 1e-6f);
  EXPECT_NEAR(lesson.albedo().z, 0.8f, 1e-6f);
  EXPECT_EQ(lesson.failed(), 0u);
  EXPECT_TRUE(lesson.delta_lobes().empty());
}

TEST(BrdfLesson, FindsTheDeltaLobes) {
  const auto lesson = finished(Dielectric{1.5f, vec3(1)}, {radians(30.0f)}, 20000, 1);
  ASSERT_EQ(lesson.delta_lobes().size(), 2u);
  std::uint64_t count = 0;
  for (const DeltaLobe& lobe : lesson.delta_lobes()) {
    count += lobe.count;
    // Snell: sin 30 degrees / 1.5 on the other side, the mirror image on this one.
    EXPECT_NEAR(lobe.wi.x, lobe.wi.z > 0 ? -0.5f : -0.5f / 1.5f, 1e-6f);
  }
  EXPECT_EQ(count, 20000u);
  EXPECT_EQ(lesson.histogram().outside, 20000);
}

TEST(BrdfLesson, DoesNotDependOnTheSteps) {
  BrdfLesson whole(Ggx{}, {}, {SamplerType::sobol, 1}, 500), steps = whole;
  whole.advance(500);
  while (!steps.finished()) steps.advance(33);
  EXPECT_EQ(whole.albedo(), steps.albedo());
  EXPECT_EQ(whole.histogram().counts, steps.histogram().counts);
}

TEST(BrdfLesson, TheChartInverts) {
  for (float y : {0.05f, 0.5f, 0.9f})
    for (float x : {0.01f, 0.3f, 0.99f}) {
      const vec2 back = direction_chart(direction_from_chart({x, y}));
      EXPECT_NEAR(back.x, x, 1e-6f);
      EXPECT_NEAR(back.y, y, 1e-6f);
    }
}

TEST(BrdfLesson, TheChartKeepsGrazingDirectionsOnTheirSide) {
  for (float z : {1e-6f, 3e-8f, 1e-8f, 1e-20f}) {
    EXPECT_LT(direction_chart({0.6f, 0.8f, z}).y, 0.5f) << z;
    EXPECT_GE(direction_chart({0.6f, 0.8f, -z}).y, 0.5f) << z;
  }
}

} // namespace
} // namespace candela::test
