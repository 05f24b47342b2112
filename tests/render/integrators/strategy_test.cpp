// All unbiased settings of the path tracer have the same expectation.

#include "render/quadrants.h"
#include "render/strategy_scenes.h"

namespace {

using namespace candela;
using namespace candela::test;

std::string describe(const RenderSettings& s) {
  Document d;
  d.settings = s;
  std::string text;
  for (const char* key :
       {"path.light_sampling", "path.mis_heuristic", "path.direction_sampling", "path.rr", "path.rr_depth",
        "path.light_samples", "path.split", "sampler.type", "sampler.seed"})
    text += std::string(key) + "=" + field_text(*find_setting(key), d) + " ";
  return text;
}

/// A cap that all share, for without Russian roulette nothing else ends a path in a closed scene.
constexpr int kDepth = 6;

Document with_cap(Document d) {
  d.settings.path.max_depth = kDepth;
  return d;
}

Estimate reference(const Document& document, int spp) {
  Document d = with_cap(document);
  d.settings.sampler.type = SamplerType::independent;
  d.settings.sampler.seed = sampler_seed(1000);
  d.settings.stop.spp = spp;
  return estimate(render(d));
}

struct LightStrategy {
  LightSampling light;
  MisHeuristic heuristic;
};
constexpr LightStrategy kLightStrategies[] = {{LightSampling::bsdf, MisHeuristic::power},
                                              {LightSampling::nee, MisHeuristic::power},
                                              {LightSampling::mis, MisHeuristic::balance},
                                              {LightSampling::mis, MisHeuristic::power}};
constexpr DirectionSampling kDirections[] = {DirectionSampling::uniform, DirectionSampling::cosine,
                                             DirectionSampling::bsdf};
struct Roulette {
  RussianRoulette how;
  int depth;
};
constexpr Roulette kRoulettes[] = {{RussianRoulette::off, 0},        {RussianRoulette::throughput, 0},
                                   {RussianRoulette::throughput, 1}, {RussianRoulette::throughput, 5},
                                   {RussianRoulette::fixed, 0},      {RussianRoulette::fixed, 1},
                                   {RussianRoulette::fixed, 5}};

Document with_strategy(Document d, const LightStrategy& light, DirectionSampling direction,
                       const Roulette& rr, int light_samples, int split, SamplerType sampler, int seed) {
  PathSettings& path = d.settings.path;
  path.light_sampling = light.light;
  path.mis_heuristic = light.heuristic;
  path.direction_sampling = direction;
  path.rr = rr.how;
  path.rr_depth = rr.depth;
  path.rr_probability = 0.7f;
  path.light_samples = light_samples;
  path.split = split;
  d.settings.sampler.type = sampler;
  d.settings.sampler.seed = seed;
  return with_cap(d);
}

/// Every way to find light with every density of directions; what else there is to choose is drawn anew in
/// each run.
void expect_one_expectation(const NamedScene& scene, int spp) {
  SCOPED_TRACE(scene.name);
  Estimate expected = reference(scene.document, 4 * spp);
  std::uint64_t draw = 0;
  auto pick = [&](std::uint64_t n) { return hash_combine(fresh_seed(), ++draw) % n; };
  for (const LightStrategy& light : kLightStrategies)
    for (DirectionSampling direction : kDirections) {
      Document d = with_strategy(scene.document, light, direction, kRoulettes[pick(7)],
                                 1 + 2 * static_cast<int>(pick(2)), 1 + 2 * static_cast<int>(pick(2)),
                                 static_cast<SamplerType>(pick(7)), sampler_seed(++draw));
      d.settings.stop.spp = spp;
      SCOPED_TRACE(describe(d.settings));
      expect_same(estimate(render(d)), expected, 72);
    }
}

TEST(StrategyStatistical, CornellBox) { expect_one_expectation(strategy_scenes()[0], 1024); }
TEST(StrategyStatistical, PhongPlates) { expect_one_expectation(strategy_scenes()[1], 512); }
TEST(StrategyStatistical, GgxPlates) { expect_one_expectation(strategy_scenes()[2], 512); }
TEST(StrategyStatistical, MirrorAndGlass) { expect_one_expectation(strategy_scenes()[3], 512); }
TEST(StrategyStatistical, InstancesTextureAndScreen) { expect_one_expectation(strategy_scenes()[4], 512); }
TEST(StrategyStatistical, SkySunAndLamp) { expect_one_expectation(strategy_scenes()[5], 512); }
TEST(StrategyStatistical, EnvironmentAndSpot) { expect_one_expectation(strategy_scenes()[6], 512); }
TEST(StrategyStatistical, CoarseSmoothGloss) { expect_one_expectation(strategy_scenes()[7], 1024); }
TEST(StrategyStatistical, TexturedLamps) { expect_one_expectation(strategy_scenes()[8], 512); }
TEST(StrategyStatistical, FilteredTextures) { expect_one_expectation(strategy_scenes()[9], 512); }
TEST(StrategyStatistical, ShapedLights) { expect_one_expectation(strategy_scenes()[10], 512); }
TEST(StrategyStatistical, CoarseSmoothBalls) { expect_one_expectation(strategy_scenes()[11], 512); }
TEST(StrategyStatistical, GlowingCurves) { expect_one_expectation(strategy_scenes()[12], 512); }

/// Everything with everything.
void expect_all_combinations_agree(const NamedScene& scene) {
  SCOPED_TRACE(scene.name);
  constexpr int kSettings = 4 * 3 * 7 * 2 * 3;
  std::uint64_t salt = 2000;
  Estimate expected = reference(scene.document, 4096);
  for (const LightStrategy& light : kLightStrategies)
    for (DirectionSampling direction : kDirections)
      for (const Roulette& rr : kRoulettes)
        for (int light_samples : {1, 3})
          for (SamplerType sampler :
               {SamplerType::independent, SamplerType::stratified, SamplerType::sobol}) {
            Document d = with_strategy(scene.document, light, direction, rr, light_samples, light_samples,
                                       sampler, sampler_seed(++salt));
            d.settings.stop.spp = 512;
            SCOPED_TRACE(describe(d.settings));
            expect_same(estimate(render(d)), expected, kSettings);
          }
}

TEST(StrategyHeavy, CornellBox) { expect_all_combinations_agree(strategy_scenes()[0]); }
TEST(StrategyHeavy, PhongPlates) { expect_all_combinations_agree(strategy_scenes()[1]); }
TEST(StrategyHeavy, GgxPlates) { expect_all_combinations_agree(strategy_scenes()[2]); }
TEST(StrategyHeavy, MirrorAndGlass) { expect_all_combinations_agree(strategy_scenes()[3]); }
TEST(StrategyHeavy, InstancesTextureAndScreen) { expect_all_combinations_agree(strategy_scenes()[4]); }
TEST(StrategyHeavy, SkySunAndLamp) { expect_all_combinations_agree(strategy_scenes()[5]); }
TEST(StrategyHeavy, EnvironmentAndSpot) { expect_all_combinations_agree(strategy_scenes()[6]); }
TEST(StrategyHeavy, CoarseSmoothGloss) { expect_all_combinations_agree(strategy_scenes()[7]); }
TEST(StrategyHeavy, TexturedLamps) { expect_all_combinations_agree(strategy_scenes()[8]); }
TEST(StrategyHeavy, FilteredTextures) { expect_all_combinations_agree(strategy_scenes()[9]); }
TEST(StrategyHeavy, ShapedLights) { expect_all_combinations_agree(strategy_scenes()[10]); }
TEST(StrategyHeavy, CoarseSmoothBalls) { expect_all_combinations_agree(strategy_scenes()[11]); }
TEST(StrategyHeavy, GlowingCurves) { expect_all_combinations_agree(strategy_scenes()[12]); }

TEST(StrategyStatistical, RouletteKeepsTheMeanOfUnlimitedPaths) {
  Document d = mirror_and_glass_scene();
  d.settings.sampler.type = SamplerType::independent;
  auto with = [&](RussianRoulette how, int depth, float probability, int spp, std::uint64_t salt) {
    Document r = d;
    r.settings.path.rr = how;
    r.settings.path.rr_depth = depth;
    r.settings.path.rr_probability = probability;
    r.settings.sampler.seed = sampler_seed(salt);
    r.settings.stop.spp = spp;
    return estimate(render(r));
  };
  Estimate off = with(RussianRoulette::off, 0, 1, 128, 1); // ends where the throughput is below the floats
  expect_same(with(RussianRoulette::throughput, 0, 1, 512, 2), off, 3);
  expect_same(with(RussianRoulette::throughput, 5, 1, 512, 3), off, 3);
  expect_same(with(RussianRoulette::fixed, 2, 0.8f, 512, 4), off, 3);
}

TEST(StrategyStatistical, ClampingIsTheOnlyThingThatLosesLight) {
  Document d = cornell_flush(8, 8, 256, true).document;
  d.settings.sampler.seed = sampler_seed(5);
  Film plain = render(d);
  d.settings.path.clamp = 0.5f;
  Film clamped = render(d);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(clamped.mean(x, y)[c], plain.mean(x, y)[c] * 1.00001f);
        EXPECT_LE(clamped.mean(x, y)[c], 0.5f);
      }
}

} // namespace
