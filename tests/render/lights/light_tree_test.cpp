// Light selection by estimated contribution.

#include "materials/bsdf.h"
#include "render/lights/light_selection.h"
#include "render/quadrants.h"

#include <random>

namespace {

using namespace candela;
using namespace candela::test;

class Random {
public:
  explicit Random(std::uint64_t salt) : engine_(hash_combine(fresh_seed(), salt)) {}
  float operator()() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
  float operator()(float lo, float hi) { return lo + (hi - lo) * (*this)(); }
  vec3 point(float half) {
    float x = (*this)(-half, half), y = (*this)(-half, half), z = (*this)(-half, half);
    return {x, y, z};
  }
  vec3 direction() {
    float x = (*this)(), y = (*this)();
    return sample_uniform_sphere({x, y});
  }
  bool coin() { return (engine_() & 1) != 0; }

private:
  std::mt19937_64 engine_;
};

/// Lights of every kind with bounds, some in heaps, and if `unbounded` some of those without.
std::vector<Light> random_lights(std::size_t count, bool unbounded, Random& random) {
  std::vector<Light> lights;
  vec3 heap = random.point(4);
  while (lights.size() < count) {
    if (random() < 0.1f) heap = random.point(4);
    vec3 at = heap + random.point(random.coin() ? 0.3f : 3.0f), color = vec3(random(0.01f, 5));
    vec3 x = random(0.02f, 0.8f) * random.direction(), y = random(0.02f, 0.8f) * random.direction();
    if (random() < 0.2f && !lights.empty()) x = {0.5f, 0, 0}, y = {0, 0, 0.5f}; // normals alike
    switch (static_cast<int>(random(0, 6))) {
    case 0: {
      vec3 c = glm::cross(x, y);
      float twice = glm::length(c);
      lights.emplace_back(TriangleLight{at, x, y, c / twice, 0.5f * twice, color, random.coin()});
      break;
    }
    case 1: {
      vec3 n = glm::normalize(x);
      y -= glm::dot(y, n) * n;
      lights.emplace_back(RectangleLight(at, x, y, color, random.coin()));
      break;
    }
    case 2: lights.emplace_back(SphereLight{at, random(0.01f, 0.5f), color, random.coin()}); break;
    case 3:
      lights.emplace_back(DiscLight{at, glm::normalize(x), random(0.01f, 0.5f), color, random.coin()});
      break;
    case 4: lights.emplace_back(PointLight{at, color}); break;
    default: {
      float cutoff = random(0.02f, kPi);
      lights.emplace_back(SpotLight{at, glm::normalize(x), cutoff * random(), cutoff, color});
    }
    }
  }
  if (unbounded) {
    lights.emplace_back(ConstantLight{vec3(0.3f)});
    lights.emplace_back(DirectionalLight{random.direction(), vec3(1)});
    lights.emplace_back(PointLight{random.point(3), vec3(2), {1, 0.5f, 0}});
  }
  return lights;
}

LightSelection select_all(const std::vector<Light>& lights, LightChoiceBy how = LightChoiceBy::contribution) {
  std::vector<std::uint32_t> all(lights.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return {lights, all, how, 5};
}

LightSamplingContext random_context(Random& random, const std::vector<Light>& lights) {
  LightSamplingContext ctx{random.point(6), random.direction()};
  ctx.mis_with_bsdf = random.coin();
  switch (static_cast<int>(random(0, 3))) {
  case 0: break;
  case 1: ctx.domain = ScatteringDomain::sphere; break;
  default: ctx = LightSamplingContext::in_volume(ctx.position);
  }
  if (random.coin()) {
    ctx.lobe = {random.coin() ? 0.0f : random(), random(0.1f, 1000), random(0, 1000)};
    ctx.lobe_axis = random.direction();
  }
  if (random.coin()) // right beside a light, within its bounds or heap
    if (auto bounds =
            light_bounds(lights[static_cast<std::size_t>(random() * static_cast<float>(lights.size()))]))
      ctx.position = bounds->center + (bounds->radius + 0.01f) * random(0, 2) * random.direction();
  return ctx;
}

/// What a sample contributes under an even BSDF or phase function, not weighted by any density.
float contribution(const Light& light, const LightSamplingContext& ctx, vec2 u) {
  auto s = sample_light(light, ctx, u);
  return s && ctx.accepts(s->direction) ? s->radiance.x * ctx.cosine_factor(s->direction) : 0;
}

TEST(LightTree, WhateverSendsLightIsChosen) {
  Random random(1);
  int lit = 0;
  for (int round = 0; round < 60; ++round) {
    auto lights = random_lights(static_cast<std::size_t>(random(1, 200)), random.coin(), random);
    LightSelection selection = select_all(lights);
    for (int k = 0; k < 40; ++k) {
      LightSamplingContext ctx = random_context(random, lights);
      for (std::uint32_t i = 0; i < lights.size(); ++i) {
        float u = random(), v = random();
        if (!(contribution(lights[i], ctx, {u, v}) > 0)) continue;
        ++lit;
        ASSERT_GT(selection.pmf(ctx, i), 0)
            << "light " << i << " of kind " << lights[i].index() << "; " << seed_note();
      }
    }
  }
  EXPECT_GT(lit, 10000);
}

TEST(LightTree, ProbabilitiesSumToOneButForDrawsThatFail) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    auto lights = random_lights(static_cast<std::size_t>(random(1, 300)), random.coin(), random);
    LightSelection selection = select_all(lights);
    LightSamplingContext ctx = random_context(random, lights);
    double sum = 0, drawn = 0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) sum += static_cast<double>(selection.pmf(ctx, i));
    constexpr int kDraws = 4000;
    float before = -1;
    std::uint32_t last = 0xffffffffu;
    for (int k = 0; k < kDraws; ++k) { // an even comb: the measure of what is drawn
      auto choice = selection.choose(ctx, (static_cast<float>(k) + 0.5f) / kDraws);
      if (!choice) continue;
      drawn += 1.0 / kDraws;
      ASSERT_NEAR(choice->pmf, selection.pmf(ctx, choice->light), 1e-5f * choice->pmf) << seed_note();
      ASSERT_TRUE(choice->u >= 0 && choice->u < 1);
      if (choice->light == last) { ASSERT_GT(choice->u, before) << "stretched, in order"; }
      last = choice->light, before = choice->u;
    }
    EXPECT_NEAR(sum, drawn, 0.02) << lights.size() << " lights; " << seed_note();
    EXPECT_LT(sum, 1.0001);
  }
}

