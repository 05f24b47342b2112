// The panel of media in the window.

#include "app/harness.h"
#include "support/materials.h"

namespace {

using namespace candela;
using namespace candela::test;

/// A ball of glass in the room.
Document glass_ball() {
  Document document = test_document();
  Instance ball;
  ball.name = "ball";
  ball.shape = SphereShape{0.4f};
  ball.materials = {static_cast<int>(document.scene.materials.size())};
  document.scene.materials.push_back(material_of_type("dielectric"));
  document.scene.instances.insert(document.scene.instances.begin(), ball);
  return document;
}

TEST(ViewerMediaUi, AFogIsAddedAndFillsTheScene) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.unfold("panel.media", "media.add");
  EXPECT_FALSE(hand.find("scene.medium"));
  hand.choose("media.add", "fog");
  ASSERT_EQ(hand.document().scene.media.size(), 1u);
  hand.choose("scene.medium", "fog");
  EXPECT_EQ(hand.document().scene.medium, "fog");
  hand.click("medium.name");
  hand.key_down(Key::left_control), hand.key(Key::a), hand.key_up(Key::left_control);
  hand.type("mist");
  hand.key(Key::enter);
  hand.frame(2);
  EXPECT_EQ(hand.document().scene.media[0].name, "mist");
  EXPECT_EQ(hand.document().scene.medium, "mist");
  hand.choose("phase.type", "henyey_greenstein");
  hand.type_into("phase.g", "0.5");
  EXPECT_EQ(std::get<HenyeyGreensteinPhase>(hand.document().scene.media[0].phase.model).g, 0.5f);
  hand.choose("medium.type", "measured");
  hand.choose("medium.material", "ketchup");
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().error, "");
  hand.screenshot("media_panel");
  hand.reveal("media.remove");
  hand.click("media.remove");
  EXPECT_TRUE(hand.document().scene.media.empty());
  EXPECT_EQ(hand.document().scene.medium, "");
  hand.wait_for_picture();
}

TEST(ViewerMediaUi, TheSelectedObjectIsFilled) {
  ViewerHarness hand(glass_ball());
  hand.wait_for_picture();
  hand.unfold("panel.objects", "list.objects");
  hand.click("objects/0");
  hand.frame(2);
  hand.unfold("panel.media", "media.add");
  hand.choose("media.add", "milk");
  hand.reveal("media.fill");
  hand.click("media.fill");
  EXPECT_EQ(hand.document().scene.materials.back().medium, "milk");
  EXPECT_EQ(hand.state().notice, "");
  hand.wait_for_picture();
}

} // namespace
