// Panoramas in the window: dropped, opened by path, rotated.

#include "app/harness.h"
#include "support/materials.h"

namespace {

using namespace candela;
using namespace candela::test;

/// A picture with a bright spot, as a file.
std::string write_sky(const ScratchFolder& folder, const std::string& name, int width, int height) {
  Image image{width, height,
              std::vector<vec3>(static_cast<std::size_t>(width * height), vec3(0.3f, 0.5f, 0.9f))};
  image.at(width / 3, height / 3) = vec3(200, 170, 120);
  write_linear_image(image, folder / name);
  return folder / name;
}

Document ball_on_a_plane() {
  Document document;
  document.scene.materials.resize(1);
  color(document.scene.materials[0], "diffuse") = vec3(0.6f);
  document.scene.instances.push_back({"ball", SphereShape{1}, mat4(1), {0}});
  document.scene.instances.push_back(
      {"floor",
       PlaneShape{},
       glm::rotate(glm::translate(mat4(1), {0, -1, 0}), -kPi / 2, vec3(1, 0, 0)),
       {0}});
  document.settings.film.width = 64;
  document.settings.film.height = 48;
  document.settings.stop.spp = 8;
  return document;
}

TEST(ViewerEnvironmentUi, ADroppedPictureLightsTheScene) {
  ScratchFolder folder;
  ViewerHarness hand(ball_on_a_plane());
  hand.wait_for_picture();
  const std::string sky = write_sky(folder, "sky.hdr", 32, 16);
  hand.send(FilesDropped{{sky}});
  hand.wait_until("the light is there", [&] { return !hand.document().scene.lights.empty(); });
  EXPECT_EQ(hand.state().error, "");
  EXPECT_EQ(hand.state().scene_path, "") << "the scene stays";
  ASSERT_EQ(hand.document().scene.lights.size(), 1u);
  auto environment = [&] {
    return std::get<EnvironmentLightModel>(hand.document().scene.lights.at(0).model);
  };
  const EnvironmentLightModel first = environment();
  EXPECT_EQ(first.mapping, EnvironmentMapping::latlong);
  ASSERT_TRUE(first.panorama);
  EXPECT_EQ(first.panorama->sources, std::vector<std::string>{sky});
  hand.unfold("panel.lights", "light.rotation");
  hand.type_into("light.rotation", "90");
  EXPECT_NEAR(environment().rotation, kPi / 2, 1e-6f);
  hand.wait_for_picture();
  hand.reveal("light.file");
  hand.frame(3);
  hand.screenshot("environment_light");
  double sum = 0;
  for (vec3 pixel : hand.viewer.viewport().shown()->frame->linear) sum += static_cast<double>(pixel.y);
  EXPECT_GT(sum, 0);

  // Another one, by its path; it replaces the first, with its own mapping.
  hand.click("light.file");
  const std::string ball = write_sky(folder, "ball.pfm", 21, 21);
  hand.type(ball);
  hand.click("light.open");
  hand.wait_until("the panorama is another",
                  [&] { return environment().panorama->sources != first.panorama->sources; });
  EXPECT_EQ(environment().mapping, EnvironmentMapping::angular);
  EXPECT_EQ(hand.document().scene.lights.size(), 1u);
  EXPECT_NEAR(environment().rotation, kPi / 2, 1e-6f) << "as it was turned";
}

TEST(ViewerEnvironmentUi, ADamagedPictureIsAnError) {
  ScratchFolder folder;
  write_text(folder / "sky.exr", "no picture");
  ViewerHarness hand(ball_on_a_plane());
  hand.send(FilesDropped{{folder / "sky.exr"}});
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  EXPECT_NE(hand.state().error.find("sky.exr"), std::string::npos) << hand.state().error;
  EXPECT_TRUE(hand.document().scene.lights.empty());
}

} // namespace
