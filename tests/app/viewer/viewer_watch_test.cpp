// A scene is read again when any of its files changes on the disk.

#include "app/harness.h"
#include "io/files/path_policy.h"
#include "support/materials.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

/// Of one colour.
void write_picture(const std::string& path, std::uint8_t value) {
  std::filesystem::remove(path);
  write_srgb8_image(2, 2, std::vector<std::uint8_t>(12, value), path);
}

void write_sky(const std::string& path, float value) {
  std::filesystem::remove(path);
  write_linear_image({2, 2, std::vector<vec3>(4, vec3(value))}, path);
}

const char* const kFaces[] = {"px.hdr", "nx.hdr", "py.hdr", "ny.hdr", "pz.hdr", "nz.hdr"};

void write_json(const std::string& path, const char* brightness) {
  std::string faces;
  for (const char* face : kFaces) faces += fmt::format("{}\"{}\"", faces.empty() ? "" : ", ", face);
  write_text(path, fmt::format(R"({{"candela": 1, "camera": {{"position": [0, 0, 5]}},
 "materials": [{{"name": "wood", "diffuse": {}, "diffuse_texture": "wood.png"}}],
 "lights": [{{"type": "environment", "file": "sky.exr"}},
            {{"type": "environment", "mapping": "faces", "files": [{}]}}],
 "instances": [{{"shape": "sphere", "material": "wood"}}, {{"file": "kite.obj"}}],
 "settings": {{"film": {{"width": 32, "height": 24}}, "stop": {{"spp": 1}}}}}})",
                               brightness, faces));
}

void write_mesh(const std::string& path, float size) {
  write_text(path, fmt::format("mtllib kite.mtl\nmtllib late.mtl\nv 0 0 0\nv {} 0 0\nv 0 1 0\nusemtl a\n"
                               "f 1 2 3\nusemtl b\nf 1 3 2\n",
                               size));
}

TEST(ViewerWatchUi, EveryKindOfFileThatASceneHasIsReadAgain) {
  ScratchFolder folder;
  write_json(folder / "scene.json", "1");
  write_picture(folder / "wood.png", 50);
  write_mesh(folder / "kite.obj", 1);
  write_text(folder / "kite.mtl", "newmtl a\nKd 0.1 0.1 0.1\nmap_Kd kite.png\n");
  write_picture(folder / "kite.png", 50);
  write_sky(folder / "sky.exr", 0.25f);
  for (const char* face : kFaces) write_sky(folder / face, 0.25f);
  ViewerHarness hand;
  hand.send(FilesDropped{{folder / "scene.json"}});
  hand.wait_until("it is open", [&] { return hand.document().scene.lights.size() == 2; });

  auto scene = [&]() -> const SceneDesc& { return hand.document().scene; };
  auto texel = [&](std::string_view name) -> int {
    for (const auto& texture : scene().textures)
      if (texture->name == name) return srgb8_texels(*texture->image()->texels)[0];
    return -1;
  };
  auto material = [&](std::string_view name) -> float {
    for (const Material& m : scene().materials)
      if (m.name == name) return color(m, "diffuse").x;
    return -1;
  };
  auto corner = [&] {
    return std::get<std::shared_ptr<const Mesh>>(scene().instances[1].shape)->positions[1].x;
  };
  struct Change {
    const char* what;
    std::function<void()> write;
    std::function<bool()> is_seen;
  };
  const Change changes[] = {
      {"the scene", [&] { write_json(folder / "scene.json", "0.5"); },
       [&] { return material("wood") == 0.5f; }},
      {"a texture", [&] { write_picture(folder / "wood.png", 99); }, [&] { return texel("wood.png") == 99; }},
      {"a mesh", [&] { write_mesh(folder / "kite.obj", 3); }, [&] { return corner() == 3; }},
      {"a library", [&] { write_text(folder / "kite.mtl", "newmtl a\nKd 0.2 0.2 0.2\nmap_Kd kite.png\n"); },
       [&] { return material("kite/a") == 0.2f; }},
      {"its texture", [&] { write_picture(folder / "kite.png", 98); },
       [&] { return texel("kite.png") == 98; }},
      {"a library that was missing", [&] { write_text(folder / "late.mtl", "newmtl b\nKd 0.3 0.3 0.3\n"); },
       [&] { return material("kite/b") == 0.3f; }},
      {"a panorama", [&] { write_sky(folder / "sky.exr", 2); },
       [&] { return light_panorama(scene().lights[0])->image.pixels[0].x == 2; }},
      {"a face of another", [&] { write_sky(folder / kFaces[4], 4); },
       [&] { return light_panorama(scene().lights[1])->image.pixels[16].x == 4; }}};
  for (const Change& change : changes) {
    EXPECT_FALSE(change.is_seen()) << change.what;
    change.write();
    hand.wait_until(change.what, change.is_seen);
    EXPECT_EQ(hand.state().error, "");
  }
}

TEST(ViewerWatchUi, APanoramaThatWasDroppedIsReplacedAndNoEditIsLost) {
  ScratchFolder folder;
  write_sky(folder / "sky.hdr", 0.25f);
  ViewerHarness hand; // of a scene without a file
  hand.send(FilesDropped{{folder / "sky.hdr"}});
  auto sky = [&]() -> const LightDesc* {
    for (const LightDesc& light : hand.document().scene.lights)
      if (light_panorama(light)) return &light;
    return nullptr;
  };
  hand.wait_until("it lights the scene", [&] { return sky() != nullptr; });
  hand.type_into("display.exposure", "1.5");
  write_sky(folder / "sky.hdr", 8);
  hand.wait_until("it is read again", [&] { return light_panorama(*sky())->image.pixels[0].x == 8; });
  EXPECT_EQ(hand.document().settings.display.exposure, 1.5f);
  EXPECT_FALSE(hand.find("question.reload"));
  EXPECT_EQ(hand.state().error, "");
  write_text(folder / "sky.hdr", "no picture");
  hand.wait_until("it is said", [&] { return !hand.state().error.empty(); });
  EXPECT_EQ(light_panorama(*sky())->image.pixels[0].x, 8) << "the old one stays";
}

void wait_for_change(const FileWatch& watch) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(240);
  while (!watch.has_change() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(FileWatch, TellsWhichOfItsFilesChangedSinceTheyWereReadOnce) {
  ScratchFolder folder;
  const std::string a = folder / "a", b = folder / "b", late = folder / "late";
  write_text(a, "1");
  write_text(b, "1");
  const FileStamps read{{a, file_stamp(a)}, {b, file_stamp(b)}, {late, file_stamp(late)}};
  write_text(a, "22"); // while the scene is still being made of what was read
  FileWatch watch({}, 0.01);
  watch.watch({a, b, late}, read);
  wait_for_change(watch);
  EXPECT_EQ(watch.take_changes(), std::set<std::string>{a});
  write_text(folder / "other", "x");
  write_text(late, "1");
  wait_for_change(watch);
  EXPECT_EQ(watch.take_changes(), std::set<std::string>{late});
  watch.watch({a, b}); // as they were last told of
  write_text(b, "22");
  watch.watch({a, b});
  wait_for_change(watch);
  EXPECT_EQ(watch.take_changes(), std::set<std::string>{b});
  write_text(a, "333"); // by ourselves
  watch.watch({a, b}, {{a, file_stamp(a)}});
  write_text(b, "333");
  wait_for_change(watch);
  EXPECT_EQ(watch.take_changes(), std::set<std::string>{b});
  EXPECT_FALSE(watch.has_change()) << "told once";
}

} // namespace
} // namespace candela::test
