// Every path ends, whatever the scene: where no surface loses light the throughput stays what it is, and only
// the bound on survival is left. And every pass ends when it is asked to. Tests that hang have failed.

#include "core/stop_condition.h"
#include "render/integrators/path_integrator.h"
#include "render/integrators/russian_roulette.h"
#include "render/render_testing.h"

#include <random>
#include <thread>

namespace candela::test {
namespace {

/// A camera at the origin among bodies that lose no light: in most scenes it is inside of some.
Document random_lossless_scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  auto number = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
  auto point = [&](float extent) {
    return vec3(number(-extent, extent), number(-extent, extent), number(-extent, extent));
  };
  auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  SceneMaker s(4, 4, 1);
  const std::string_view types[] = {"diffuse", "phong", "ggx", "mirror", "dielectric"};
  // Far from the origin, too, where rays round.
  const vec3 offset = pick(4) == 0 ? point(1e6f) : vec3(0);
  const int bodies = 1 + pick(6);
  for (int i = 0; i < bodies; ++i) {
    Material m = lossless(types[pick(3) == 0 ? pick(5) : 4], number(1.05f, 2.5f));
    test::set_if_there(m, "roughness", number(0, 1));
    if (pick(8) == 0) m.opacity = number(0, 1);
    const int material = s.material(m);
    const vec3 center = offset + point(0.6f);
    switch (pick(4)) {
    case 0: s.sphere(center, number(0.2f, 3), material); break;
    case 1: s.closed_box(center - number(0.2f, 3), center + number(0.2f, 3), material); break;
    case 2: s.mesh(sphere_mesh(6, 10, pick(2) == 0), material, glm::translate(mat4(1), center)); break;
    default: {
      const mat4 turned =
          glm::rotate(glm::translate(mat4(1), center), number(0, 6), glm::normalize(point(1) + 1e-3f));
      s.document.scene.instances.push_back(
          {"", CubeShape{}, glm::scale(turned, vec3(number(0.3f, 3))), {material}});
    }
    }
  }
  if (pick(2) == 0) s.constant_light(vec3(1));
  s.camera(offset, offset + point(1) + vec3(0, 0, 1.5f), number(20, 100));
  PathSettings& path = s.document.settings.path;
  path.rr = static_cast<RussianRoulette>(pick(3));
  path.rr_depth = pick(2) == 0 ? 1 : 1000000;
  path.rr_probability = pick(2) == 0 ? 1.0f : 0.9f;
  path.light_sampling = static_cast<LightSampling>(pick(3));
  s.document.settings.integrator = pick(4) == 0 ? Integrator::whitted : Integrator::path;
  s.document.settings.sampler.seed = static_cast<int>(seed & 0x7fffffff);
  return s.document;
}

TEST(Termination, OfPathsInAThousandLosslessScenes) {
  std::uint64_t most = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Document d = random_lossless_scene(hash_combine(fresh_seed(), i));
    Film film(4, 4);
    const PassResult pass = render_pass(*RenderScene::build(d), d, {0, 1}, film, {});
    ASSERT_TRUE(pass.completed);
    most = std::max(most, pass.rays.closest);
    // Without roulette a path has at most 1024 segments; with it, more than 64 + 4000 have a chance of
    // 0.99^4000. Whitted's follows 2^5 branches, each of which may be as long; and transparent surfaces add
    // crossings.
    ASSERT_LT(pass.rays.closest, 16u * 32u * 4064u) << "scene " << i << "; " << seed_note();
  }
  EXPECT_GT(most, 16u * 64u) << "no scene has long paths: this test shows nothing";
}

/// Inside of a sphere that reflects `albedo` and shines by itself: L = E / (1 - albedo) everywhere, of which
/// paths of more than n segments bring albedo^n.
SceneMaker cavity(std::string_view type, float albedo) {
  SceneMaker s(24, 24, 100);
  Material m = lossless(type);
  for (std::string_view key : {"diffuse", "specular"})
    if (has(m, key)) color(m, key) *= albedo;
  m.emission = vec3(1);
  m.two_sided_emission = true;
  s.sphere({0, 0, 0}, 1, s.material(m));
  s.camera({0.2f, 0.1f, 0}, {0, 0.3f, 1}, 60);
  s.document.settings.path.light_sampling = LightSampling::bsdf;
  s.document.settings.sampler.type = SamplerType::independent;
  return s;
}

TEST(TerminationStatistical, BoundedSurvivalKeepsTheMean) {
  const float albedo = 0.97f;
  const double exact = 1 / (1 - static_cast<double>(albedo));
  ASSERT_GT(std::pow(static_cast<double>(albedo), 64), 0.14); // the share that the bound is asked for
  std::uint64_t salt = 0;
  for (Integrator integrator : {Integrator::path, Integrator::whitted})
    for (std::string_view type : {"diffuse", "mirror"}) {
      if (integrator == Integrator::whitted && type == "diffuse") continue; // it sees one reflection
      SceneMaker s = cavity(type, albedo);
      s.document.settings.integrator = integrator;
      s.document.settings.path.rr = RussianRoulette::throughput;
      s.document.settings.path.rr_threshold = 0.001f; // no other roulette before 340 segments
      s.document.settings.sampler.seed = sampler_seed(++salt);
      expect_radiance(over_pixels(render(s.document), 1), exact, 3e-2, 3);
    }
}

