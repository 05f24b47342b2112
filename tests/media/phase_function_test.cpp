#include "media/medium_desc.h"
#include "media/phase_function.h"
#include "media/volume_scattering.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace candela::test {
namespace {

struct PhaseCase {
  std::string name;
  PhaseFunction phase;
  double width; ///< radians about the straight direction that hold most of the light
};

std::vector<PhaseCase> phase_cases() {
  std::vector<PhaseCase> all = {{"isotropic", IsotropicPhase{}, 2}, {"rayleigh", Rayleigh{}, 2}};
  for (const float g : {-0.99f, -0.6f, -1e-4f, 0.0f, 0.05f, 0.5f, 0.9f, 0.99f})
    all.push_back({fmt::format("henyey_greenstein {}", g), HenyeyGreenstein{g},
                   std::min(2.0, 3 * (1 - std::abs(static_cast<double>(g))))});
  for (const float d : {5.0f, 12.0f, 50.0f})
    all.push_back({fmt::format("droplets {}", d), DropletsPhase{d}.closure(), 0.05});
  return all;
}

TEST(PhaseFunction, SamplesAgree) {
  for (const PhaseCase& c : phase_cases())
    expect_samples_agree(tested(c.name, VolumeScattering{c.phase}, c.width));
}

TEST(PhaseFunctionStatistical, DirectionsFollowTheDensity) {
  const std::vector<PhaseCase> all = phase_cases();
  const vec3 from[] = {{0, 0, 1}, {0, 0, -1}, polar(1.1, 2.3), polar(2.9, -1)};
  for (const PhaseCase& c : all)
    for (const vec3 wo : from) {
      // The bins are crowded about the mirrored and the straight direction.
      if (mean_cosine(c.phase) < -0.9f && std::abs(wo.z) < 1) continue;
      expect_directions_follow_pdf(tested(c.name, VolumeScattering{c.phase}, c.width), wo,
                                   static_cast<int>(std::size(from) * all.size()));
    }
}

/// The integral of f over the sphere; points are crowded forward and backward.
double over_turns(const std::function<double(Turn)>& f) {
  const int n = 400000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) / n, v = s * s * s * s; // of the distance from straight on, or straight back
    const Turn turn{static_cast<float>(v), static_cast<float>(2 - v)};
    sum += (f(turn) + f(turn.reversed())) * 4 * s * s * s;
  }
  return 2 * std::numbers::pi * sum / n;
}

TEST(PhaseFunction, IsNormalisedWithItsMeanCosine) {
  for (const PhaseCase& c : phase_cases()) {
    auto eval = [&](Turn turn) { return static_cast<double>(phase_eval(c.phase, turn)); };
    EXPECT_NEAR(over_turns(eval), 1, 2e-5) << c.name;
    EXPECT_NEAR(over_turns([&](Turn turn) { return eval(turn) * static_cast<double>(turn.cosine()); }),
                static_cast<double>(mean_cosine(c.phase)), 2e-5)
        << c.name;
  }
}

/// To a standard error of 0.05 % (of 1, where the mean is less).
TEST(PhaseFunctionStatistical, MeanCosineOfSamples) {
  std::mt19937_64 random(fresh_seed());
  std::uniform_real_distribution<float> uniform(0, 1);
  const std::vector<PhaseCase> all = phase_cases();
  for (const PhaseCase& c : all) {
    RunningStatistics cosine;
    while (cosine.count() < 4'000'000) {
      const float u = std::min(uniform(random), 1 - 0x1p-24f),
                  choice = std::min(uniform(random), 1 - 0x1p-24f);
      cosine.add(static_cast<double>(phase_sample(c.phase, u, choice).cosine()));
    }
    const double exact = static_cast<double>(mean_cosine(c.phase));
    EXPECT_LT(std::sqrt(cosine.variance_of_mean()), 5e-4 * std::max(std::abs(exact), 0.65)) << c.name;
    EXPECT_GT(z_test(cosine, exact, 1e-6), sidak_threshold(static_cast<int>(all.size())))
        << c.name << ": " << cosine.mean() << "; " << seed_note();
  }
}

