// Every way to sample light in media has the same expectation.

#include "render/media_testing.h"

namespace candela::test {
namespace {

void expect_strategies_agree(int spp, double tolerance, bool cloudy) {
  struct Variation {
    const char* name;
    std::function<void(PathSettings&)> apply;
  };
  const Variation variations[] = {
      {"mis", [](PathSettings&) {}},
      {"nee", [](PathSettings& p) { p.light_sampling = LightSampling::nee; }},
      {"bsdf", [](PathSettings& p) { p.light_sampling = LightSampling::bsdf; }},
      {"distance", [](PathSettings& p) { p.medium_sampling = MediumSampling::distance; }},
      {"equiangular", [](PathSettings& p) { p.medium_sampling = MediumSampling::equiangular; }},
      {"distance, nee",
       [](PathSettings& p) {
         p.medium_sampling = MediumSampling::distance, p.light_sampling = LightSampling::nee;
       }},
      {"balance, four shadow rays",
       [](PathSettings& p) { p.mis_heuristic = MisHeuristic::balance, p.light_samples = 4; }},
      {"one path", [](PathSettings& p) { p.split = 1; }},
      {"four paths", [](PathSettings& p) { p.split = 4; }},
      {"lights by power", [](PathSettings& p) { p.light_choice = LightChoiceBy::power; }},
      {"fixed roulette", [](PathSettings& p) { p.rr = RussianRoulette::fixed, p.rr_probability = 0.8f; }},
      {"ratio tracking", [](PathSettings& p) { p.transmittance = TransmittanceEstimator::ratio; }},
      {"uniform directions", [](PathSettings& p) { p.direction_sampling = DirectionSampling::uniform; }},
  };
  SceneMaker s = foggy_room(12, spp, cloudy);
  s.document.settings.path.max_depth = 12;
  std::vector<RenderedSum> sums;
  for (const Variation& v : variations) {
    Document document = s.document;
    v.apply(document.settings.path);
    document.settings.sampler.seed = sampler_seed(sums.size() + (cloudy ? 20 : 0));
    sums.push_back(sum_of(document));
    const RenderedSum &own = sums.back(), &first = sums.front();
    for (int c = 0; c < 3; ++c) {
      const double deviation = std::sqrt(own.variance[c] + first.variance[c]);
      EXPECT_GT(normal_p_value((own.value[c] - first.value[c]) / deviation),
                sidak_threshold(static_cast<int>(3 * std::size(variations))))
          << v.name << ", channel " << c << ": " << own.value[c] << " against " << first.value[c] << ", "
          << deviation << "; " << seed_note();
      EXPECT_LT(deviation, tolerance * own.value[c]) << v.name << ": too few samples to tell";
    }
  }
}

TEST(MediaStatistical, StrategiesAgree) { expect_strategies_agree(384, 0.06, false); }
TEST(MediaHeavy, StrategiesAgree) { expect_strategies_agree(20000, 0.008, false); }
TEST(MediaStatistical, StrategiesAgreeAmongClouds) { expect_strategies_agree(256, 0.06, true); }
TEST(MediaHeavy, StrategiesAgreeAmongClouds) { expect_strategies_agree(10000, 0.01, true); }

/// Single lengths of paths, which a limit of depth must not touch.
TEST(MediaStatistical, TheLengthsOfPathsAddUp) {
  SceneMaker s = foggy_room(8, 512);
  s.document.settings.path.max_depth = 4;
  const RenderedSum all = [&] {
    s.document.settings.sampler.seed = sampler_seed(50);
    return sum_of(s.document);
  }();
  RenderedSum parts;
  for (int depth = 1; depth <= 4; ++depth) {
    s.document.settings.path.only_depth = depth;
    s.document.settings.sampler.seed = sampler_seed(50 + static_cast<std::uint64_t>(depth));
    const RenderedSum part = sum_of(s.document);
    parts.value += part.value, parts.variance += part.variance;
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_GT(
        normal_p_value((all.value[c] - parts.value[c]) / std::sqrt(all.variance[c] + parts.variance[c])),
        sidak_threshold(3))
        << all.value[c] << " against " << parts.value[c] << "; " << seed_note();
}

} // namespace
} // namespace candela::test
