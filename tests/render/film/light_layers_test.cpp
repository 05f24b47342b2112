// Renders that keep light groups apart: their layers add up to the picture, and any mix of them is the
// picture of the scene with scaled lights.

#include "render/film/accumulation.h"
#include "render/quadrants.h"
#include "render/strategy_scenes.h"

#include <fmt/format.h>

namespace {

using namespace candela;
using namespace candela::test;

/// Lights and emitting materials are, in turn, in group a, in b and in none; `all`: also those in a.
Document grouped(Document d, bool all = false) {
  int next = 0;
  auto join = [&](std::string& group) {
    constexpr std::string_view kGroups[] = {"a", "b", ""};
    group = kGroups[next == 2 && all ? 0 : next];
    next = (next + 1) % 3;
  };
  for (LightDesc& light : d.scene.lights) join(light.group);
  for (Material& m : d.scene.materials)
    if (!is_black(m.emission.value) || m.emission.is_textured()) join(m.group);
  return d;
}

struct Layered {
  LightLayers layers;
  Film film;
  LayerFilm by_layer;

  Film mixed(const SceneDesc& scene) const {
    Film out;
    by_layer.mix(film, light_mix(scene, layers), out);
    return out;
  }
};

Layered render_layers(const Document& d) {
  const auto scene = RenderScene::build(d);
  const FilmSettings& size = d.settings.film;
  Layered out{scene->light_layers(), Film(size.width, size.height), {}};
  out.by_layer.resize(scene->layer_count(), size.width, size.height);
  PassOptions options;
  options.layers = &out.by_layer;
  const auto spp = static_cast<std::uint32_t>(d.settings.stop.spp);
  EXPECT_TRUE(render_pass(*scene, d, {0, spp}, out.film, {}, options).completed);
  return out;
}

Document without_groups(Document d) {
  for (LightDesc& light : d.scene.lights) light.group.clear();
  for (Material& m : d.scene.materials) m.group.clear();
  d.scene.light_groups.clear();
  return d;
}

Document in_the_scene(Document d) {
  d.settings.film.light_groups = LightGroupsIn::scene;
  return d;
}

float difference(const Image& a, const Image& b) {
  float most = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(a.pixels[i][c] - b.pixels[i][c]) / (1e-3f + std::abs(b.pixels[i][c])));
  return most;
}

void expect_layers_of(const Document& d) {
  const Layered kept = render_layers(d);
  ASSERT_GE(kept.by_layer.layers(), 1u);
  EXPECT_TRUE(kept.film == render(without_groups(d))) << "the same bits as without groups";
  const Film sum = kept.mixed(d.scene);
  EXPECT_LT(difference(sum.image(), kept.film.image()), 2e-5f);
  EXPECT_LT(difference(sum.variance_image(), kept.film.variance_image()), 1e-2f);
}

TEST(LightLayersRender, AddUpToThePictureForEveryIntegratorAndStrategy) {
  for (const NamedScene& scene : strategy_scenes()) {
    SCOPED_TRACE(scene.name);
    Document d = grouped(scene.document);
    d.settings.stop.spp = 8;
    d.settings.sampler.seed = sampler_seed();
    for (Integrator integrator : {Integrator::path, Integrator::direct, Integrator::whitted})
      for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis})
        for (int light_samples : {1, 3}) {
          d.settings.integrator = integrator;
          d.settings.path.light_sampling = how;
          d.settings.path.light_samples = light_samples;
          SCOPED_TRACE(fmt::format("integrator {}, sampling {}, {} light samples",
                                   static_cast<int>(integrator), static_cast<int>(how), light_samples));
          expect_layers_of(d);
        }
  }
}

TEST(LightLayersRender, AddUpToWhatClampsAndComponentsLeave) {
  Document d = grouped(sky_sun_and_lamp_scene());
  d.settings.stop.spp = 16;
  for (const char* setting :
       {"path.clamp=0.4", "path.component=indirect", "path.component=emitted", "path.only_depth=2",
        "camera.projection=spherical", "camera.lens=fisheye", "film.filter=mitchell"}) {
    SCOPED_TRACE(setting);
    Document edited = d;
    apply_setting(edited, setting);
    expect_layers_of(edited);
  }
}

Document with_factors(Document d, vec3 a, float b, bool b_on = true) {
  light_group(d.scene, "a").color = a;
  light_group(d.scene, "b").scale = b;
  light_group(d.scene, "b").on = b_on;
  return d;
}

/// The same light selection, for all lights are scaled alike: the same samples, but for rounding.
TEST(LightLayersRender, AMixOfAllLightsTwiceAsBrightIsTheSceneTwiceAsBright) {
  for (const NamedScene& scene : strategy_scenes()) {
    SCOPED_TRACE(scene.name);
    Document d = with_factors(grouped(scene.document, true), vec3(2), 2);
    d.settings.stop.spp = 8;
    d.settings.sampler.seed = sampler_seed(1);
    const Image scaled = render(in_the_scene(d)).image(), mixed = render_layers(d).mixed(d.scene).image();
    EXPECT_LT(difference(mixed, scaled), 2e-5f);
  }
}

