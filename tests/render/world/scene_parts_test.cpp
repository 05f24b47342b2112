// The parts of a scene that an edit rebuilds or keeps.

#include "render/strategy_scenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace {

using namespace candela;
using namespace candela::test;

/// The parts of the scene after an edit that are those of the scene before.
struct Kept {
  bool geometry, materials, lights;
  bool operator==(const Kept&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Kept& k) {
  return out << "geometry " << k.geometry << ", materials " << k.materials << ", lights " << k.lights;
}

constexpr Kept kAll{true, true, true};

class SceneParts : public ::testing::Test {
protected:
  SceneParts() {
    test::SceneMaker s = cornell_flush(8, 8, 1, true);
    LightDesc lamp;
    lamp.model = PointLightModel{.position = {278, 400, 279}};
    lamp.color = vec3(1e5f);
    s.document.scene.lights.push_back(lamp);
    LightDesc sky;
    auto panorama = std::make_shared<Panorama>();
    panorama->image = {4, 2, std::vector<vec3>(8, vec3(0.5f))};
    sky.model = EnvironmentLightModel{.panorama = panorama};
    s.document.scene.lights.push_back(sky);
    document_ = s.document;
    scene_ = RenderScene::build(document_);
  }

  Kept kept(const std::function<void(Document&)>& edit) const {
    Document edited = document_;
    edit(edited);
    EXPECT_FALSE(edited == document_) << "it is an edit";
    const auto after = RenderScene::build(edited, scene_.get());
    return {after->shared_geometry() == scene_->shared_geometry(),
            after->shared_materials() == scene_->shared_materials(),
            after->shared_lights() == scene_->shared_lights()};
  }
  std::size_t emitting_material() const {
    std::size_t i = 0;
    while (is_black(document_.scene.materials[i].emission.value)) ++i;
    return i;
  }

  Document document_;
  std::shared_ptr<const RenderScene> scene_;
};

TEST_F(SceneParts, ACameraMoveKeepsAll) {
  EXPECT_EQ(kept([](Document& d) { d.scene.camera.position.x += 1; }), kAll);
  EXPECT_EQ(kept([](Document& d) { d.settings.path.max_depth = 3; }), kAll);
  EXPECT_EQ(kept([](Document& d) { d.settings.sampler.seed += 1; }), kAll);
  EXPECT_EQ(kept([](Document& d) { d.settings.film.width = 9; }), kAll);
}

TEST_F(SceneParts, ALightsEditKeepsGeometryAndMaterials) {
  const Kept expected{true, true, false};
  EXPECT_EQ(kept([](Document& d) { light_position(d.scene.lights[0])->x += 1; }), expected);
  EXPECT_EQ(kept([](Document& d) { d.scene.lights.clear(); }), expected);
  EXPECT_EQ(kept([](Document& d) { d.settings.path.light_choice = LightChoiceBy::power; }), expected);
}

TEST_F(SceneParts, AMaterialsEditKeepsLightsUnlessItsEmissionChanged) {
  const std::size_t lamp = emitting_material(), wall = lamp == 0 ? 1 : 0;
  const Kept reflection{true, false, true}, emission{true, false, false};
  EXPECT_EQ(kept([&](Document& d) { color(d.scene.materials[wall], "diffuse") *= 0.5f; }), reflection);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials[wall].opacity.value = 0.5f; }), reflection);
  EXPECT_EQ(kept([&](Document& d) { color(d.scene.materials[lamp], "diffuse") *= 0.5f; }), reflection);
  EXPECT_EQ(kept([&](Document& d) { apply_setting(d, "override.brdf=mirror"); }), reflection);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials[lamp].emission.value *= 0.5f; }), emission);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials[lamp].opacity.value = 0.5f; }), emission);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials[lamp].two_sided_emission = true; }), emission);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials[wall].emission.value = vec3(1); }), emission);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials.push_back(Material()); }), emission)
      << "another list of materials";
}

TEST_F(SceneParts, AGroupsEditScalesItsLightsAlone) {
  auto name = [](Document& d) { d.scene.lights[0].group = "lamps"; };
  name(document_);
  scene_ = RenderScene::build(document_, scene_.get());
  EXPECT_EQ(kept([](Document& d) { d.scene.light_groups = {{"lamps"}}; }), kAll) << "as it was";
  auto scaled = [&](bool on, float scale) {
    Document edited = document_;
    edited.settings.film.light_groups = LightGroupsIn::scene;
    edited.scene.light_groups = {{"lamps", on, scale}};
    return RenderScene::build(edited, scene_.get());
  };
  auto brightness = [](const RenderScene& scene) {
    for (const Light& light : scene.lights())
      if (const auto* point = std::get_if<PointLight>(&light)) return point->intensity.x;
    return 0.0f;
  };
  EXPECT_EQ(brightness(*scaled(true, 3)), 3e5f);
  EXPECT_EQ(brightness(*scaled(false, 3)), 0) << "it is not there";
  EXPECT_EQ(scaled(true, 3)->shared_materials(), scene_->shared_materials());
  EXPECT_EQ(scaled(true, 3)->shared_geometry(), scene_->shared_geometry());
  // Materials that shine, too.
  document_.scene.materials[emitting_material()].group = "lamps";
  scene_ = RenderScene::build(document_, scene_.get());
  const std::size_t lights = scene_->lights().size();
  EXPECT_LT(scaled(false, 1)->lights().size(), lights - 1);
  const auto twice = scaled(true, 2);
  EXPECT_EQ(twice->material(static_cast<std::uint32_t>(emitting_material())).emission,
            2.0f * scene_->material(static_cast<std::uint32_t>(emitting_material())).emission);
}

