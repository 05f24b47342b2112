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

TEST(ViewerMediaUi, ADroppedVolumeFillsTheSceneThenTheSelectedMedium) {
  ScratchFolder folder;
  const auto volume = [](float density) {
    return "candela volume 1\ncells 1 1 1\nbounds 0 0 0 1 2 3\nchannels density\ndata\n" +
           std::string(reinterpret_cast<const char*>(&density), sizeof(density));
  };
  write_text(folder / "smoke.cvol", volume(1));
  write_text(folder / "other.cvol", volume(2));
  write_text(folder / "bad.cvol", "candela volume 1\n");
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.send(FilesDropped{{folder / "smoke.cvol"}});
  hand.wait_until("it is there", [&] { return !hand.document().scene.media.empty(); });
  const auto medium = [&]() -> const MediumDesc& { return hand.document().scene.media.at(0); };
  EXPECT_EQ(medium().name, "smoke");
  EXPECT_EQ(hand.document().scene.medium, "smoke");
  ASSERT_TRUE(medium_grid(medium()));
  EXPECT_EQ(medium_grid(medium())->density.at(0), 1);
  hand.unfold("panel.media", "media.add");
  hand.reveal("medium.box");
  hand.frame(3);
  hand.screenshot("volume_medium");
  hand.click("medium.box");
  hand.frame(2);
  EXPECT_EQ(std::get<GridMediumModel>(medium().model).size, vec3(1, 2, 3));
  EXPECT_EQ(std::get<GridMediumModel>(medium().model).center, vec3(0.5f, 1, 1.5f));
  hand.send(FilesDropped{{folder / "other.cvol"}});
  hand.wait_until("the other", [&] { return medium_grid(medium())->density.at(0) == 2; });
  EXPECT_EQ(hand.document().scene.media.size(), 1u);
  EXPECT_EQ(std::get<GridMediumModel>(medium().model).size, vec3(1, 2, 3)) << "its place stays";
  hand.send(FilesDropped{{folder / "bad.cvol"}});
  hand.wait_until("the error", [&] { return !hand.state().error.empty(); });
  EXPECT_NE(hand.state().error.find("bad.cvol:1: header: "), std::string::npos) << hand.state().error;
  // A file that changes is read again.
  write_text(folder / "other.cvol", volume(3) + "");
  hand.wait_until("it is read again", [&] { return medium_grid(medium())->density.at(0) == 3; });
  hand.wait_for_picture();
}

TEST(ViewerMediaUi, ACloudIsAdded) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.unfold("panel.media", "media.add");
  hand.choose("media.add", "cloud");
  hand.choose("scene.medium", "cloud");
  hand.choose("medium.pattern", "smoke");
  hand.type_into("medium.resolution", "32");
  hand.type_into("medium.seed", "5");
  const auto& model = std::get<ProceduralMediumModel>(hand.document().scene.media.at(0).model);
  EXPECT_EQ(model.seed, 5);
  EXPECT_EQ(model.resolution, 32);
  EXPECT_EQ(model.pattern, 1);
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().error, "");
}

} // namespace
