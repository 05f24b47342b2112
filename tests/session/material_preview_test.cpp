// Pictures of single materials.

#include "imaging/display_transform.h"
#include "io/scene_reader.h"
#include "materials/material_parts.h"
#include "render/film/film_view.h"
#include "session/material_preview.h"
#include "session/offline_render.h"
#include "support/textures.h"

#include <gtest/gtest.h>

#include <set>

namespace candela {
namespace {

Material named(const char* name, MaterialModel model) {
  Material m;
  m.name = name;
  m.model = model;
  return m;
}

/// A blend of a blend, with textures, among materials that have nothing to do with it.
SceneDesc blended_scene() {
  SceneDesc scene;
  scene.textures = {test::picture_texture(1, 1, {1, 2, 3}), test::picture_texture(1, 1, {4, 5, 6})};
  scene.materials.push_back(named("other", MirrorMaterial()));
  DiffuseMaterial wood{vec3(1)};
  wood.diffuse.use.texture = 1;
  scene.materials.push_back(named("wood", wood));
  BlendMaterial inner;
  inner.first = 1, inner.second = 0;
  scene.materials.push_back(named("inner", inner));
  BlendMaterial outer;
  outer.first = 2, outer.second = 1;
  scene.materials.push_back(named("outer", outer));
  return scene;
}

Document studio() { return read_scene(CANDELA_TEST_SOURCE_DIR "/scenes/studio.json").document; }

TEST(MaterialSample, TakesWhatIsNamedOnceAndNoMore) {
  const SceneDesc scene = blended_scene();
  const MaterialSample sample = material_sample(scene, 3);
  ASSERT_EQ(sample.materials.size(), 4u);
  ASSERT_EQ(sample.textures.size(), 1u);
  EXPECT_EQ(sample.textures[0], scene.textures[1]);
  const auto& outer = std::get<BlendMaterial>(sample.materials[0].model);
  const auto& inner = std::get<BlendMaterial>(sample.materials[static_cast<std::size_t>(outer.first)].model);
  EXPECT_EQ(inner.first, outer.second) << "the wood, once";
  const auto& wood = std::get<DiffuseMaterial>(sample.materials[static_cast<std::size_t>(inner.first)].model);
  EXPECT_EQ(wood.diffuse.use.texture, 0);
  EXPECT_TRUE(
      std::holds_alternative<MirrorMaterial>(sample.materials[static_cast<std::size_t>(inner.second)].model));
  EXPECT_EQ(material_sample(scene, 1).materials.size(), 1u);
}

TEST(MaterialSample, DependsOnValuesAlone) {
  SceneDesc scene = blended_scene();
  const MaterialSample before = material_sample(scene, 3);
  scene.materials[3].name = "renamed";
  scene.materials[1].group = "lamps";
  scene.textures.insert(scene.textures.begin(), scene.textures[0]);
  for (Material& m : scene.materials)
    each_parameter(m, [](const MaterialField&, const ParameterRef& p) {
      if (p.use().texture >= 0) ++p.use().texture;
    });
  EXPECT_EQ(material_sample(scene, 3), before);
  std::get<DiffuseMaterial>(scene.materials[1].model).diffuse.value = vec3(0.5f); // of a part of a part
  EXPECT_NE(material_sample(scene, 3), before);
}

TEST(MaterialPreview, TakesThePlaceOfTheStudiosMaterial) {
  const Document empty = studio();
  const SceneDesc scene = blended_scene();
  const auto document = preview_document(empty, material_sample(scene, 3), 16, 2);
  ASSERT_TRUE(document);
  EXPECT_EQ(document_problem(*document), "");
  EXPECT_EQ(parts_problem(document->scene.materials), std::nullopt);
  const auto& materials = document->scene.materials;
  ASSERT_EQ(materials.size(), empty.scene.materials.size() + 3);
  std::size_t place = 0;
  while (empty.scene.materials[place].name != "material") ++place;
  const auto& outer = std::get<BlendMaterial>(materials[place].model);
  const auto& inner = std::get<BlendMaterial>(materials[static_cast<std::size_t>(outer.first)].model);
  const auto& wood = std::get<DiffuseMaterial>(materials[static_cast<std::size_t>(inner.first)].model);
  EXPECT_EQ(document->scene.textures[static_cast<std::size_t>(wood.diffuse.use.texture)], scene.textures[1]);
  for (std::size_t i = 0; i < empty.scene.materials.size(); ++i) {
    if (i != place) { EXPECT_EQ(materials[i], empty.scene.materials[i]); }
  }
  Document bare;
  EXPECT_FALSE(preview_document(bare, material_sample(scene, 0), 16, 2)) << "no studio";
}

TEST(MaterialPreviewRender, TheSameMaterialHasTheSameBits) {
  const Document empty = studio();
  SceneDesc scene;
  scene.materials = {named("a", PlasticMaterial()), named("b", PlasticMaterial()),
                     named("c", MirrorMaterial())};
  const std::atomic<bool> never{false};
  auto render = [&](std::size_t i) {
    return render_preview(*preview_document(empty, material_sample(scene, i), 24, 3), nullptr, never);
  };
  const auto a = render(0);
  ASSERT_TRUE(a);
  EXPECT_EQ(a->rgba.size(), 24u * 24u * 4u);
  EXPECT_EQ(a->rgba, render(1)->rgba) << "whatever it is called";
  EXPECT_NE(a->rgba, render(2)->rgba);
  // With the geometry of another preview.
  const auto again =
      render_preview(*preview_document(empty, material_sample(scene, 1), 24, 3), render(2)->scene, never);
  ASSERT_TRUE(again);
  EXPECT_EQ(a->rgba, again->rgba);
  // As by the command line, with several threads.
  const Document document = *preview_document(empty, material_sample(scene, 0), 24, 3);
  OfflineOptions options;
  options.pass.threads = 3;
  const OfflineResult result = render_document(document, options);
  const Image image = view_image(result.film, document.settings.view);
  std::vector<std::uint8_t> rgba(4 * image.pixels.size());
  display_rgba8(image.pixels, {image.width, {}},
                display_transform(image.pixels, image.width, image.height, document.settings.display,
                                  document.settings.view, result.display_scale),
                rgba);
  EXPECT_EQ(a->rgba, rgba);
}

TEST(MaterialPreviewRender, EveryTypeHasAPicture) {
  const Document empty = studio();
  const std::atomic<bool> never{false};
  std::set<std::string> pictures;
  std::shared_ptr<const RenderScene> scene_before;
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    SCOPED_TRACE(material_type_names()[static_cast<std::size_t>(type)]);
    SceneDesc scene;
    scene.materials = {default_material(type)};
    const auto picture =
        render_preview(*preview_document(empty, material_sample(scene, 0), 16, 1), scene_before, never);
    ASSERT_TRUE(picture);
    pictures.emplace(picture->rgba.begin(), picture->rgba.end());
    if (scene_before) {
      EXPECT_EQ(picture->scene->shared_geometry(), scene_before->shared_geometry()) << "built once";
    }
    scene_before = picture->scene;
  }
  EXPECT_GT(pictures.size(), 10u);
}

TEST(MaterialPreviewRender, Stops) {
  SceneDesc scene;
  scene.materials = {named("a", PlasticMaterial())};
  const std::atomic<bool> stopped{true};
  EXPECT_FALSE(
      render_preview(*preview_document(studio(), material_sample(scene, 0), 64, 1 << 20), nullptr, stopped));
}

} // namespace
} // namespace candela
