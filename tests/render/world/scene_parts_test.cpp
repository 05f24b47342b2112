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