TEST(Termination, BoundsSurvivalWhateverTheSettingsSay) {
  PathSettings path;
  for (RussianRoulette rr : {RussianRoulette::throughput, RussianRoulette::fixed})
    for (int rr_depth : {0, 1, 1000000}) {
      path.rr = rr;
      path.rr_depth = rr_depth;
      path.rr_probability = 1;
      for (int depth : {64, 100, 100000}) EXPECT_LT(Roulette::at(path, depth).max_survival, 1);
      EXPECT_EQ(Roulette::at(path, 63).max_survival, 1);
    }
}

TEST(Termination, WithoutRouletteThereIsALimitUnlessOneIsSet) {
  SceneMaker s = cavity("mirror", 1);
  s.document.settings.film = {};
  s.document.settings.film.width = s.document.settings.film.height = 2;
  s.document.settings.stop.spp = 1;
  s.document.settings.path.rr = RussianRoulette::off;
  EXPECT_EQ(render(s.document).mean(1, 1), vec3(kMostSegmentsWithoutRoulette));
  s.document.settings.path.max_depth = 3000; // asked for
  EXPECT_EQ(render(s.document).mean(1, 1), vec3(3000));
  s.document.settings.path.max_depth = 7;
  EXPECT_EQ(render(s.document).mean(1, 1), vec3(7));
}

// --- Passes that are asked to stop ---

/// More work for one pixel than anyone waits for.
Document endless_pixel(Integrator integrator) {
  SceneMaker s = cornell_flush(1, 1, 1, true);
  s.document.settings.integrator = integrator;
  return s.document;
}

TEST(Termination, OfAPassThatIsAskedToStopInTheMiddleOfATile) {
  for (Integrator integrator : {Integrator::path, Integrator::whitted, Integrator::ao}) {
    const Document d = endless_pixel(integrator);
    const auto scene = RenderScene::build(d);
    Film film(1, 1);
    std::atomic<bool> stop{false};
    std::jthread other([&] { stop = true; });
    const PassResult pass = render_pass(*scene, d, {0, 0xfffffff0u}, film, stop);
    EXPECT_FALSE(pass.completed);
    EXPECT_EQ(pass.rays.samples, film.tried(0, 0)); // whole samples alone
  }
}

TEST(Termination, OfAPassAtItsDeadline) {
  const Document d = endless_pixel(Integrator::path);
  const auto scene = RenderScene::build(d);
  Film film(1, 1);
  const PassResult pass =
      render_pass(*scene, d, {0, 0xfffffff0u}, film,
                  StopCondition().at(StopCondition::Clock::now() + std::chrono::milliseconds(5)));
  EXPECT_FALSE(pass.completed);
}

TEST(Termination, OfASinglePathThatIsLongerThanAnyoneWaits) {
  SceneMaker s = cavity("mirror", 1);
  s.document.settings.path.rr = RussianRoulette::off;
  s.document.settings.path.max_depth = 1000000; // 1.6e8 segments in a batch
  s.document.settings.path.light_samples = 64;
  const auto scene = RenderScene::build(s.document);
  for (Integrator integrator : {Integrator::path, Integrator::whitted}) {
    s.document.settings.integrator = integrator;
    Film film(24, 24);
    std::atomic<bool> stop{false};
    std::jthread other([&] { stop = true; });
    EXPECT_FALSE(render_pass(*scene, s.document, {0, 1000}, film, stop).completed);
  }
}

TEST(StopConditions, AFlagMayHaveToWait) {
  std::atomic<bool> flag{false}, patient{false};
  StopCondition now(flag), later;
  later.when(patient, StopCondition::Clock::now() + std::chrono::hours(1));
  StopPoll poll(now);
  EXPECT_FALSE(now.asked() || later.asked() || poll.asked());
  flag = patient = true;
  EXPECT_TRUE(now.asked() && poll.asked());
  EXPECT_FALSE(later.asked());
  flag = false;
  EXPECT_FALSE(now.asked());
  EXPECT_TRUE(poll.asked()) << "what was given up stays so";
  StopCondition past;
  past.when(patient, StopCondition::Clock::now());
  EXPECT_TRUE(past.asked());
}

/// A pass that is interrupted again and again brings the same in the end, adaptive sampling's decisions
/// included.
TEST(TerminationRender, InterruptedPassesGoOnWhereTheyWereLeft) {
  for (float adaptive : {0.0f, 0.2f}) {
    SceneMaker s = cornell_flush(61, 43, 1, true);
    s.document.settings.adaptive.error = adaptive;
    const auto scene = RenderScene::build(s.document);
    Film whole(61, 43), parts(61, 43);
    ASSERT_TRUE(render_pass(*scene, s.document, {0, 64}, whole, {}).completed);
    int interruptions = 0;
    while (true) {
      const auto soon = StopCondition::Clock::now() + std::chrono::microseconds(3000 + 500 * interruptions);
      if (render_pass(*scene, s.document, {0, 64}, parts, StopCondition().at(soon)).completed) break;
      ++interruptions;
    }
    EXPECT_GT(interruptions, 1);
    for (int y = 0; y < 43; ++y)
      for (int x = 0; x < 61; ++x) {
        ASSERT_EQ(parts.count(x, y), whole.count(x, y));
        ASSERT_EQ(parts.mean(x, y), whole.mean(x, y));
      }
  }
}

} // namespace
} // namespace candela::test
