// Groups of lights.

#include "scene/light_layers.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

SceneDesc scene() {
  SceneDesc s;
  s.lights.resize(3);
  s.lights[0].group = "key", s.lights[1].group = "fill";
  s.lights[0].scale = 3;
  s.materials.resize(2);
  s.materials[0].group = "fill";
  s.materials[0].emission = ColorParameter(vec3(1, 2, 3));
  s.materials[0].emission.offset = vec3(0.5f);
  return s;
}

TEST(LightGroups, AreThoseOfTheListAndThoseThatLightsName) {
  SceneDesc s = scene();
  EXPECT_EQ(light_group_names(s), (std::vector<std::string>{"key", "fill"}));
  light_group(s, "rim").on = false;
  light_group(s, "fill").scale = 2;
  EXPECT_EQ(light_group_names(s), (std::vector<std::string>{"key", "fill", "rim"}))
      << "in the order of the lights, whatever is edited";
  EXPECT_EQ(used_group_names(s), (std::vector<std::string>{"key", "fill"}));
  EXPECT_EQ(s.light_groups.size(), 2u);
  EXPECT_EQ(light_group(s, "fill").scale, 2);
  EXPECT_EQ(s.light_groups.size(), 2u) << "there already";
}

TEST(LightGroups, ScaleAndSwitchTheirLightsAndMaterials) {
  SceneDesc s = scene();
  EXPECT_FALSE(has_scaled_groups(s));
  light_group(s, "key");
  EXPECT_FALSE(has_scaled_groups(s)) << "on, and scaled by 1";
  EXPECT_EQ(grouped_lights(s), s.lights);
  EXPECT_EQ(grouped_materials(s), s.materials);
  light_group(s, "key").scale = 2;
  light_group(s, "fill").on = false;
  EXPECT_TRUE(has_scaled_groups(s));
  const auto lights = grouped_lights(s);
  EXPECT_EQ(lights[0].scale, 6);
  EXPECT_EQ(lights[1].scale, 0);
  EXPECT_EQ(lights[2], s.lights[2]);
  const auto materials = grouped_materials(s);
  EXPECT_EQ(materials[0].emission.value, vec3(0));
  EXPECT_EQ(materials[0].emission.offset, vec3(0));
  EXPECT_EQ(materials[1], s.materials[1]);
  light_group(s, "fill").on = true, light_group(s, "fill").scale = 4;
  EXPECT_EQ(grouped_materials(s)[0].emission.value, vec3(4, 8, 12));
  EXPECT_EQ(grouped_materials(s)[0].emission.offset, vec3(2));
}

TEST(LightGroups, ColoursAndSoloAreFactorsToo) {
  SceneDesc s = scene();
  light_group(s, "key").color = {1, 0.5f, 0};
  EXPECT_TRUE(has_scaled_groups(s));
  EXPECT_EQ(grouped_lights(s)[0].color, vec3(1, 0.5f, 0));
  EXPECT_EQ(grouped_lights(s)[0].scale, 3);
  light_group(s, "key").scale = 2;
  EXPECT_EQ(light_factor(s, "key"), vec3(2, 1, 0));
  EXPECT_EQ(light_factor(s, "fill"), vec3(1));
  light_group(s, "fill").solo = true;
  EXPECT_EQ(light_factor(s, "key"), vec3(0));
  EXPECT_EQ(light_factor(s, "fill"), vec3(1));
  EXPECT_EQ(light_factor(s, ""), vec3(0)) << "lights without a group are not solo";
  EXPECT_EQ(grouped_lights(s)[0].scale, 0);
  EXPECT_EQ(grouped_lights(s)[2].scale, 0);
  EXPECT_EQ(grouped_materials(s)[0].emission.value, vec3(1, 2, 3));
  light_group(s, "key").solo = true;
  EXPECT_EQ(light_factor(s, "key"), vec3(2, 1, 0));
  light_group(s, "key").on = false;
  EXPECT_EQ(light_factor(s, "key"), vec3(0)) << "solo, but off";
}

