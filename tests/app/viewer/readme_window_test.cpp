// The picture of the window in the README: `ctest --preset heavy -R ReadmeWindow` writes it to
// screenshots/window.png.

#include "app/harness.h"
#include "io/scene_reader.h"

#include <chrono>

namespace candela::test {
namespace {

TEST(ReadmeWindowHeavy, LeavesAConvergedPicture) {
  const std::string scene = std::string(CANDELA_TEST_SOURCE_DIR) + "/scenes/depth_of_field.json";
  Document document = read_scene(scene).document;
  document.settings.stop = {};
  document.settings.stop.spp = 256;
  ViewerHarness hand(document, {.size = {1280, 720}, .fit_film = true, .scene_path = scene});
  // Frame by frame like a window, so that the displayed latencies are realistic.
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(50);
  while (!hand.viewer.session().wait_finished(0.03)) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    hand.frame();
  }
  hand.frame(3, 11); // past the hints
  EXPECT_EQ(hand.viewer.session().status().phase, SessionPhase::finished);
  EXPECT_EQ(hand.viewer.session().status().nonfinite, 0u);
  hand.screenshot("window");
}

} // namespace
} // namespace candela::test
