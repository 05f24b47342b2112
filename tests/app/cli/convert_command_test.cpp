// `candela convert`: the converted scene renders to the same bits.

#include "app/cli/convert_command.h"
#include "core/error.h"
#include "render/film/render_pass.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace candela;
using namespace candela::test;
namespace fs = std::filesystem;

Film small_picture(Document document) {
  document.settings.film.width = document.settings.film.height = 24;
  document.settings.sampler.seed = 7;
  Film film(24, 24);
  std::atomic<bool> stop{false};
  auto scene = RenderScene::build(document);
  EXPECT_TRUE(render_pass(*scene, document, {0, 2}, film, stop).completed);
  return film;
}

void expect_same_picture(const std::string& path, bool outside = false) {
  SCOPED_TRACE(path);
  ScratchFolder folder;
  std::string out = folder / "converted.json";
  SceneOptions options;
  options.path = path;
  options.allow_outside = outside;
  ASSERT_EQ(run_convert(options, out), 0);
  Film before = small_picture(read_scene(path, {outside}).document);
  Film after = small_picture(read_scene(out).document); // with nothing from outside
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) ASSERT_EQ(before.mean(x, y), after.mean(x, y)) << x << ", " << y;
}

TEST(ConvertRender, ShippedScenes) {
  for (const auto& entry : fs::directory_iterator(CANDELA_TEST_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".json" && entry.path().stem() != "gallery") // that is a list of figures
      expect_same_picture(entry.path().string());
}

TEST(ConvertRender, Cs123ScenesJobsAndMeshes) {
  const fs::path data = CANDELA_SHARED_DATA;
  if (!fs::exists(data / "cs123")) GTEST_SKIP() << "there is no " << data / "cs123";
  for (const auto& entry : fs::directory_iterator(data / "cs123"))
    if (entry.path().extension() == ".xml") expect_same_picture(entry.path().string());
  for (const auto& entry : fs::directory_iterator(data / "cs123/template_inis/final"))
    if (entry.path().extension() == ".ini") expect_same_picture(entry.path().string(), true);
  expect_same_picture((data / "meshes/spot.obj").string());
}

TEST(ConvertRender, LightsAndPrimitivesOfCs123AndPanoramas) {
  ScratchFolder folder;
  write_text(folder / "a.xml", R"(<scenefile><cameradata><pos x="3" y="3" z="5"/><focus x="0" y="0" z="0"/>
    <up x="0" y="1" z="0"/><heightangle v="40"/></cameradata>
    <lightdata><type v="spot"/><position x="0" y="4" z="1"/><direction x="0" y="-1" z="-.3"/><angle v="33"/>
    <penumbra v="7"/><color r="30" g="20" b="9"/></lightdata>
    <lightdata><type v="area"/><position x="0" y="4" z="0"/><direction x=".1" y="-1" z="0"/><color r="3" g="2" b="9"/>
    </lightdata><lightdata><position x="1" y="3" z="1"/><function a="1" b=".3" c=".1"/><color r="1" g="1" b="1"/></lightdata>
    <object type="tree" name="root">
    <transblock><object type="primitive" name="cube"/></transblock>
    <transblock><translate x="1" y="0.3" z="0"/><rotate x="1" y="1" z="0" angle="31"/><object type="primitive" name="cone"/></transblock>
    <transblock><translate x="-1" y="0" z=".1"/><object type="primitive" name="cylinder"><diffuse r=".3" g=".4" b=".5"/></object></transblock>
    <transblock><translate x="0" y="0" z="1"/><object type="primitive" name="torus"/></transblock>
    </object></scenefile>)");
  expect_same_picture(folder / "a.xml");
  std::string sky = CANDELA_SHARED_DATA "/common/textures/museum.exr";
  if (!fs::exists(sky)) GTEST_SKIP() << "there is no " << sky;
  fs::create_directory(folder / "sky");
  fs::copy(sky, folder / "sky/museum.exr");
  write_text(folder / "b.json", R"({"candela": 1, "lights": [{"type": "environment", "file": "sky/museum.exr",
    "rotation": 33.3, "up": [0.1, 1, 0]}], "instances": [{"shape": "torus", "minor_radius": 0.3}, {"shape": "plane"}]})");
  expect_same_picture(folder / "b.json");
}

TEST(ConvertCommand, RefusesOtherEndingsAndTheSceneItself) {
  ScratchFolder folder;
  write_text(folder / "s.json", "{\"candela\": 1}");
  SceneOptions options;
  options.path = folder / "s.json";
  auto refused = [&](const std::string& output) {
    try {
      run_convert(options, output);
    } catch (const Error& e) { return e.code() == ExitCode::usage; }
    return false;
  };
  EXPECT_TRUE(refused(folder / "out.obj"));
  EXPECT_TRUE(refused(folder / "./s.json"));
  EXPECT_EQ(read_text(folder / "s.json"), "{\"candela\": 1}");
}

} // namespace