TEST(LightTreeStatistical, IsChosenAsOftenAsItsProbabilitySays) {
  Random random(3);
  constexpr int kRounds = 12, kDraws = 40000;
  for (int round = 0; round < kRounds; ++round) {
    auto lights = random_lights(round < 4 ? 5 : 120, round % 2 == 0, random);
    LightSelection selection = select_all(lights);
    LightSamplingContext ctx = random_context(random, lights);
    std::vector<double> observed(lights.size() + 1), expected(lights.size() + 1);
    double failing = 1;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      double pmf = static_cast<double>(selection.pmf(ctx, i));
      failing -= pmf;
      expected[i] = kDraws * pmf;
    }
    expected.back() = kDraws * std::max(failing, 0.0);
    for (int k = 0; k < kDraws; ++k) {
      auto choice = selection.choose(ctx, random());
      observed[choice ? choice->light : lights.size()] += 1;
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(kRounds)) << seed_note();
  }
}

TEST(LightTree, FewLightsThatAreSmallAreChosenByWhatTheySend) {
  // Far points and spheres, a facing disc, and the sun: the estimates are the irradiances themselves.
  const LightSamplingContext ctx{{0, 0, 0}, {0, 1, 0}};
  std::vector<Light> lights{PointLight{{3, 4, 0}, vec3(5)},
                            SphereLight{{0, 20, 0}, 0.1f, vec3(300), false},
                            DiscLight{{-6, 8, 0}, glm::normalize(vec3(6, -8, 0)), 0.05f, vec3(900), false},
                            DirectionalLight{glm::normalize(vec3(0, -1, 1)), vec3(0.1f)},
                            PointLight{{3, -4, 0}, vec3(50)},                         // below the horizon
                            DiscLight{{0, 5, 0}, {0, 1, 0}, 0.1f, vec3(900), false}}; // looks away
  LightSelection selection = select_all(lights);
  const double sent[] = {5 * 0.8 / 25,
                         300 * std::numbers::pi * 0.01 / 400,
                         900 * std::numbers::pi * 0.0025 * 0.8 / 100,
                         0.1 / std::sqrt(2.0),
                         0,
                         0};
  double sum = 0;
  for (double e : sent) sum += e;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    EXPECT_NEAR(static_cast<double>(selection.pmf(ctx, i)), sent[i] / sum, 0.01) << i;
}