TEST_F(SceneParts, AGroupsEditKeepsAllWhereTheFilmHasItsLayer) {
  document_.scene.lights[0].group = "lamps";
  scene_ = RenderScene::build(document_, scene_.get());
  ASSERT_EQ(scene_->layer_count(), 2u);
  EXPECT_EQ(kept([](Document& d) { d.scene.light_groups = {{"lamps", false, 3}}; }), kAll);
  // Lights of one layer, in the order of the scene's: emitters first, a sky's are several.
  for (std::uint32_t i = 0; i < scene_->lights().size(); ++i)
    EXPECT_EQ(scene_->layer_of_light(i), std::holds_alternative<PointLight>(scene_->lights()[i]) ? 0 : 1);
  EXPECT_EQ(kept([&](Document& d) { d.scene.materials[emitting_material()].group = "lamps"; }),
            (Kept{true, false, false}));
  document_.scene.materials[emitting_material()].group = "lamps";
  scene_ = RenderScene::build(document_, scene_.get());
  EXPECT_EQ(scene_->layer_of_material(static_cast<std::uint32_t>(emitting_material())), 0);
  for (std::uint32_t i = 0; i < scene_->lights().size(); ++i)
    EXPECT_EQ(scene_->layer_of_light(i) == 1, light_kind(scene_->lights()[i]) == LightKind::infinite);
}

TEST_F(SceneParts, AComputedSkyIsKeptUntilItsAirOrSunChanges) {
  SkyLightModel sky{.resolution = 32};
  document_.scene.lights.push_back({"sky", sky});
  scene_ = RenderScene::build(document_);
  auto map_after = [&](auto edit) {
    Document edited = document_;
    edit(std::get<SkyLightModel>(edited.scene.lights.back().model));
    const auto after = RenderScene::build(edited, scene_.get());
    return std::get<EnvironmentLight>(after->lights()[after->lights().size() - 2]).map;
  };
  const auto* before = std::get<EnvironmentLight>(scene_->lights()[scene_->lights().size() - 2]).map;
  EXPECT_EQ(map_after([](SkyLightModel& m) { m.rotation = 1; }), before);
  EXPECT_EQ(map_after([](SkyLightModel& m) { m.sun_scale = 2; }), before);
  EXPECT_EQ(map_after([](SkyLightModel& m) { m.hour = 3; }), before) << "not asked for";
  EXPECT_NE(map_after([](SkyLightModel& m) { m.turbidity = 3; }), before);
  EXPECT_NE(map_after([](SkyLightModel& m) { m.sun_elevation = 0.3f; }), before);
  Progress told;
  told.cancel();
  EXPECT_THROW(RenderScene::build(document_, nullptr, &told), Cancelled);
}

TEST_F(SceneParts, AMovedInstanceKeepsMaterials) {
  EXPECT_EQ(kept([](Document& d) { d.scene.instances[0].world_from_object[3].y += 1; }),
            (Kept{false, true, false}));
}

TEST_F(SceneParts, WhatIsKeptIsWhatWouldBeBuilt) {
  const std::size_t lamp = emitting_material(), wall = lamp == 0 ? 1 : 0;
  const std::function<void(Document&)> edits[] = {
      [](Document& d) { d.scene.camera.position.x += 1; },
      [](Document& d) { d.scene.lights[0].color *= 0.5f; },
      [&](Document& d) { color(d.scene.materials[wall], "diffuse") *= 0.5f; },
      [&](Document& d) { d.scene.materials[lamp].emission.value *= 0.5f; },
      [&](Document& d) { d.scene.materials[lamp].opacity.value = 0.5f; },
      [](Document& d) { apply_setting(d, "override.brdf=ggx"); },
      [](Document& d) { d.scene.instances[0].world_from_object[3].y += 1; },
      [](Document& d) { apply_setting(d, "override.brdf=none"); },
  };
  Document d = document_;
  std::shared_ptr<const RenderScene> scene = scene_;
  for (const auto& edit : edits) { // one after the other
    edit(d);
    scene = RenderScene::build(d, scene.get());
    const auto anew = RenderScene::build(d);
    ASSERT_EQ(scene->lights().size(), anew->lights().size());
    EXPECT_EQ(scene->memory_bytes(), anew->memory_bytes());
    for (unsigned i = 0; i < 200; ++i) {
      const uvec2 pixel(i % 8, i / 8 % 8);
      ASSERT_EQ(replay_sample(*scene, d, pixel, i), replay_sample(*anew, d, pixel, i));
    }
  }
}

} // namespace