TEST(LightLayersStatistical, AMixIsThePictureOfTheSceneWithScaledLights) {
  const auto scenes = strategy_scenes();
  const int tests = 3 * static_cast<int>(scenes.size());
  std::uint64_t salt = 0;
  for (const NamedScene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    Document d = grouped(scene.document);
    d.settings.stop.spp = 512;
    d.settings.sampler.type = SamplerType::independent;
    d.settings.sampler.seed = sampler_seed(++salt);
    d.settings.path.max_depth = 6;
    const Layered kept = render_layers(d);
    auto other = [&](Document edited) {
      edited.settings.sampler.seed = sampler_seed(++salt);
      return estimate(render(edited));
    };
    const Document mixed = with_factors(d, {0.3f, 2, 1}, 5);
    expect_same(estimate(kept.mixed(mixed.scene)), other(in_the_scene(mixed)), tests);
    const Document off = with_factors(d, vec3(1), 1, false);
    Document absent = d;
    std::erase_if(absent.scene.lights, [&](const LightDesc& light) { return light.group == "b"; });
    for (std::size_t i = 0; i < d.scene.materials.size(); ++i)
      if (d.scene.materials[i].group == "b") absent.scene.materials[i].emission = ColorParameter(vec3(0));
    absent = without_groups(absent);
    expect_same(estimate(kept.mixed(off.scene)), other(absent), tests);
    Document solo = d;
    light_group(solo.scene, "a").solo = true;
    expect_same(estimate(kept.mixed(solo.scene)), other(in_the_scene(solo)), tests);
  }
}

TEST(LightLayersRender, ComponentsAreThoseOfTheMix) {
  Document d = with_factors(grouped(sky_sun_and_lamp_scene()), {0.3f, 2, 1}, 5);
  d.settings.stop.spp = 4;
  const auto scene = RenderScene::build(d);
  Accumulation a(d.settings.film, {.components = true, .mix = light_mix(d.scene, scene->light_layers())});
  CpuPassRenderer renderer;
  ASSERT_TRUE(a.advance(renderer, *scene, d, {}));
  Film memory;
  const Image picture = a.picture(memory).image();
  Image sum = a.state().components[0].image();
  for (int c : {1, 2}) {
    const Image part = a.state().components[static_cast<std::size_t>(c)].image();
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += part.pixels[i];
  }
  EXPECT_LT(difference(sum, picture), 2e-5f);
}

TEST(LightLayersRender, DoNotDependOnPassesAndMerges) {
  Document d = with_factors(grouped(sky_sun_and_lamp_scene()), {0.3f, 2, 1}, 5);
  d.settings.stop.spp = 7;
  const auto scene = RenderScene::build(d);
  const Layered expected = render_layers(d);
  const LightMix mix = light_mix(d.scene, scene->light_layers());
  CpuPassRenderer renderer(2);
  Accumulation a(d.settings.film, {.mix = mix});
  ASSERT_TRUE(a.advance(renderer, *scene, d, {})); // the films are not clear when they are used again
  a.restart(d.settings.film, {.coarsest = 4, .mix = mix});
  ASSERT_TRUE(a.advance(renderer, *scene, d, {.stop = {}, .portion = {1, 2}, .on_pass = {}}));
  EXPECT_TRUE(a.state().layers == expected.by_layer);
  Accumulation first(d.settings.film, {.mix = mix}), second(d.settings.film, {.mix = mix, .first_sample = 3});
  Document part = d;
  part.settings.stop.spp = 3;
  ASSERT_TRUE(first.advance(renderer, *scene, part, {}));
  part.settings.stop.spp = 4;
  ASSERT_TRUE(second.advance(renderer, *scene, part, {}));
  Accumulation plain(d.settings.film, {.first_sample = 3});
  ASSERT_TRUE(plain.advance(renderer, *scene, part, {}));
  EXPECT_FALSE(first.merge(plain)) << "it has no layers";
  ASSERT_TRUE(first.merge(second));
  Film x, y;
  EXPECT_LT(difference(first.picture(x).image(), expected.mixed(d.scene).image()), 1e-6f);
  EXPECT_LT(difference(first.picture(x).half_image(1), expected.mixed(d.scene).half_image(1)), 1e-4f);
  first.set_mix({vec3(1), vec3(1), vec3(1)}, d.settings.stop);
  EXPECT_EQ(&first.picture(y), &first.film()) << "nothing to mix";
}

TEST(LightLayersRender, NoiseIsThatOfTheMix) {
  Document d = grouped(sky_sun_and_lamp_scene());
  d.settings.stop.spp = 16;
  d.settings.stop.noise = 1e-6f;
  const auto scene = RenderScene::build(d);
  Accumulation a(d.settings.film, {.mix = {vec3(1), vec3(1), vec3(1)}});
  CpuPassRenderer renderer;
  ASSERT_TRUE(a.advance(renderer, *scene, d, {}));
  const double whole = a.state().noise;
  EXPECT_GT(whole, 0);
  d.settings.stop.noise = static_cast<float>(0.9 * whole);
  a.set_mix({vec3(0), vec3(0), vec3(0)}, d.settings.stop);
  EXPECT_EQ(a.state().noise, 0) << "black";
  EXPECT_TRUE(a.finished(d.settings.stop));
  a.set_mix({vec3(1), vec3(1), vec3(1)}, d.settings.stop);
  EXPECT_EQ(a.state().noise, whole);
}

} // namespace
