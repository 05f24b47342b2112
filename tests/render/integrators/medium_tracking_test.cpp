// Tracking through grids against quadrature along the same ray.

#include "core/blackbody.h"
#include "media/medium_desc.h"
#include "render/integrators/medium_tracking.h"
#include "support/seed.h"
#include "support/statistics.h"
#include "support/volumes.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace candela::test {
namespace {

MediumDesc grid_desc(VolumeGrid grid, vec3 sigma_t, vec3 albedo) {
  MediumDesc desc;
  GridMediumModel model;
  model.center = {0.5f, 0, 0}, model.size = {3, 2, 2.5f};
  model.sigma_t = sigma_t, model.albedo = albedo;
  model.grid = std::make_shared<const VolumeGrid>(std::move(grid));
  desc.model = model;
  return desc;
}

const vec3 kOrigin(-3, 0.2f, -0.1f);
const vec3 kDirection = glm::normalize(vec3(1, 0.05f, 0.03f));

/// Nothing, a fog, a grid that scatters and glows, one of which nothing but absorption is left.
struct CloudyWay {
  Medium fog = HomogeneousMedium{{0.05f, 0.1f, 0}, {0.1f, 0.3f, 0.5f}, Spectrum(0.4f)};
  Medium cloud, soot;
  MediumWay way;

  explicit CloudyWay(TransmittanceEstimator estimator) : way(true) {
    VolumeGrid hot = wavy_grid({33, 20, 25});
    hot.temperature = hot.density;
    for (float& t : hot.temperature) t = 1 - t;
    hot.color.assign(hot.density.size(), vec3(0.9f, 1, 0.4f));
    MediumDesc desc = grid_desc(std::move(hot), {1, 2, 0.4f}, {0.8f, 0.6f, 0.9f});
    desc.emission = {3, 2, 1};
    std::get<GridMediumModel>(desc.model).temperature = 2500;
    cloud = make_medium(desc, {Spectrum(0.02f, 0, 0.1f), estimator});
    soot = make_medium(grid_desc(random_grid({19, 18, 30}, 3), {0.8f, 0.3f, 1}, vec3(0)),
                       {Spectrum(0), estimator});
    way.start(kDirection);
    way.add(kOrigin, 1, {}, nullptr);
    way.add(kOrigin + kDirection, 1, {}, &fog);
    way.add(kOrigin + 2.0f * kDirection, 1.7f, {}, &cloud);
    way.add(kOrigin + 3.7f * kDirection, 1.2f, {}, &soot);
    way.add(kOrigin + 4.9f * kDirection, 0.3f, {}, &cloud);
  }
};

/// The coefficients at a distance of the way, W/(m^2 sr) a unit for the emission.
struct Coefficients {
  Spectrum sigma_t{0}, sigma_s{0}, emission{0};
};
Coefficients coefficients_at(const CloudyWay& c, float t) {
  const vec3 place = kOrigin + t * kDirection;
  auto of = [&](const Medium& medium) -> Coefficients {
    if (const auto* uniform = std::get_if<HomogeneousMedium>(&medium))
      return {uniform->sigma_t(), uniform->sigma_s, uniform->sigma_a * uniform->emission};
    const auto& grid = std::get<GridMedium>(medium);
    const vec3 cell = grid.to_cells(place);
    const Spectrum dense = grid.bricks->density(cell) * grid.density_sigma_t;
    return {dense + grid.absorption, grid.sigma_s_at(place), grid.emitted_at(cell, dense)};
  };
  if (t < 1) return {};
  if (t < 2) return of(c.fog);
  if (t < 3.7f || t >= 4.9f) return of(c.cloud);
  return of(c.soot);
}

constexpr int kBins = 8;
constexpr float kLength = 5.2f;

/// By quadrature: of the light scattered in each bin, of what comes through, of what is sent out.
struct Exact {
  std::array<glm::dvec3, kBins> scattered{};
  glm::dvec3 passes{1}, emitted{0};
};
Exact quadrature(const CloudyWay& c) {
  Exact out;
  glm::dvec3 depth(0);
  constexpr int kSteps = 40000;
  const double step = static_cast<double>(kLength) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    const Coefficients at = coefficients_at(c, static_cast<float>(t));
    const glm::dvec3 sigma_t(at.sigma_t), here = glm::exp(-depth - 0.5 * step * sigma_t) * step;
    out.scattered[static_cast<std::size_t>(t / static_cast<double>(kLength) * kBins)] +=
        here * glm::dvec3(at.sigma_s);
    out.emitted += here * glm::dvec3(at.emission);
    depth += sigma_t * step;
  }
  out.passes = glm::exp(-depth);
  return out;
}

