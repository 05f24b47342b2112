// Groups of lights.

#include "scene/document.h"

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
  EXPECT_EQ(light_group_names(s), (std::vector<std::string>{"rim", "fill", "key"}));
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

TEST(LightGroups, AreCheckedAndCompared) {
  Document document;
  document.scene = scene();
  Document changed = document;
  light_group(changed.scene, "key");
  EXPECT_EQ(compare_documents(document, changed), Invalidates::scene);
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
