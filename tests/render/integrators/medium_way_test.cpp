// Distances along rays through media: their densities, and how they are sampled.

#include "render/integrators/medium_way.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace candela::test {
namespace {

Medium scattering(Spectrum sigma_s, Spectrum sigma_a = Spectrum(0)) {
  return HomogeneousMedium{sigma_a, sigma_s};
}

/// Nothing, a coloured fog, black smoke that does not scatter, and another fog.
struct Layers {
  Medium fog = scattering({0.2f, 0.7f, 3}, {0.1f, 0, 0.5f}),
         smoke = HomogeneousMedium{Spectrum(0.5f, 1, 0.1f)}, dense = scattering({2, 1, 0});
  MediumWay way;

  explicit Layers(float last = 2) {
    way.start({0, 0, 1});
    way.add({0, 0, 0}, 1.5f, {}, nullptr);
    way.add({0, 0, 1.5f}, 1, {}, &fog);
    way.add({0, 0, 2.5f}, 0.5f, {}, &smoke);
    way.add({0, 0, 3}, last, {}, &dense);
  }
};

const Spectrum kChannels(0.2f, 0.5f, 0.3f);

TEST(MediumWay, TransmittanceIsThatOfAllStretches) {
  const Layers l;
  const Spectrum depth =
      Spectrum(0.3f, 0.7f, 3.5f) + 0.5f * Spectrum(0.5f, 1, 0.1f) + 2.0f * Spectrum(2, 1, 0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(l.way.transmittance()[c], std::exp(-depth[c]), 1e-6f);
    EXPECT_NEAR(l.way.at(5).transmittance[c], std::exp(-depth[c]), 1e-6f);
  }
  EXPECT_TRUE(l.way.scatters());
  EXPECT_FALSE(l.way.emits());
  const MediumPoint point = l.way.at(2);
  EXPECT_EQ(point.segment->medium, &l.fog);
  EXPECT_NEAR(point.transmittance.z, std::exp(-1.75f), 1e-6f);
  EXPECT_NEAR(l.way.at(2.75f).unscattered.y, std::exp(-0.7f), 1e-6f) << "smoke does not scatter";
  EXPECT_EQ(l.way.position(point), vec3(0, 0, 2));
}

TEST(MediumWay, AnEndlessWayEndsInAMedium) {
  const Layers l(kInfinity);
  EXPECT_EQ(l.way.transmittance().x, 0);
  EXPECT_NEAR(l.way.transmittance().z, std::exp(-3.55f), 1e-6f)
      << "what does not absorb blue lets it through";
  EXPECT_NEAR(l.way.pass_probability({1, 0, 0}), 0, 1e-12f);
}

/// Distances in bins against the integral of their density.
void expect_distances(float from, float to, const std::function<std::optional<float>(vec2)>& draw,
                      const std::function<float(float)>& pdf, double share) {
  constexpr int kBins = 50, kDraws = 200000, kSteps = 400;
  std::vector<double> expected(kBins + 1), found(kBins + 1);
  std::mt19937_64 random(fresh_seed());
  std::uniform_real_distribution<double> uniform(0, 1);
  auto number = [&] { return std::min(static_cast<float>(uniform(random)), 1 - 0x1p-24f); };
  double total = 0;
  for (int i = 0; i < kBins * kSteps; ++i) {
    const double width = static_cast<double>(to - from) / (kBins * kSteps);
    const double p = width * static_cast<double>(pdf(from + static_cast<float>((i + 0.5) * width)));
    expected[static_cast<std::size_t>(i / kSteps)] += kDraws * p;
    total += p;
  }
  EXPECT_NEAR(total, share, 2e-3);
  expected[kBins] = kDraws * std::max(0.0, 1 - total);
  for (int i = 0; i < kDraws; ++i) {
    const auto t = draw({number(), number()});
    const auto bin = t ? static_cast<std::size_t>((*t - from) / (to - from) * kBins) : std::size_t{kBins};
    ++found[t ? std::min(bin, std::size_t{kBins - 1}) : bin];
  }
  EXPECT_GT(chi_square_test(found, expected).p_value, sidak_threshold(3)) << seed_note();
}

TEST(MediumWayStatistical, CollisionsFollowTheirDensity) {
  const Layers l;
  auto distance = [](const std::optional<MediumPoint>& p) {
    return p ? std::optional<float>(p->distance) : std::nullopt;
  };
  const double passes = static_cast<double>(l.way.pass_probability(kChannels));
  expect_distances(
      0, 5, [&](vec2 u) { return distance(l.way.sample_collision(kChannels, u)); },
      [&](float t) { return l.way.collision_pdf(l.way.at(t), kChannels); }, 1 - passes);
  expect_distances(
      0, 5, [&](vec2 u) { return distance(l.way.sample_forced_collision(kChannels, u)); },
      [&](float t) { return l.way.forced_collision_pdf(l.way.at(t), kChannels); }, 1);
}

TEST(MediumWay, AForcedCollisionIsFoundInTheThinnestMedium) {
  const Medium thin = scattering(Spectrum(1e-9f));
  MediumWay way;
  way.start({1, 0, 0});
  way.add({0, 0, 0}, 2, {}, &thin);
  const auto point = way.sample_forced_collision(Spectrum(1.0f / 3), {0.4f, 0.25f});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->distance, 0.5f, 1e-5f);
  EXPECT_NEAR(way.forced_collision_pdf(*point, Spectrum(1.0f / 3)), 0.5f, 1e-5f);
}