void expect_mean(const RunningStatistics& found, double exact, int tests, const std::string& what) {
  EXPECT_GT(z_test(found, exact, 2e-4 * exact + 1e-7), sidak_threshold(tests))
      << what << ": " << found.mean() << " +- " << std::sqrt(found.variance_of_mean()) << ", exact " << exact
      << "; " << seed_note();
}

constexpr TransmittanceEstimator kEstimators[] = {TransmittanceEstimator::residual,
                                                  TransmittanceEstimator::ratio};
const Spectrum kMixture(0.5f, 0.2f, 0.3f);

TrackingRandom random_of(std::mt19937_64& engine) {
  Sampler sampler(SamplerType::independent, static_cast<int>(engine() >> 40));
  return TrackingRandom(sampler, kOrigin, kDirection);
}

/// What collides where, what comes through and what is sent out, all of one tracking.
TEST(MediumTrackingStatistical, PathsAreWeightedAsTheIntegralsSay) {
  const CloudyWay c(TransmittanceEstimator::residual);
  const Exact exact = quadrature(c);
  std::mt19937_64 engine(fresh_seed());
  std::array<std::array<RunningStatistics, 3>, kBins> scattered;
  std::array<RunningStatistics, 3> passes, emitted;
  for (int i = 0; i < 400000; ++i) {
    TrackingRandom random = random_of(engine);
    const TrackedWay tracked = track(c.way, kMixture, true, random);
    const auto& collision = tracked.collision;
    const std::size_t bin =
        collision ? static_cast<std::size_t>(collision->distance / kLength * kBins) : std::size_t{kBins};
    for (int ch = 0; ch < 3; ++ch) {
      const auto k = static_cast<std::size_t>(ch);
      for (std::size_t b = 0; b < kBins; ++b)
        scattered[b][k].add(b == bin ? static_cast<double>(collision->weight[ch]) : 0);
      passes[k].add(collision ? 0 : static_cast<double>(tracked.weight[ch]));
      emitted[k].add(static_cast<double>(tracked.emitted[ch]));
    }
  }
  for (int ch = 0; ch < 3; ++ch) {
    const auto k = static_cast<std::size_t>(ch);
    for (std::size_t b = 0; b < kBins; ++b)
      expect_mean(scattered[b][k], exact.scattered[b][ch], 3 * (kBins + 2), "bin " + std::to_string(b));
    expect_mean(passes[k], exact.passes[ch], 3 * (kBins + 2), "passes");
    expect_mean(emitted[k], exact.emitted[ch], 3 * (kBins + 2), "emitted");
  }
}

/// Where no path may collide, by both estimators.
TEST(MediumTrackingStatistical, TransmittanceIsThatOfTheIntegral) {
  for (const TransmittanceEstimator estimator : kEstimators) {
    const CloudyWay c(estimator);
    const Exact exact = quadrature(c);
    std::mt19937_64 engine(fresh_seed());
    std::array<RunningStatistics, 3> passes, emitted, grids;
    for (int i = 0; i < 100000; ++i) {
      TrackingRandom random = random_of(engine);
      const TrackedWay tracked = track(c.way, kMixture, false, random);
      ASSERT_FALSE(tracked.collision);
      const Spectrum tracked_grids = track_transmittance(c.way, kLength, random);
      for (int ch = 0; ch < 3; ++ch) {
        const auto k = static_cast<std::size_t>(ch);
        passes[k].add(static_cast<double>(tracked.weight[ch]));
        emitted[k].add(static_cast<double>(tracked.emitted[ch]));
        grids[k].add(static_cast<double>(tracked_grids[ch] * c.way.transmittance()[ch]));
      }
    }
    for (int ch = 0; ch < 3; ++ch) {
      const auto k = static_cast<std::size_t>(ch);
      expect_mean(passes[k], exact.passes[ch], 18, "passes");
      expect_mean(grids[k], exact.passes[ch], 18, "of the way");
      expect_mean(emitted[k], exact.emitted[ch], 18, "emitted");
    }
  }
}

/// Little of it comes through: what is left out is made up for.
TEST(MediumTrackingStatistical, FaintLightIsNotLost) {
  for (const TransmittanceEstimator estimator : kEstimators) {
    const Medium medium =
        make_medium(grid_desc(wavy_grid({40, 40, 40}), vec3(9), vec3(1)), {Spectrum(0), estimator});
    const Sampler sampler(SamplerType::independent, 1);
    RunningStatistics found;
    double depth = 0;
    const auto& grid = std::get<GridMedium>(medium);
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i)
      depth += 9.0 *
               static_cast<double>(grid.bricks->density(
                   grid.to_cells(kOrigin + (static_cast<float>(i) + 0.5f) / kSteps * 4 * kDirection))) *
               4 / kSteps;
    ASSERT_GT(depth, 5);
    std::mt19937_64 engine(fresh_seed());
    for (int i = 0; i < 400000; ++i) {
      Sampler own(SamplerType::independent, static_cast<int>(engine() >> 40));
      const TransmittanceEstimate estimate =
          transmittance({kOrigin, 0, 2.0f * kDirection, kInfinity}, 4, medium, own);
      found.add(static_cast<double>(estimate.value.x));
      if (i == 0) { EXPECT_NEAR(std::log(estimate.expected.x), -depth, 0.3 * depth); }
    }
    expect_mean(found, std::exp(-depth), 2, "faint");
  }
}

