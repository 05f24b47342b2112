// Converted scenes are self-contained and read back unchanged.

#include "io/scene_export.h"
#include "io/scene_files.h"

namespace candela {
namespace {

using test::SceneFiles;

TEST(SceneExport, CopiesPicturesFromElsewhereAndWritesMeshesInline) {
  SceneFiles files;
  files.write("in/t/a.png", test::tiny_png());
  files.write("in/u/a.png", test::tiny_png());
  files.write("in/x.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 0.1 0\nusemtl a\nf 1 2 3\n");
  files.write("in/x.mtl", "newmtl a\nKd 0.1 0.2 0.3\nmap_Kd t/a.png\n");
  files.write("in/s.json", R"({"candela": 1, "materials": [{"name": "u", "diffuse_texture": "u/a.png"}],
    "lights": [{"type": "environment", "file": "t/a.png"}],
    "instances": [{"file": "x.obj"}, {"shape": "sphere", "material": "u"}]})");
  Document document = files.read("in/s.json").document;
  std::filesystem::create_directory(files / "out");
  auto copied = export_candela_json(document, files / "out/scene.json");
  ASSERT_EQ(copied.size(), 2u);
  EXPECT_EQ(files.without_folder(copied[0].to), "out/scene_files/a.png");
  EXPECT_EQ(files.without_folder(copied[1].to), "out/scene_files/a-2.png");
  EXPECT_EQ(test::read_text(copied[0].to), test::tiny_png());
  std::filesystem::remove_all(files / "in");
  LoadedScene again = files.read("out/scene.json");
  EXPECT_EQ(files.warnings(again), std::vector<std::string>{});
  for (auto* scene : {&document.scene, &again.document.scene}) { // where a picture came from may differ
    for (auto& texture : scene->textures) {
      auto nameless = std::make_shared<Texture>(*texture);
      nameless->name.clear(), std::get<ImageTexture>(nameless->model).source.clear();
      texture = nameless;
    }
    auto nameless = std::make_shared<Panorama>(*light_panorama(scene->lights[0]));
    nameless->name.clear(), nameless->sources.clear();
    std::get<EnvironmentLightModel>(scene->lights[0].model).panorama = nameless;
  }
  EXPECT_TRUE(same_content(document, again.document));
}

TEST(SceneExport, NamesWhatLiesBesideIt) {
  SceneFiles files;
  files.write("t/a.png", test::tiny_png());
  files.write("s.json", R"({"candela": 1, "lights": [{"type": "environment", "file": "t/a.png"}]})");
  Document document = files.read("s.json").document;
  EXPECT_TRUE(export_candela_json(document, files / "copy.json").empty());
  EXPECT_TRUE(same_content(files.read("copy.json").document, document));
  EXPECT_FALSE(std::filesystem::exists(files / "copy_files"));
  std::filesystem::remove(files / "t/a.png"); // then the picture is written inline
  EXPECT_TRUE(export_candela_json(document, files / "inline.json").empty());
  Document again = files.read("inline.json").document;
  EXPECT_EQ(light_panorama(again.scene.lights[0])->image, light_panorama(document.scene.lights[0])->image);
}

TEST(SceneExport, CopiesNothingForAnInvalidDocument) {
  SceneFiles files;
  files.write("in/a.png", test::tiny_png());
  files.write("in/s.json", R"({"candela": 1, "lights": [{"type": "environment", "file": "a.png"}]})");
  Document document = files.read("in/s.json").document;
  document.settings.film.width = 0;
  EXPECT_THROW(export_candela_json(document, files / "out.json"), Error);
  EXPECT_FALSE(std::filesystem::exists(files / "out_files"));
}

TEST(SceneExport, CopiesVolumesAndWritesThoseWithoutAFile) {
  SceneFiles files;
  files.write("in/smoke.cvol",
              "candela volume 1\ncells 1 1 1\nchannels density\ndata\n" + std::string(4, '\0'));
  files.write("in/s.json",
              R"({"candela": 1, "media": [{"name": "a/b", "type": "grid", "file": "smoke.cvol"}]})");
  Document document = files.read("in/s.json").document;
  std::filesystem::create_directory(files / "out");
  const auto copied = export_candela_json(document, files / "out/scene.json");
  ASSERT_EQ(copied.size(), 1u);
  EXPECT_EQ(files.without_folder(copied[0].to), "out/scene_files/smoke.cvol");
  std::filesystem::remove_all(files / "in");
  const auto same_values = [&](const Document& again) {
    return medium_grid(again.scene.media.at(0))->density == medium_grid(document.scene.media[0])->density;
  };
  EXPECT_TRUE(same_values(files.read("out/scene.json").document));
  // Its file is gone.
  EXPECT_TRUE(export_candela_json(document, files / "out/other.json").empty());
  EXPECT_TRUE(same_values(files.read("out/other.json").document));
  EXPECT_TRUE(std::filesystem::exists(files / "out/other_files/a_b.cvol"));
}

} // namespace
} // namespace candela
