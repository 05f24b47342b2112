#include "core/error.h"
#include "io/picture_state.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace candela {
namespace {

using test::color;

namespace fs = std::filesystem;

class PictureStateTest : public testing::Test {
protected:
  test::ScratchFolder scratch;
  std::string path(const std::string& name) { return scratch / name; }

  /// Saves a picture of 2x2 pixels in the format of its name.
  static void save(const std::string& file, const ImageMetadata& texts) {
    if (is_linear_format(image_format_of(file)))
      write_linear_image({2, 2, std::vector<vec3>(4, vec3(0.5f))}, file, texts);
    else
      write_srgb8_image(2, 2, std::vector<std::uint8_t>(12, 99), file, texts);
  }
  static std::string message_of(const std::string& file, const ReadOptions& options = {}) {
    try {
      read_scene(file, options);
    } catch (const Error& error) { return error.what(); }
    return "";
  }
  /// A triangle with a texture of one texel, in two files of the folder.
  void write_textured_scene(const std::string& folder) {
    fs::create_directories(path(folder));
    write_srgb8_image(1, 1, std::vector<std::uint8_t>{10, 20, 30}, path(folder + "/t.png"));
    test::write_text(path(folder + "/m.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    test::write_text(path(folder + "/s.json"), R"({"candela": 1, "lights": [{"type": "constant"}],
      "materials": [{"name": "m", "diffuse_texture": "t.png"}], "meshes": {"m": {"file": "m.obj"}},
      "instances": [{"mesh": "m", "material": "m"}]})");
  }
};

TEST_F(PictureStateTest, PngAndExrHoldTheWholeDocument) {
  Document document = test::cornell_flush(20, 10, 7, true).document;
  document.scene.camera.position.x += 0.123456f;
  color(document.scene.materials[0], "diffuse") = {0.1f, 1 / 3.0f, 0.7f};
  document.settings.path.max_depth = 5;
  document.settings.display.exposure = 0.7f;
  document.settings.sampler.seed = 12345;
  document.settings.stop.time = 3;
  for (const char* name : {"a.png", "a.exr"}) {
    save(path(name), picture_state_texts({document, 11, {}}, path(name)));
    LoadedScene loaded = read_scene(path(name));
    Document expected = document;
    expected.settings.stop = {};
    expected.settings.stop.spp = 11;
    EXPECT_TRUE(same_content(loaded.document, expected)) << name;
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_FALSE(loaded.crop);
  }
}

TEST_F(PictureStateTest, RemembersTheCrop) {
  Document document = test::cornell_flush(20, 10, 1, true).document;
  const PictureCrop crop{5, 2, 10, 8};
  save(path("a.png"), picture_state_texts({document, 1, crop}, path("a.png")));
  EXPECT_EQ(read_scene(path("a.png")).crop, crop);
  for (const char* bad : {"", "1", "1,2,3", "1,2,3,", "1,2,3,4,", "0,0,21,1", "-1,0,2,2", "0,0,0,1",
                          "15,0,6,1", "0,0,1,99999999999", "2147483647,0,2147483647,1", "a,b,c,d"}) {
    ImageMetadata texts = picture_state_texts({document, 1, crop}, path("b.png"));
    texts["candela.crop"] = bad;
    save(path("b.png"), texts);
    EXPECT_NE(message_of(path("b.png")).find("part of the film"), std::string::npos) << bad;
  }
}

TEST_F(PictureStateTest, APictureWithoutAStateIsAnErrorWithARemedy) {
  for (const char* name : {"a.png", "a.exr"}) {
    save(path(name), {{"candela.version", "0"}});
    const std::string message = message_of(path(name));
    EXPECT_NE(message.find(path(name) + ": picture: it holds no scene: "), std::string::npos) << message;
  }
  test::write_text(path("text.png"), "no picture");
  EXPECT_NE(message_of(path("text.png")).find("neither PNG nor EXR"), std::string::npos);
}

TEST_F(PictureStateTest, DamagedStatesAreLocated) {
  save(path("a.png"), {{"candela.scene", "{\n  \"candela\": 1,\n  \"camara\": {}\n}"}});
  EXPECT_NE(message_of(path("a.png")).find("a.png:3:"), std::string::npos) << message_of(path("a.png"));
  save(path("b.png"), {{"candela.scene", "{\"candela\": 1}"}, {"candela.files", "[{\"path\": 3}]"}});
  EXPECT_NE(message_of(path("b.png")).find("candela.files"), std::string::npos) << message_of(path("b.png"));
}

TEST_F(PictureStateTest, NoticesFilesThatChanged) {
  write_textured_scene("scene");
  LoadedScene loaded = read_scene(path("scene/s.json"));
  save(path("a.png"), picture_state_texts({loaded.document, 1, {}}, path("a.png")));
  EXPECT_TRUE(read_scene(path("a.png")).warnings.empty());
  write_srgb8_image(1, 1, std::vector<std::uint8_t>{10, 20, 31}, path("scene/t.png"));
  const auto warnings = read_scene(path("a.png")).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("scene/t.png is not what it was"), std::string::npos) << warnings[0].text;
  fs::remove(path("scene/t.png"));
  EXPECT_NE(message_of(path("a.png")).find("there is no file"), std::string::npos);
}

// The picture is next to the scene's folder, not above it.
TEST_F(PictureStateTest, OpensOutsideOfItsFolderOnlyWhatItKnows) {
  write_textured_scene("scene");
  fs::create_directories(path("pictures"));
  LoadedScene loaded = read_scene(path("scene/s.json"));
  save(path("pictures/a.png"), picture_state_texts({loaded.document, 1, {}}, path("pictures/a.png")));
  loaded.document.settings.stop = {};
  loaded.document.settings.stop.spp = 1;
  EXPECT_TRUE(same_content(read_scene(path("pictures/a.png")).document, loaded.document));
  write_srgb8_image(1, 1, std::vector<std::uint8_t>{10, 20, 31}, path("scene/t.png"));
  EXPECT_NE(message_of(path("pictures/a.png")).find("outside"), std::string::npos);
  EXPECT_EQ(message_of(path("pictures/a.png"), {true}), "");
}

} // namespace
} // namespace candela