TEST(MediumWay, ForcedCollisionsLieWhereTheFormulaHasThem) {
  for (const float depth : {1e-6f, 1e-3f, 0.015f, 0.04f, 0.3f, 20.0f}) {
    const Medium medium = scattering(Spectrum(depth));
    MediumWay way;
    way.start({1, 0, 0});
    way.add({0, 0, 0}, 1, {}, &medium);
    const Spectrum channels(1.0f / 3);
    for (const float u : {0.01f, 0.3f, 0.7f, 0.99f}) {
      const auto point = way.sample_forced_collision(channels, {0.5f, u});
      ASSERT_TRUE(point);
      const double d = static_cast<double>(depth), absorbed = -std::expm1(-d);
      const double exact = -std::log1p(-static_cast<double>(u) * absorbed) / d;
      EXPECT_NEAR(static_cast<double>(point->distance), exact, 1e-5 * exact) << depth << ", " << u;
      const double density = d * std::exp(-d * static_cast<double>(point->distance)) / absorbed;
      EXPECT_NEAR(static_cast<double>(way.forced_collision_pdf(*point, channels)), density, 1e-5 * density);
    }
  }
}

TEST(MediumWayStatistical, EquiangularDistancesFollowTheirDensity) {
  const EquiangularSampling near({0, 0, 0}, {0, 0, 1}, {0.3f, 0, 2}, 1.5f, 5);
  expect_distances(
      1.5f, 5, [&](vec2 u) { return near.sample(u.x); }, [&](float t) { return near.pdf(t); }, 1);
}

TEST(EquiangularSampling, StaysOnItsStretch) {
  for (const vec3 point : {vec3(0.3f, 0, 2), vec3(0, 0, 2), vec3(0, 0, -7), vec3(1e6f, 0, 0)})
    for (const float end : {3.0f, kInfinity}) {
      const EquiangularSampling s({0, 0, 0}, {0, 0, 1}, point, 1, end);
      for (const float u : {0.0f, 1e-6f, 0.3f, 0.999f, 1 - 0x1p-24f}) {
        const float t = s.sample(u);
        EXPECT_TRUE(std::isfinite(t) && t >= 1 && t <= end) << t;
        EXPECT_GT(s.pdf(t), 0);
      }
    }
}

TEST(MediumWay, ChannelsHaveTheirShareOfTheThroughput) {
  EXPECT_EQ(channel_probabilities({2, 1, 1}), Spectrum(0.5f, 0.25f, 0.25f));
  EXPECT_EQ(channel_probabilities(Spectrum(0)), Spectrum(1.0f / 3));
}

} // namespace
} // namespace candela::test