/// The formulas as their authors have them, in cosines.
TEST(PhaseFunction, IsThatOfItsAuthors) {
  const double four_pi = 4 * std::numbers::pi;
  for (double cosine = -1; cosine <= 1; cosine += 1.0 / 64) {
    const Turn turn{static_cast<float>(1 - cosine), static_cast<float>(1 + cosine)};
    auto lobe = [&](double g) { return (1 - g * g) / (four_pi * std::pow(1 + g * g - 2 * g * cosine, 1.5)); };
    for (const double g : {-0.9, 0.3, 0.95}) {
      const double ours = static_cast<double>(HenyeyGreenstein{static_cast<float>(g)}.eval(turn));
      EXPECT_NEAR(ours / lobe(g), 1, 1e-4) << g << ", " << cosine;
    }
    EXPECT_NEAR(static_cast<double>(Rayleigh{}.eval(turn)), 0.75 * (1 + cosine * cosine) / four_pi, 1e-7);
    auto draine = [&](double g, double a) {
      return lobe(g) * (1 + a * cosine * cosine) / (1 + a * (1 + 2 * g * g) / 3);
    };
    EXPECT_NEAR(static_cast<double>(Draine(0, 1).eval(turn)), draine(0, 1), 1e-7);
    // Of 10 micrometres, by the numbers of the paper.
    const double share = std::exp(-0.599085 / (10 - 0.641583) - 0.665888);
    const double exact = (1 - share) * lobe(std::exp(-0.0990567 / (10 - 1.67154))) +
                         share * draine(std::exp(-2.20679 / (10 + 3.91029) - 0.428934),
                                        std::exp(3.62489 - 8.29288 / (10 + 5.52825)));
    EXPECT_NEAR(static_cast<double>(DropletsPhase{10}.closure().eval(turn)) / exact, 1, 2e-4) << cosine;
  }
}

TEST(PhaseFunction, DraineWithoutALobeIsRayleigh) {
  for (int i = 0; i < 1000; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 1000;
    EXPECT_NEAR(Draine(0, 1).sample(u, 0).forward, Rayleigh{}.sample(u, 0).forward, 2e-6f) << u;
  }
}

TEST(MediumDesc, MakesCoefficients) {
  MediumDesc desc;
  desc.model = HomogeneousMediumModel{{1, 2, 4}, {0, 0.5f, 1}};
  desc.scale = 3;
  desc.phase.model = HenyeyGreensteinPhase{0.4f};
  const auto medium = std::get<HomogeneousMedium>(make_medium(desc, {{0, 0, 1}}));
  EXPECT_EQ(medium.sigma_a, vec3(3, 3, 1));
  EXPECT_EQ(medium.sigma_s, vec3(0, 3, 12));
  EXPECT_EQ(mean_cosine(medium.phase), 0.4f);
}

TEST(MediumDesc, MeasuredScatteringIsReduced) {
  MediumDesc desc;
  desc.model = MeasuredMediumModel{3};
  desc.scale = 10;
  desc.phase.model = HenyeyGreensteinPhase{0.75f};
  const auto cream = std::get<HomogeneousMedium>(make_medium(desc));
  EXPECT_NEAR(cream.sigma_s.x, 10 * 4 * 7.38f, 1e-3f);
  EXPECT_NEAR(cream.sigma_a.y, 10 * 0.0028f, 1e-6f);
}

TEST(MediumDesc, ATypeKeepsWhatBothHave) {
  PhaseDesc phase;
  phase.model = HenyeyGreensteinPhase{0.4f};
  change_type(phase, 2);
  EXPECT_TRUE(std::holds_alternative<RayleighPhase>(phase.model));
  change_type(phase, 1);
  EXPECT_EQ(std::get<HenyeyGreensteinPhase>(phase.model).g, 0);
}

TEST(MediumDesc, ProblemsAreNamed) {
  MediumDesc fog;
  fog.name = "fog";
  EXPECT_EQ(media_problem({fog}), "");
  EXPECT_EQ(media_problem({fog, fog}), "media[1].name: 'fog' is there twice; give each its own");
  EXPECT_EQ(media_problem({MediumDesc{}}).substr(0, 23), "media[0].name: is empty");
  MediumDesc wrong = fog;
  wrong.model = HomogeneousMediumModel{vec3(1), vec3(1.5f)};
  EXPECT_EQ(media_problem({wrong}).substr(0, 16), "media[0].albedo:");
  wrong = fog;
  wrong.phase.model = HenyeyGreensteinPhase{1};
  EXPECT_EQ(media_problem({wrong}).substr(0, 17), "media[0].phase.g:");
}

} // namespace
} // namespace candela::test
