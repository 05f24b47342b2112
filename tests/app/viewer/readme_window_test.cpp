// The picture of the window in the README: `ctest --preset heavy -R ReadmeWindow` leaves it as
// screenshots/window.png.

#include "app/harness.h"
#include "io/scene_reader.h"

namespace candela::test {
namespace {

TEST(ReadmeWindowHeavy, LeavesAConvergedPicture) {
  Document document =
      read_scene(std::string(CANDELA_TEST_SOURCE_DIR) + "/scenes/depth_of_field.json").document;
  document.settings.stop = {};
  document.settings.stop.spp = 256;
  ViewerHarness hand(document, {.size = {1280, 720}, .fit_film = true});
  hand.wait_for_picture(3000);
  hand.frame(3, 11); // past the hints
  EXPECT_EQ(hand.viewer.session().status().phase, SessionPhase::finished);
  EXPECT_EQ(hand.viewer.session().status().nonfinite, 0u);
  hand.screenshot("window");
}

} // namespace
} // namespace candela::test
