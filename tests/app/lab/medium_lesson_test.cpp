#include "app/lab/medium_lesson.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

MediumLesson walked(const MediumLessonOptions& options, std::uint64_t samples = 200000) {
  MediumLesson lesson(options, {SamplerType::independent, fresh_seed()}, samples);
  while (!lesson.finished()) lesson.advance(5000);
  return lesson;
}

int phase_of_name(std::string_view name) {
  const auto names = phase_type_field().choices;
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

/// Of conservative isotropic slabs under light along the normal: what they reflect (van de Hulst 1980,
/// "Multiple Light Scattering", table 12: diffuse transmission and reflection are 1 - exp(-b) together).
TEST(MediumLesson, TheoryKeepsTheEnergyAndKnowsItsLimits) {
  for (const double depth : {0.05, 1.0, 8.0, 60.0})
    for (const double mu0 : {1.0, 0.3}) {
      const SlabShares lossless = isotropic_slab(depth, 1, mu0);
      EXPECT_NEAR(lossless.absorbed, 0, 2e-3) << depth;
      const SlabShares black = isotropic_slab(depth, 0, mu0);
      EXPECT_EQ(black.reflected, 0);
      EXPECT_NEAR(black.absorbed, 1 - std::exp(-depth / mu0), 1e-12);
    }
  // A half space: 1 - sqrt(1 - omega) H(mu) (Chandrasekhar 1960, chapter V); of H(1) it has 1.2513 for
  // omega = 0.5 and 1.8501 for 0.9 (table XI).
  EXPECT_NEAR(isotropic_slab(40, 0.5, 1).reflected, 1 - std::sqrt(0.5) * 1.2513, 2e-3);
  EXPECT_NEAR(isotropic_slab(60, 0.9, 1).reflected, 1 - std::sqrt(0.1) * 1.8501, 4e-3);
}

/// What is counted is what the integral equation has.
TEST(MediumLessonStatistical, IsotropicWalksFollowTheTheory) {
  for (const float depth : {0.3f, 2.0f, 10.0f})
    for (const float albedo : {0.5f, 0.95f}) {
      MediumLessonOptions options;
      options.optical_depth = depth, options.albedo = albedo, options.theta = radians(50.0f);
      const MediumLesson lesson = walked(options);
      EXPECT_TRUE(lesson.theory_is_exact());
      const SlabShares found = lesson.counted(), &theory = lesson.theory();
      for (const auto& [counted, exact] : {std::pair{found.reflected, theory.reflected},
                                           {found.transmitted, theory.transmitted},
                                           {found.direct, theory.direct},
                                           {found.absorbed, theory.absorbed}}) {
        const double excess = std::max(std::abs(counted - exact) - 5e-4, 0.0); // the cells' error
        EXPECT_GT(normal_p_value(excess / lesson.error(exact)), sidak_threshold(24))
            << depth << ", " << albedo << ": " << counted << " against " << exact << "; " << seed_note();
      }
    }
}

TEST(MediumLessonStatistical, SimilarSlabsReflectAlike) {
  MediumLessonOptions options;
  options.phase = phase_of_name("henyey_greenstein");
  options.g = 0.8f, options.optical_depth = 20, options.albedo = 0.99f;
  const MediumLesson lesson = walked(options, 50000);
  EXPECT_FALSE(lesson.theory_is_exact());
  EXPECT_NEAR(lesson.counted().reflected, lesson.theory().reflected, 0.06);
  EXPECT_NEAR(lesson.counted().transmitted, lesson.theory().transmitted, 0.06);
  EXPECT_NEAR(lesson.counted().direct, lesson.theory().direct, 1e-3);
}

TEST(MediumLesson, FlightsAreExponential) {
  const MediumLesson lesson = walked({});
  EXPECT_NEAR(lesson.mean_flight(), 1, 0.02);
  const Plot plot = lesson.flight_plot();
  ASSERT_EQ(plot.series.size(), 2u);
  for (std::size_t i = 0; i < plot.series[0].points.size(); ++i)
    EXPECT_NEAR(plot.series[0].points[i].y, plot.series[1].points[i].y, 0.04);
}

TEST(MediumLesson, OnlyWhatThePhaseFunctionHasIsAskedFor) {
  MediumLessonOptions options;
  EXPECT_FALSE(medium_lesson_uses(options, "g"));
  options.phase = phase_of_name("henyey_greenstein");
  options.g = -0.3f;
  EXPECT_TRUE(medium_lesson_uses(options, "g"));
  EXPECT_FALSE(medium_lesson_uses(options, "diameter"));
  EXPECT_NEAR(mean_cosine(options.phase_function()), -0.3f, 1e-6f);
}

} // namespace
} // namespace candela::test
