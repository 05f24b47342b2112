// The other integrators, path splitting, and components by path length.

#include "render/closed_forms.h"
#include "render/film/film_view.h"
#include "render/quadrants.h"
#include "render/strategy_scenes.h"

namespace {

using namespace candela;
using namespace candela::test;

Estimate estimate_with(Document d, int spp, std::uint64_t salt) {
  d.settings.film.filter_radius = 0.01f; // what differs over a pixel is not what is measured here
  d.settings.sampler.seed = sampler_seed(salt);
  d.settings.stop.spp = spp;
  return estimate(render(d));
}

// --- Splitting ---

TEST(SplittingStatistical, KeepsTheMeanAndLowersTheVarianceOfASample) {
  Document d = cornell_flush(8, 8, 1, true).document;
  d.settings.sampler.type = SamplerType::independent;
  Estimate one = estimate_with(d, 1024, 1);
  d.settings.path.split = 8;
  d.settings.path.light_samples = 8;
  Estimate eight = estimate_with(d, 1024, 2);
  expect_same(one, eight, 1);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < kValues; ++i) before += one.variance[i], after += eight.variance[i];
  EXPECT_LT(after, 0.5 * before);
}

TEST(SplittingRender, BranchesHaveNumbersOfTheirOwn) {
  // Under a sky that only bounced light brings to the camera's floor, equal branches would leave the
  // variance of one.
  SceneMaker s(8, 8, 256);
  s.rectangle({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, s.diffuse(vec3(0.5f)));
  s.rectangle({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, s.diffuse(vec3(0), vec3(1)));
  s.camera({0, 0.9f, 2.5f}, {0, 0, 0}, 20);
  s.document.settings.path.light_sampling = LightSampling::bsdf;
  s.document.settings.sampler.type = SamplerType::independent;
  auto variance = [&](int split) {
    s.document.settings.path.split = split;
    Film film = render(s.document);
    double sum = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) sum += static_cast<double>(film.variance_of_mean(x, y).g);
    return sum;
  };
  // The direction's variance falls to a quarter; the film position's, which is small here, stays.
  EXPECT_NEAR(variance(4) / variance(1), 0.25, 0.06);
}

TEST(SplittingRender, SpecularSurfacesHandTheSplitOn) {
  Document d = mirror_and_glass_scene();
  d.settings.stop.spp = 1;
  d.settings.path.max_depth = 2;
  d.settings.path.component = PathComponent::emitted;
  auto scene = RenderScene::build(d);
  std::atomic<bool> stop{false};
  auto closest = [&](int split, int depth) {
    d.settings.path.split = split;
    d.settings.path.max_depth = depth;
    d.settings.path.component = PathComponent::all;
    d.settings.path.rr = RussianRoulette::off;
    Film film(8, 8);
    return render_pass(*scene, d, {1, 2}, film, stop).rays.closest; // the first sample is never split
  };
  std::uint64_t first = closest(1, 1), plain = closest(1, 2) - first, split = closest(5, 2) - first;
  EXPECT_GT(split, 2 * plain);
  EXPECT_LE(split, 5 * plain);
}

// --- Depths and components ---

TEST(DepthRender, PathLengthsAddUpToTheWholeSampleBySample) {
  for (const NamedScene& scene : strategy_scenes()) {
    SCOPED_TRACE(scene.name);
    Document d = scene.document;
    d.settings.sampler.seed = sampler_seed(3);
    d.settings.path.max_depth = 6;
    d.settings.path.split = 2;
    auto built = RenderScene::build(d);
    for (std::uint32_t i = 0; i < 64; ++i) {
      uvec2 pixel(i % 8, i / 8);
      d.settings.path.only_depth = 0;
      vec3 whole = replay_sample(*built, d, pixel, i), sum(0);
      for (int depth = 1; depth <= 6; ++depth) {
        d.settings.path.only_depth = depth;
        sum += replay_sample(*built, d, pixel, i);
      }
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole[c], 2e-5f * std::max(whole[c], 1e-3f));
    }
  }
}

TEST(DepthRender, ComponentFilmsAddUpAndEqualTheComponentAlone) {
  Document d = cornell_flush(8, 8, 16, true).document;
  std::array<Film, 3> parts{Film(8, 8), Film(8, 8), Film(8, 8)};
  PassOptions options;
  for (std::size_t i = 0; i < 3; ++i) options.components[i] = &parts[i];
  Film whole = render(d, options);
  const PathComponent components[] = {PathComponent::emitted, PathComponent::direct, PathComponent::indirect};
  for (std::size_t i = 0; i < 3; ++i) {
    d.settings.path.component = components[i];
    EXPECT_EQ(render(d).image().pixels, parts[i].image().pixels) << i;
  }
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      vec3 sum = parts[0].mean(x, y) + parts[1].mean(x, y) + parts[2].mean(x, y);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole.mean(x, y)[c], 1e-5f * (1 + sum[c]));
    }
}

TEST(DepthRender, TheDirectIntegratorIsThePathTracerOfTwoSegments) {
  Document d = cornell_flush(8, 8, 4, true).document;
  d.settings.integrator = Integrator::direct;
  Image direct = render(d).image();
  d.settings.integrator = Integrator::path;
  d.settings.path.max_depth = 2;
  EXPECT_EQ(render(d).image().pixels, direct.pixels);
}

// --- Whitted ---

