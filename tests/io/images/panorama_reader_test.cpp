// Panoramas from files: reading, corrections, errors.

#include "io/images/image_file.h"
#include "io/images/panorama_reader.h"
#include "io/scene_files.h"

namespace candela {
namespace {

using test::SceneFiles;
using enum EnvironmentMapping;

Image grey(int width, int height, float value = 1) {
  return {width, height, std::vector<vec3>(static_cast<std::size_t>(width * height), vec3(value))};
}

struct PanoramaReader : ::testing::Test {
  SceneFiles files;
  WarningList warnings;

  std::shared_ptr<const Panorama> read(std::initializer_list<const char*> names) {
    std::vector<std::string> paths;
    for (const char* name : names) paths.push_back(files / name);
    return read_panorama(paths, warnings);
  }
};

TEST_F(PanoramaReader, CorrectsWhatCannotBeRadiance) {
  Image image = grey(2, 1);
  image.pixels = {{-1, kInfinity, NAN}, {1, 2e9f, 3}};
  write_linear_image(image, files / "sky.pfm");
  auto sky = read({"sky.pfm"});
  EXPECT_EQ(sky->name, "sky.pfm");
  EXPECT_EQ(sky->image.pixels, (std::vector<vec3>{{0, 1e9f, 0}, {1, 1e9f, 3}}));
  ASSERT_EQ(warnings.warnings().size(), 3u);
  EXPECT_TRUE(
      test::says(files.without_folder(warnings.warnings()[0].text), "sky.pfm: 1 values are infinite"));
  EXPECT_TRUE(
      test::says(files.without_folder(warnings.warnings()[1].text), "sky.pfm: 1 values are not numbers"));
  EXPECT_TRUE(test::says(files.without_folder(warnings.warnings()[2].text), "sky.pfm: values below 0"));
}

// An infinite half only means a value above 65504.
TEST_F(PanoramaReader, InfinityIsMoreThanAHalfHolds) {
  Image image = grey(2, 1);
  image.pixels = {{kInfinity, 1, 1}, {836, -kInfinity, 3}};
  write_linear_image(image, files / "sky.pfm");
  EXPECT_EQ(read({"sky.pfm"})->image.pixels, (std::vector<vec3>{{65504, 1, 1}, {836, 0, 3}}));
  image.pixels[1].x = 1e6f;
  write_linear_image(image, files / "brighter.pfm");
  EXPECT_EQ(read({"brighter.pfm"})->image.pixels[0].x, 1e6f) << "nor less than what is finite beside it";
}

TEST_F(PanoramaReader, StacksFacesInTheirOrder) {
  for (int i = 0; i < 6; ++i)
    write_linear_image(grey(3, 3, static_cast<float>(i)), files / (std::to_string(i) + ".pfm"));
  auto cube = read({"0.pfm", "1.pfm", "2.pfm", "3.pfm", "4.pfm", "5.pfm"});
  ASSERT_EQ(cube->image.height, 18);
  for (int y = 0; y < 18; ++y) {
    const int face = y / 3;
    EXPECT_EQ(cube->image.at(2, y), vec3(static_cast<float>(face)));
  }
  EXPECT_EQ(cube->sources.size(), 6u);
  EXPECT_TRUE(warnings.warnings().empty());
}

TEST_F(PanoramaReader, RefusesFacesOfDifferentSizesAndTooManyPixels) {
  write_linear_image(grey(3, 3), files / "a.pfm");
  write_linear_image(grey(2, 3), files / "b.pfm");
  write_linear_image(grey(1, 11000), files / "high.pfm");
  auto message = [&](std::initializer_list<const char*> names, ExitCode code) -> std::string {
    try {
      read(names);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), code);
      return files.without_folder(e.what());
    }
    return "no error";
  };
  EXPECT_TRUE(test::says(message({"a.pfm", "a.pfm", "b.pfm", "a.pfm", "a.pfm", "a.pfm"}, ExitCode::bad_input),
                         "b.pfm: panorama: 2 x 3 pixels", {"3 x 3", "one size"}));
  EXPECT_TRUE(test::says(message({"high.pfm", "a.pfm", "a.pfm", "a.pfm", "a.pfm", "a.pfm"}, ExitCode::limit),
                         "high.pfm: "));
  EXPECT_TRUE(test::says(message({"none.hdr"}, ExitCode::bad_input), "none.hdr: "));
}

TEST_F(PanoramaReader, KnowsMappingsByTheirProportions) {
  EXPECT_EQ(likely_mapping(grey(4, 2)), latlong);
  EXPECT_EQ(likely_mapping(grey(5, 5)), angular);
  EXPECT_EQ(likely_mapping(grey(8, 6)), cross);
  EXPECT_EQ(likely_mapping(grey(6, 8)), cross);
  EXPECT_EQ(likely_mapping(grey(2, 12)), faces);
  EXPECT_EQ(likely_mapping(grey(7, 3)), latlong);
  files.write("s.json",
              R"({"candela": 1, "lights": [{"type": "environment", "mapping": "cross", "file": "a.pfm"}]})");
  write_linear_image(grey(3, 3), files / "a.pfm");
  auto loaded = files.read("s.json");
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(test::says(files.warnings(loaded)[0], "1 x s.json:1:79: a cross has the proportions 4 : 3"));
}

TEST_F(PanoramaReader, BecomesTheSky) {
  auto sky = std::make_shared<Panorama>();
  sky->image = grey(3, 3);
  SceneDesc scene;
  EXPECT_EQ(set_environment(scene, sky), 0u);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(light_panorama(scene.lights[0]), sky);
  EXPECT_EQ(std::get<EnvironmentLightModel>(scene.lights[0].model).mapping, angular);
  scene.lights.insert(scene.lights.begin(), LightDesc{});
  std::get<EnvironmentLightModel>(scene.lights[1].model).rotation = 2;
  EXPECT_EQ(set_environment(scene, sky), 1u) << "the environment that is there";
  EXPECT_EQ(std::get<EnvironmentLightModel>(scene.lights[1].model).rotation, 2);
  scene.lights[1].model = ConstantLightModel{};
  scene.lights[1].color = {0.5f, 0.6f, 1};
  EXPECT_EQ(set_environment(scene, sky), 1u) << "or a constant light gives its place";
  EXPECT_EQ(scene.lights[1].color, vec3(1));
  EXPECT_EQ(scene.lights.size(), 2u);
}

} // namespace
} // namespace candela
