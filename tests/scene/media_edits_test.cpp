#include "scene/document.h"
#include "scene/media_edits.h"
#include "support/materials.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

/// Two objects of a material, and one of another.
SceneDesc three_objects() {
  SceneDesc scene;
  scene.materials = {material_of_type("dielectric"), material_of_type("diffuse")};
  scene.materials[0].name = "glass";
  for (int material : {0, 0, 1}) {
    Instance instance;
    instance.shape = SphereShape{};
    instance.materials = {material};
    scene.instances.push_back(instance);
  }
  return scene;
}

TEST(MediaEdits, PresetsAreValidAndNamedOnce) {
  EXPECT_EQ(media_problem(medium_presets()), "");
  SceneDesc scene;
  EXPECT_EQ(add_medium(scene, medium_presets()[0]), 0u);
  EXPECT_EQ(add_medium(scene, medium_presets()[0]), 1u);
  EXPECT_EQ(scene.media[1].name, scene.media[0].name + " 2");
  EXPECT_EQ(media_problem(scene.media), "");
}

TEST(MediaEdits, NamesFollow) {
  SceneDesc scene = three_objects();
  for (const char* name : {"fog", "milk"}) {
    MediumDesc medium;
    medium.name = name;
    add_medium(scene, medium);
  }
  scene.medium = "fog";
  scene.materials[0].medium = "milk";
  EXPECT_FALSE(rename_medium(scene, 1, "fog"));
  EXPECT_FALSE(rename_medium(scene, 1, ""));
  EXPECT_TRUE(rename_medium(scene, 1, "cream"));
  EXPECT_EQ(scene.materials[0].medium, "cream");
  EXPECT_EQ(scene.medium, "fog");
  remove_medium(scene, 0);
  EXPECT_EQ(scene.medium, "");
  ASSERT_EQ(scene.media.size(), 1u);
  EXPECT_EQ(scene.media[0].name, "cream");
  EXPECT_EQ(document_problem({scene, {}}), "");
}

TEST(MediaEdits, AnObjectIsFilledWithoutTheOthers) {
  SceneDesc scene = three_objects();
  add_medium(scene, medium_presets()[0]);
  const std::string fog = scene.media[0].name;
  EXPECT_TRUE(fill_instance(scene, 1, fog));
  EXPECT_EQ(scene.materials[0].medium, "") << "of the other object";
  ASSERT_EQ(scene.instances[1].materials, std::vector<int>{2});
  EXPECT_EQ(scene.materials[2].medium, fog);
  EXPECT_EQ(scene.materials[2].name, "glass (filled)");
  EXPECT_TRUE(fill_instance(scene, 1, "")) << "emptied";
  EXPECT_EQ(scene.materials.size(), 3u);
  EXPECT_FALSE(fill_instance(scene, 2, fog)) << "no light enters";
}

TEST(MediaEdits, LightEntersWhatTransmits) {
  SceneDesc scene = three_objects();
  EXPECT_TRUE(lets_light_in(scene, scene.materials[0]));
  EXPECT_FALSE(lets_light_in(scene, scene.materials[1]));
  EXPECT_TRUE(lets_light_in(scene, material_of_type("null")));
  Material cutout = material_of_type("diffuse");
  cutout.opacity = 0.5f;
  EXPECT_TRUE(lets_light_in(scene, cutout));
  Material blend;
  blend.model = BlendMaterial{1, 0};
  EXPECT_TRUE(lets_light_in(scene, blend));
  blend.model = BlendMaterial{1, 1};
  EXPECT_FALSE(lets_light_in(scene, blend));
}

TEST(MediaEdits, AFilesGridFillsTheScene) {
  SceneDesc scene;
  auto grid = std::make_shared<VolumeGrid>();
  grid->cells = {1, 2, 1};
  grid->bounds = {vec3(0), {1, 2, 1}};
  grid->density = {1, 1};
  grid->source = "/there/plume.vdb";
  EXPECT_EQ(add_grid_medium(scene, grid, {vec3(-2), {2, 4, 6}}), 0u);
  EXPECT_EQ(scene.medium, "plume");
  const auto& placed = std::get<GridMediumModel>(scene.media[0].model);
  EXPECT_EQ(placed.center, vec3(0, 1, 2));
  EXPECT_EQ(placed.size, vec3(3, 6, 3)) << "as large as fits, in the file's proportions";
  EXPECT_EQ(media_problem(scene.media), "");
  take_box_of_file(scene.media[0]);
  EXPECT_EQ(placed.center, vec3(0.5f, 1, 0.5f));
  EXPECT_EQ(placed.size, vec3(1, 2, 1));
  EXPECT_EQ(add_grid_medium(scene, grid, {}), 1u);
  EXPECT_EQ(scene.media[1].name, "plume 2");
}

} // namespace
} // namespace candela::test
