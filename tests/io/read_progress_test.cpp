// Progress and cancellation of reading, in every format.

#include "io/images/image_codec.h"
#include "io/images/panorama_reader.h"
#include "io/images/texels_reader.h"
#include "io/picture_state.h"
#include "io/scene_files.h"

#include <fmt/format.h>

#include <thread>

namespace candela {
namespace {

using test::SceneFiles;

ReadOptions cancelled() {
  ReadOptions options;
  options.progress->cancel();
  return options;
}

const char* const kSmallObj = "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const char* const kSmallXml = R"(<scenefile><object type="tree" name="root"><transblock>
  <object type="primitive" name="mesh" filename="m.obj"/></transblock></object></scenefile>)";
const char* const kSmallJson = R"({"candela": 1, "lights": [{"type": "environment", "file": "sky.hdr"}],
  "materials": [{"name": "m", "diffuse_texture": "t.png"}],
  "meshes": {"m": {"file": "m.obj"}, "k": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]]}},
  "instances": [{"mesh": "m", "material": "m"}, {"mesh": "k"}]})";

/// One scene in every format, and every format of pictures.
struct ReadProgressTest : testing::Test {
  SceneFiles files;

  ReadProgressTest() {
    files.write("m.obj", kSmallObj);
    files.write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd t.png\n");
    files.write("a.xml", kSmallXml);
    files.write("a.json", kSmallJson);
    files.write("a.ini",
                "[IO]\nscene = a.xml\noutput = out.png\n[Settings]\nimageWidth = 4\nimageHeight = 4\n");
    const Image image{16, 300, std::vector<vec3>(16 * 300, vec3(0.5f))};
    const std::vector<std::uint8_t> rgb(16 * 300 * 3, 99);
    for (const char* name : {"sky.hdr", "sky.exr", "sky.pfm"}) write_linear_image(image, files / name);
    for (const char* name : {"t.png", "t.jpg", "t.ppm"}) write_srgb8_image(16, 300, rgb, files / name);
    for (const char* name : {"state.png", "state.exr"}) {
      const ImageMetadata texts = picture_state_texts({files.read("a.json").document, 1, {}}, files / name);
      if (is_linear_format(image_format_of(name)))
        write_linear_image(image, files / name, texts);
      else
        write_srgb8_image(16, 300, rgb, files / name, texts);
    }
  }
};

TEST_F(ReadProgressTest, CancelledNoSceneIsRead) {
  for (const char* name : {"a.json", "a.xml", "a.ini", "m.obj", "state.png", "state.exr"}) {
    EXPECT_NO_THROW(files.read(name)) << name;
    EXPECT_THROW(files.read(name, cancelled()), Cancelled) << name;
  }
}

TEST_F(ReadProgressTest, CancelledNoPictureIsDecoded) {
  for (const char* name : {"sky.hdr", "sky.exr", "sky.pfm", "t.png", "t.jpg", "t.ppm"}) {
    const std::string path = files / name;
    WarningList go, stop(cancelled().progress);
    EXPECT_NO_THROW(read_panorama(std::span(&path, 1), go)) << name;
    EXPECT_THROW(read_panorama(std::span(&path, 1), stop), Cancelled) << name;
    EXPECT_THROW(read_texels(path, stop), Cancelled) << name;
  }
}

// Between rows, that is, also once the file is in memory.
TEST_F(ReadProgressTest, LargeDecodersEndBetweenRows) {
  for (const char* name : {"sky.hdr", "sky.exr", "sky.pfm", "t.jpg", "t.ppm"}) {
    const Bytes bytes = read_file_bytes(files / name, "image");
    Progress progress;
    progress.expect(1000000);
    {
      ProgressPart part(progress, 1000000);
      decode_image(bytes, {name}, &part);
      EXPECT_GT(progress.share(), 0.8) << name << ": it tells how far it is";
      progress.cancel();
      EXPECT_THROW(decode_image(bytes, {name}, &part), Cancelled) << name;
    }
  }
}

TEST_F(ReadProgressTest, ShareEndsAtOneWhenAllIsRead) {
  for (const char* name : {"a.json", "a.xml", "a.ini", "m.obj", "state.png", "state.exr"}) {
    ReadOptions options;
    files.read(name, options);
    EXPECT_EQ(options.progress->share(), 1) << name;
  }
}

/// Cancels as soon as the progress is above `at`; returns the progress at the end, or nothing if reading had
/// finished.
std::optional<double> cancel_meanwhile(const std::string& path, double at) {
  ReadOptions options;
  std::atomic<bool> over{false};
  std::thread hand([&, progress = options.progress] {
    while (progress->share() <= at && !over) std::this_thread::yield();
    progress->cancel();
  });
  bool ended_early = false;
  try {
    read_scene(path, options);
  } catch (const Cancelled&) { ended_early = true; }
  over = true;
  hand.join();
  return ended_early ? std::optional(options.progress->share()) : std::nullopt;
}

/// Repeated if the file is read before the cancellation.
bool can_be_cancelled(const std::string& path, double at) {
  for (int attempt = 0; attempt < 50; ++attempt)
    if (cancel_meanwhile(path, at)) return true;
  return false;
}

TEST_F(ReadProgressTest, LargeFilesAreGivenUpMeanwhile) {
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", positions, triangles, objects;
  for (int i = 0; i < 100000; ++i) {
    obj += "f 1 2 3\n";
    positions += fmt::format("{}[{}, 0.5, 1]", i ? "," : "", i);
    triangles += fmt::format("{}[{}, 0, 1]", i ? "," : "", i);
    objects += "<transblock><object type=\"primitive\" name=\"cube\"/></transblock>";
  }
  files.write("large.obj", obj);
  files.write("mesh.json", fmt::format("{{\"candela\": 1, \"meshes\": {{\"m\": {{\"positions\": [{}], "
                                       "\"triangles\": [{}]}}}}, \"instances\": [{{\"mesh\": \"m\"}}]}}",
                                       positions, triangles));
  files.write("large.xml",
              fmt::format("<scenefile><object type=\"tree\" name=\"root\">{}</object></scenefile>", objects));
  for (double at : {0.1, 0.8}) EXPECT_TRUE(can_be_cancelled(files / "large.obj", at)) << at;
  for (double at : {0.1, 0.69}) EXPECT_TRUE(can_be_cancelled(files / "mesh.json", at)) << at;
  EXPECT_TRUE(can_be_cancelled(files / "large.xml", 0.4));
}

// A scene's files are known before the first is read: half of the bytes are half of the progress.
TEST_F(ReadProgressTest, FilesThatAreNamedCountBeforeTheyAreRead) {
  auto watched = std::make_shared<Progress>();
  WarningList list(watched);
  list.expect_file(files / "t.png");
  list.expect_file(files / "t.png");
  list.expect_file(files / "sky.hdr");
  list.expect_file(files / "missing.png");
  const auto size = [&](const char* name) {
    return static_cast<double>(std::filesystem::file_size(files / name));
  };
  read_texels(files / "t.png", list);
  EXPECT_DOUBLE_EQ(watched->share(), size("t.png") / (size("t.png") + size("sky.hdr")));
  const std::string sky = files / "sky.hdr";
  read_panorama(std::span(&sky, 1), list);
  EXPECT_EQ(watched->share(), 1);
}

} // namespace
} // namespace candela