TEST(LightLayers, AreOfTheUsedGroupsAndOfTheOtherLights) {
  Document d;
  d.scene = scene();
  light_group(d.scene, "rim").scale = 3; // nobody is in it
  LightLayers layers = light_layers(d);
  EXPECT_EQ(layers.names, (std::vector<std::string>{"key", "fill"}));
  EXPECT_TRUE(layers.has_rest);
  EXPECT_EQ(layers.of_light, (std::vector<std::uint8_t>{0, 1, 2}));
  EXPECT_EQ(layers.of_material[0], 1);
  EXPECT_EQ(light_mix(d.scene, layers), LightMix(3, vec3(1)));
  EXPECT_TRUE(is_plain(light_mix(d.scene, layers)));
  light_group(d.scene, "fill").scale = 2;
  EXPECT_EQ(light_layers(d), layers) << "which does not depend on the factors";
  EXPECT_EQ(light_mix(d.scene, layers), (LightMix{vec3(1), vec3(2), vec3(1)}));
  d.scene.lights[2].group = "key";
  EXPECT_FALSE(light_layers(d).has_rest) << "the other material does not shine";
  d.scene.materials[1].emission = vec3{1, 0, 0};
  EXPECT_TRUE(light_layers(d).has_rest);
}

TEST(LightLayers, AreKeptWhereThePictureCanBeMixed) {
  Document d;
  d.scene = scene();
  EXPECT_EQ(layers_problem(d), "");
  auto problem_with = [&](const char* setting) {
    Document edited = d;
    apply_setting(edited, setting);
    EXPECT_EQ(light_layers(edited).empty(), !layers_problem(edited).empty()) << setting;
    return layers_problem(edited);
  };
  for (const char* setting : {"view=variance", "integrator=direct", "integrator=whitted", "path.clamp=1"})
    EXPECT_EQ(problem_with(setting), "");
  for (const char* setting :
       {"view=albedo", "view=light_share", "integrator=ao", "adaptive.error=0.1", "film.light_groups=scene"})
    EXPECT_NE(problem_with(setting).find("; "), std::string::npos) << setting;
  Document none;
  EXPECT_NE(layers_problem(none), "");
}

TEST(LightLayers, TakeNoMoreMemoryThanTheirLimit) {
  Document d;
  d.scene.lights.resize(kMostLiveGroups);
  for (std::size_t i = 0; i < kMostLiveGroups; ++i) d.scene.lights[i].group = std::to_string(i);
  EXPECT_EQ(light_layers(d).count(), kMostLiveGroups);
  d.settings.film.width = d.settings.film.height = 4096;
  EXPECT_TRUE(light_layers(d).empty());
  EXPECT_NE(layers_problem(d).find("16 layers of 4096x4096 pixels"), std::string::npos) << layers_problem(d);
  d.scene.lights.resize(2);
  EXPECT_EQ(light_layers(d).count(), 2u) << "1.2 GB";
  d.settings.film.width = d.settings.film.height = 16;
  d.scene.lights.resize(kMostLiveGroups + 1);
  for (std::size_t i = 0; i < d.scene.lights.size(); ++i) d.scene.lights[i].group = std::to_string(i);
  EXPECT_TRUE(light_layers(d).empty());
  EXPECT_NE(layers_problem(d).find("17 groups"), std::string::npos) << layers_problem(d);
}

TEST(LightGroups, AreCheckedAndCompared) {
  Document document;
  document.scene = scene();
  Document changed = document;
  light_group(changed.scene, "key");
  EXPECT_EQ(compare_documents(document, changed), Invalidates::display) << "the film keeps it apart";
  auto in_scene = [](Document d) {
    d.settings.film.light_groups = LightGroupsIn::scene;
    return d;
  };
  EXPECT_EQ(compare_documents(in_scene(document), in_scene(changed)), Invalidates::nothing)
      << "it changes nothing";
  light_group(changed.scene, "key").scale = 2;
  EXPECT_EQ(compare_documents(document, changed), Invalidates::display);
  EXPECT_EQ(compare_documents(in_scene(document), in_scene(changed)), Invalidates::scene);
  Document joined = document;
  joined.scene.materials[0].group = "key";
  EXPECT_EQ(compare_documents(document, joined), Invalidates::scene) << "other layers";
  EXPECT_FALSE(same_content(document, changed));
  EXPECT_EQ(document_problem(changed), "");
  changed.scene.light_groups[0].scale = -1;
  EXPECT_TRUE(document_problem(changed).starts_with("light_groups[0].scale: ")) << document_problem(changed);
  changed.scene.light_groups = {{"a"}, {"a"}};
  EXPECT_TRUE(document_problem(changed).starts_with("light_groups[1].name: 'a'"));
  changed.scene.light_groups = {{""}};
  EXPECT_TRUE(document_problem(changed).starts_with("light_groups[0].name: is empty"));
}

TEST(LightGroups, StayWhenTypesChange) {
  SceneDesc s = scene();
  change_type(s.lights[0], 3);
  change_type(s.materials[0], 1);
  EXPECT_EQ(s.lights[0].group, "key");
  EXPECT_EQ(s.materials[0].group, "fill");
}

} // namespace
} // namespace candela