/// So much matter that factors of the estimate alone are no floats any more.
TEST(MediumTracking, NothingOverflowsInDenseMatter) {
  MediumDesc desc = grid_desc(random_grid({20, 20, 20}, 9), {3e3f, 0, 5e3f}, vec3(0.3f));
  desc.emission = vec3(9);
  for (const TransmittanceEstimator estimator : kEstimators)
    for (const bool collides : {false, true}) {
      const Medium medium = make_medium(desc, {Spectrum(0), estimator});
      MediumWay way;
      way.start(kDirection);
      way.add(kOrigin, 9, {}, &medium);
      std::mt19937_64 engine(4);
      for (int i = 0; i < 200; ++i) {
        TrackingRandom random = random_of(engine);
        const TrackedWay tracked = track(way, kMixture, collides, random);
        const Spectrum sum = tracked.weight + tracked.emitted + track_transmittance(way, 9, random);
        EXPECT_TRUE(std::isfinite(sum.x + sum.y + sum.z)) << sum.x << " " << sum.y << " " << sum.z;
      }
    }
}

/// A grid that is the same everywhere is known as if it were no grid.
TEST(MediumTracking, AUniformGridHasNoVariance) {
  VolumeGrid grid = random_grid({20, 20, 20}, 1);
  std::ranges::fill(grid.density, 0.5f);
  const Medium medium = make_medium(grid_desc(std::move(grid), {1, 2, 3}, vec3(0.5f)));
  MediumWay way(true);
  way.start({1, 0, 0});
  way.add({-4, 0, 0}, 10, {}, &medium);
  for (int seed = 0; seed < 20; ++seed) {
    TrackingRandom random(Sampler(SamplerType::independent, seed), {}, {});
    const TrackedWay tracked = track(way, kMixture, false, random);
    const Spectrum of_way = track_transmittance(way, 10, random);
    for (int c = 0; c < 3; ++c) {
      const float exact = std::exp(-1.5f * static_cast<float>(c + 1));
      EXPECT_NEAR(tracked.weight[c], exact, 2e-6f);
      EXPECT_NEAR(of_way[c], exact, 2e-6f);
      EXPECT_NEAR(tracked.unscattered[c], exact, 2e-6f);
      EXPECT_NEAR(way.unscattered()[c], exact, 2e-6f);
    }
  }
}

/// Of the way as of the ray: the weights of strategies agree on what is expected.
TEST(MediumTracking, WhatIsExpectedIsTheSameForAll) {
  const CloudyWay c(TransmittanceEstimator::residual);
  std::mt19937_64 engine(1);
  for (int i = 0; i < 30; ++i) {
    TrackingRandom random = random_of(engine);
    const TrackedWay tracked = track(c.way, kMixture, true, random);
    if (tracked.collision) continue;
    for (int ch = 0; ch < 3; ++ch) EXPECT_NEAR(tracked.unscattered[ch], c.way.unscattered()[ch], 1e-4f);
  }
}

/// Before much of a dense grid, the rest is not looked at.
TEST(MediumWay, IsThickWhereHardlyAnythingPasses) {
  const Medium cloud = make_medium(grid_desc(wavy_grid({40, 40, 40}), vec3(9), vec3(1)));
  for (const bool whole : {false, true}) {
    MediumWay way(whole);
    way.start(kDirection);
    way.add(kOrigin, 4, {}, &cloud);
    EXPECT_EQ(way.is_thick(), !whole);
    EXPECT_TRUE(way.has_grids());
    EXPECT_TRUE(way.scatters());
  }
}

TEST(GridMedium, GlowsAsBlackBodiesDo) {
  const GlowTable glow(3000);
  EXPECT_NEAR(luminance(glow[1]), 1, 1e-4f);
  EXPECT_EQ(luminance(glow[0]), 0);
  // Planck's law at the middle of the visible range, for the ratio of luminances of 2000 and 3000 K.
  const double ratio = planck_radiance(575, 2000) / planck_radiance(575, 3000);
  EXPECT_NEAR(static_cast<double>(luminance(glow[2.0f / 3])) / ratio, 1, 0.15);
  EXPECT_GT(glow[0.5f].x / glow[0.5f].z, glow[1].x / glow[1].z) << "cooler is redder";
}

} // namespace
} // namespace candela::test