/// Only specular things and lights: all light that there is comes by the paths that Whitted follows.
Document specular_world(int panes) {
  SceneMaker s(8, 8, 1);
  const vec3 colors[] = {{1, 2, 3}, {3, 1, 1}, {0.5f, 2, 1}, {2, 2, 0.5f}, {1, 0.2f, 2}, {0.3f, 1, 1}};
  s.closed_box({-2, -2, -2}, {2, 2, 3}, s.diffuse(vec3(0)));
  for (std::size_t i = 0; i < 6; ++i)
    s.document.scene.instances[i].materials = {s.diffuse(vec3(0), colors[i])};
  Material glass;
  glass.model = DielectricMaterial();
  color(glass, "absorption") = {0.2f, 0.1f, 0.4f};
  color(glass, "transmittance") = {0.9f, 0.8f, 0.9f};
  int pane = s.material(glass);
  s.sphere({0.7f, 0, 0.5f}, 0.8f, pane);
  // Panes before the camera: more surfaces in a row than both branches are followed of.
  for (int i = 0; i < panes; ++i) {
    vec3 x(i % 2 == 0 ? 1.9f : -1.9f, 0, 0);
    s.rectangle({0, 0, 2.6f - 0.12f * static_cast<float>(i)}, x, {0, 1.9f, 0}, pane);
  }
  s.sphere({-0.9f, 0, 0}, 0.7f, s.material(strategy_material("mirror", vec3(0), {0.9f, 0.8f, 0.7f})));
  s.camera({0, 0.2f, 2.9f}, {0, 0, 0}, 70);
  return s.document;
}

TEST(WhittedStatistical, EqualsThePathTracerWhereAllSurfacesAreSpecular) {
  Document d = specular_world(6);
  d.settings.sampler.type = SamplerType::independent;
  Estimate paths = estimate_with(d, 4096, 10);
  d.settings.integrator = Integrator::whitted;
  expect_same(paths, estimate_with(d, 1024, 11), 1);
}

TEST(WhittedStatistical, FollowsBothBranchesOfGlass) {
  Document d = specular_world(0);
  d.settings.sampler.type = SamplerType::independent;
  Estimate paths = estimate_with(d, 4096, 10);
  d.settings.integrator = Integrator::whitted;
  Estimate whitted = estimate_with(d, 1024, 11);
  expect_same(paths, whitted, 1);
  double of_paths = 0, of_whitted = 0;
  for (std::size_t i = 0; i < kValues; ++i)
    of_paths += 4 * paths.variance[i], of_whitted += whitted.variance[i];
  EXPECT_LT(of_whitted, 0.5 * of_paths);
}

TEST(WhittedStatistical, EqualsDirectLightOnDiffuseAndGlossySurfaces) {
  for (const NamedScene& scene : {strategy_scenes()[0], strategy_scenes()[1], strategy_scenes()[5]}) {
    SCOPED_TRACE(scene.name);
    Document d = scene.document;
    d.settings.sampler.type = SamplerType::independent;
    d.settings.integrator = Integrator::direct;
    Estimate direct = estimate_with(d, 2048, 12);
    d.settings.integrator = Integrator::whitted;
    expect_same(direct, estimate_with(d, 1024, 13), 3);
  }
}

// --- Ambient occlusion ---

/// Mean over the pixels of a camera so narrow that all see the origin.
RunningStatistics occlusion_at_origin(SceneMaker& s, float distance) {
  s.document.settings.integrator = Integrator::ao;
  s.document.settings.ao.distance = distance;
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.sampler.seed = sampler_seed(20);
  return over_pixels(render(s.document), 1);
}

SceneMaker floor_seen_from(vec3 eye) {
  SceneMaker s(16, 16, 4096);
  s.rectangle({0, 0, 0}, {0, 0, 100}, {100, 0, 0}, s.diffuse(vec3(0.2f)));
  s.camera(eye, {0, 0, 0}, 0.01f, {0, 0, -1});
  return s;
}

TEST(AmbientOcclusionStatistical, UnderADiscAndItsDistance) {
  const float radius = 1.5f, height = 2;
  SceneMaker s = floor_seen_from({0, 1, 0});
  s.disc({0, height, 0}, radius, {1, 0, 0}, {0, 0, 1}, 0);
  double open = 1 - disc_irradiance(static_cast<double>(radius), static_cast<double>(height)) / kPiD;
  expect_radiance(occlusion_at_origin(s, 0), open, 2e-2, 3);
  // Within the distance d lies what is seen at cosines above height / d: a share of 1 - (height / d)^2.
  const float d = 2.2f;
  expect_radiance(occlusion_at_origin(s, d), static_cast<double>(sqr(height / d)), 2e-2, 3);
  expect_radiance(occlusion_at_origin(s, 1.9f), 1, 1e-6, 3);
}

TEST(AmbientOcclusionStatistical, BesideAWall) {
  SceneMaker s = floor_seen_from({2, 1, 0.3f});
  const float half_width = 1.5f, height = 2, distance = 0.7f;
  s.rectangle({-distance, 0.5f * height, 0}, {0, 0.5f * height, 0}, {0, 0, half_width}, 0);
  double open =
      1 - 2 * perpendicular_rectangle_factor(static_cast<double>(height), static_cast<double>(half_width),
                                             static_cast<double>(distance));
  expect_radiance(occlusion_at_origin(s, 0), open, 2e-2, 2);
  s.document.settings.path.light_samples = 7;
  s.document.settings.stop.spp = 1024;
  expect_radiance(occlusion_at_origin(s, 0), open, 2e-2, 2);
}

TEST(AmbientOcclusionRender, NothingIsWhite) {
  SceneMaker s(2, 2, 1);
  s.document.settings.integrator = Integrator::ao;
  s.camera({0, 0, 1}, {0, 0, 0}, 40);
  EXPECT_EQ(render(s.document).mean(0, 0), vec3(1));
}

} // namespace
