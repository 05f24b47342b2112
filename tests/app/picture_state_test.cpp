// Pictures with a state are rendered again, bit for bit.

#include "app/viewer/picture_saver.h"
#include "io/images/image_file.h"
#include "io/scene_reader.h"
#include "session/offline_render.h"
#include "support/materials.h"
#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace candela {
namespace {

using test::color;

namespace fs = std::filesystem;

int run(const std::string& arguments) {
  return std::system(fmt::format("'{}' {} --quiet", CANDELA_PROGRAM, arguments).c_str());
}

TEST(PictureStateRender, EveryShippedSceneIsMadeAgain) {
  test::ScratchFolder scratch;
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(CANDELA_TEST_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".json" ||
        test::read_text(entry.path().string()).find("\"candela\"") == std::string::npos)
      continue;
    ++scenes;
    const std::string edits =
        "--size 32x20 --spp 3 --seed 5 --set camera.vertical_fov=33.3 --set display.exposure=0.3 "
        "--set path.max_depth=6 --set display.tone_map=filmic";
    ASSERT_EQ(run(fmt::format("render '{}' {} -o '{}' -o '{}'", entry.path().string(), edits,
                              scratch / "a.png", scratch / "a.exr")),
              0);
    // The metadata is the same, too, since the files are equal.
    for (const char* ending : {"png", "exr"}) {
      const std::string first = scratch / fmt::format("a.{}", ending),
                        again = scratch / fmt::format("b.{}", ending);
      ASSERT_EQ(run(fmt::format("render '{}' -o '{}'", first, again)), 0);
      EXPECT_TRUE(test::read_text(again) == test::read_text(first)) << entry.path() << " " << ending;
    }
  }
  EXPECT_GE(scenes, 6);
}

TEST(PictureStateRender, CropsAndDenoisedPicturesAreMadeAgain) {
  test::ScratchFolder scratch;
  const std::string scene = std::string(CANDELA_TEST_SOURCE_DIR) + "/scenes/cornell_box.json";
  for (const char* how : {"--crop 5,2,10,6", "--set display.denoise=true"}) {
    ASSERT_EQ(run(fmt::format("render '{}' --size 32x20 --spp 4 {} -o '{}'", scene, how, scratch / "a.png")),
              0);
    ASSERT_EQ(run(fmt::format("render '{}' -o '{}'", scratch / "a.png", scratch / "b.png")), 0);
    EXPECT_TRUE(test::read_text(scratch / "b.png") == test::read_text(scratch / "a.png")) << how;
  }
  ASSERT_EQ(run(fmt::format("render '{}' --size 8x8 --spp 1 --no-state -o '{}'", scene, scratch / "c.png")),
            0);
  EXPECT_NE(run(fmt::format("render '{}' -o '{}' 2>/dev/null", scratch / "c.png", scratch / "d.png")), 0);
}

// Pictures saved in the window, after edits.
TEST(PictureStateRender, ScreenshotsAreMadeAgain) {
  test::ScratchFolder scratch;
  Document document =
      read_scene(std::string(CANDELA_TEST_SOURCE_DIR) + "/scenes/cornell_spheres.json").document;
  document.settings.film.width = 40;
  document.settings.film.height = 30;
  document.settings.stop.spp = 2;
  RenderSession session;
  auto wait = [&] { ASSERT_TRUE(session.wait_finished(120)); };
  session.submit(document);
  wait();
  document.scene.camera.position.x += 0.1f;
  color(document.scene.materials[0], "diffuse") = {0.2f, 0.3f, 0.4f};
  document.settings.path.max_depth = 4;
  session.submit(document);
  wait();
  document.settings.stop.spp = 5;
  document.settings.display.exposure = 1.5f;
  for (bool denoise : {false, true}) {
    document.settings.display.denoise = denoise;
    session.submit(document);
    wait();
    const SavedPicture saved = save_picture(*session.display(), scratch.path(), "shot");
    for (const fs::path& file : {saved.png, saved.exr}) {
      LoadedScene loaded = read_scene(file.string());
      EXPECT_TRUE(same_content(loaded.document, document)) << file;
      const std::string again = scratch / ("again" + file.extension().string());
      ASSERT_EQ(run(fmt::format("render '{}' -o '{}'", file.string(), again)), 0);
      EXPECT_TRUE(test::read_text(again) == test::read_text(file.string()))
          << file << " denoised " << denoise;
    }
  }
}

} // namespace
} // namespace candela