TEST(LightTree, APointInAMediumChoosesByWhatArrivesFromAllAround) {
  const auto ctx = LightSamplingContext::in_volume({0, 0, 0});
  std::vector<Light> lights{PointLight{{0, -5, 0}, vec3(5)},
                            DiscLight{{-6, 8, 0}, glm::normalize(vec3(6, -8, 0)), 0.05f, vec3(900), false},
                            DirectionalLight{glm::normalize(vec3(0, 1, 1)), vec3(0.1f)},
                            ConstantLight{vec3(0.02f)}};
  LightSelection selection = select_all(lights);
  const double sent[] = {5.0 / 25, 900 * std::numbers::pi * 0.0025 / 100, 0.1, 4 * std::numbers::pi * 0.02};
  double sum = 0;
  for (double e : sent) sum += e;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    EXPECT_NEAR(static_cast<double>(selection.pmf(ctx, i)), sent[i] / sum, 0.01) << i;
}

TEST(LightTree, AGlossyPointChoosesTheLightThatItMirrors) {
  LightSamplingContext ctx{{0, 0, 0}, {0, 1, 0}};
  const vec3 wo = glm::normalize(vec3(-1, 1, 0)); // of the world; locally x, z, y
  const Bsdf bsdf = Ggx{vec3(0.9f), 0.4f};
  std::vector<Light> lights;
  std::vector<double> sent;
  for (float angle : {20.0f, 30.0f, 40.0f, 45.0f, 55.0f, 70.0f}) {
    vec3 towards(std::sin(radians(angle)), std::cos(radians(angle)), 0);
    lights.emplace_back(PointLight{9.0f * towards, vec3(1)});
    sent.push_back(static_cast<double>(
        luminance(bsdf_eval(bsdf, {wo.x, wo.z, wo.y}, {towards.x, towards.z, towards.y}))));
  }
  ctx.lobe = bsdf_lobe_proxy(bsdf, {wo.x, wo.z, wo.y});
  ctx.lobe_axis = {-wo.x, wo.y, wo.z};
  LightSelection selection = select_all(lights);
  double sum = 0;
  for (double e : sent) sum += e;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    EXPECT_NEAR(static_cast<double>(selection.pmf(ctx, i)), sent[i] / sum, 0.06) << i;
}

TEST(LightTree, OneLightIsCertain) {
  LightSelection selection = select_all({PointLight{{0, 1, 0}, vec3(1)}});
  auto choice = selection.choose({{0, 0, 0}, {0, -1, 0}}, 0.25f);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->pmf, 1);
  EXPECT_EQ(choice->u, 0.25f);
  EXPECT_TRUE(select_all({}).empty());
  EXPECT_TRUE(select_all({PointLight{{0, 1, 0}, vec3(0)}}).empty());
}

TEST(LightTree, TooManyUnboundedLightsAreChosenByPower) {
  std::vector<Light> lights(LightTree::kMaxUnboundedLights + 1, PointLight{{0, 1, 0}, vec3(1), {1, 0, 0}});
  LightSelection selection = select_all(lights);
  EXPECT_NEAR(selection.pmf({{0, 0, 0}, {0, 1, 0}}, 3), 1.0f / static_cast<float>(lights.size()), 1e-6f);
}

/// A hall with many lamps of every kind.
Document lamps() {
  Random random(4);
  SceneMaker s(8, 8, 1);
  int grey = s.diffuse(vec3(0.6f));
  s.closed_box({-3, 0, -3}, {3, 2.5f, 3}, grey);
  Material metal;
  metal.model = GgxMaterial();
  number(metal, "roughness") = 0.4f;
  s.sphere({0, 0.6f, 0}, 0.6f, s.material(metal));
  for (int i = 0; i < 40; ++i) {
    Material m;
    color(m, "diffuse") = vec3(0.2f);
    m.emission = vec3{random(1, 9), random(1, 9), random(1, 9)};
    m.two_sided_emission = random.coin();
    int lamp = s.material(m);
    vec3 at(random(-2.8f, 2.8f), random(0.3f, 2.3f), random(-2.8f, 2.8f));
    if (i % 2 == 0)
      s.sphere(at, random(0.03f, 0.1f), lamp);
    else
      s.disc(at, random(0.05f, 0.15f), random.direction(), random.direction(), lamp);
  }
  for (int i = 0; i < 6; ++i) {
    LightDesc l;
    const vec3 position{random(-2.5f, 2.5f), random(0.5f, 2), random(-2.5f, 2.5f)};
    const vec3 direction = random.direction();
    const float cutoff = random(0.5f, 2.5f);
    const vec3 attenuation = i % 3 == 0 ? vec3(0.5f, 0, 1) : vec3(0, 0, 1);
    if (i < 3)
      l.model = PointLightModel{position, attenuation};
    else
      l.model = SpotLightModel{position, direction, cutoff, 0.3f, attenuation};
    l.color = vec3(0.3f);
    s.document.scene.lights.push_back(l);
  }
  s.camera({0, 1.5f, 2.7f}, {0, 0.8f, 0}, 70);
  s.document.settings.path.max_depth = 3;
  s.document.settings.sampler.type = SamplerType::independent;
  return s.document;
}

TEST(LightTreeStatistical, ChangesNoPicture) {
  Document d = lamps();
  auto with = [&](LightChoiceBy how, LightSampling sampling, std::uint64_t salt) {
    d.settings.path.light_choice = how;
    d.settings.path.light_sampling = sampling;
    d.settings.sampler.seed = sampler_seed(salt);
    d.settings.stop.spp = 4096;
    return estimate(render(d));
  };
  Estimate power = with(LightChoiceBy::power, LightSampling::mis, 1);
  Estimate tree = with(LightChoiceBy::contribution, LightSampling::mis, 2);
  expect_same(tree, power, 2);
  expect_same(with(LightChoiceBy::contribution, LightSampling::nee, 3), power, 2);
}

TEST(LightTreeStatistical, MakesLessNoiseOfManyLights) {
  Document d = lamps();
  d.settings.path.component = PathComponent::direct;
  d.settings.stop.spp = 1024;
  auto variance = [&](LightChoiceBy how) {
    d.settings.path.light_choice = how;
    d.settings.sampler.seed = sampler_seed(4);
    return estimate(render(d)).variance;
  };
  const auto by_contribution = variance(LightChoiceBy::contribution),
             by_power = variance(LightChoiceBy::power);
  // The median, for the sum may be that of one sample where a lamp happens to touch a surface.
  std::vector<double> ratios;
  for (std::size_t i = 0; i < by_power.size(); ++i)
    if (by_power[i] > 0) ratios.push_back(by_contribution[i] / by_power[i]);
  ASSERT_GT(ratios.size(), by_power.size() / 2);
  std::ranges::nth_element(ratios, ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2));
  EXPECT_LT(ratios[ratios.size() / 2], 0.5) << seed_note();
}

} // namespace
