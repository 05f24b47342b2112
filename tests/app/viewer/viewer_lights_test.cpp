// Photometric files, pictures and groups of lights in the window.

#include "app/harness.h"
#include "support/materials.h"

namespace {

using namespace candela;
using namespace candela::test;

TEST(ViewerLightsUi, ADroppedPhotometricFileShapesALight) {
  ScratchFolder folder;
  write_text(folder / "lamp.ies",
             "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 15\n0 45 90\n0\n90 60 30\n");
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.send(FilesDropped{{folder / "lamp.ies"}});
  auto profile = [&] { return light_profile(hand.document().scene.lights.at(0)); };
  hand.wait_until("it is there", [&] { return profile() != nullptr; });
  EXPECT_EQ(hand.state().error, "");
  EXPECT_EQ(profile()->maximum(), 90);
  hand.unfold("panel.lights", "light.type");
  hand.choose("light.strength", "power");
  EXPECT_EQ(std::get<PointLightModel>(hand.document().scene.lights[0].model).strength,
            ProfileStrength::power);
  // A spot may have it, too; a constant light may not.
  hand.choose("light.type", "spot");
  ASSERT_TRUE(profile());
  hand.wait_for_picture();
  hand.reveal("light.remove");
  hand.frame(3);
  hand.screenshot("photometric_light");
  hand.click("light.remove");
  hand.frame(2);
  EXPECT_FALSE(profile());
  EXPECT_FALSE(hand.find("light.remove"));
  // By its path; a broken one changes nothing.
  write_text(folder / "bad.ies",
             "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 15\n0 45 x\n0\n90 60 30\n");
  hand.send(FilesDropped{{folder / "bad.ies"}});
  hand.wait_until("the error", [&] { return !hand.state().error.empty(); });
  EXPECT_NE(hand.state().error.find("bad.ies:5:6: vertical angles: "), std::string::npos)
      << hand.state().error;
  EXPECT_FALSE(profile());
}

TEST(ViewerLightsUi, AProfileNeedsALightThatItCouldShape) {
  ScratchFolder folder;
  write_text(folder / "lamp.ies",
             "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 15\n0 45 90\n0\n90 60 30\n");
  Document document = test_document();
  document.scene.lights.clear();
  ViewerHarness hand(document);
  hand.send(FilesDropped{{folder / "lamp.ies"}});
  hand.wait_until("the error", [&] { return !hand.state().error.empty(); });
  EXPECT_NE(hand.state().error.find("point or spot"), std::string::npos);
}

TEST(ViewerLightsUi, ADroppedPictureIsTheSlideOfASelectedProjector) {
  ScratchFolder folder;
  write_linear_image(Image{2, 1, {vec3(1, 0, 0), vec3(0, 0, 1)}}, folder / "slide.pfm");
  Document document = test_document();
  document.scene.lights[0].model = ProjectorLightModel{.position = {0, 0, 0.9f}};
  ViewerHarness hand(document);
  hand.wait_for_picture();
  hand.send(FilesDropped{{folder / "slide.pfm"}});
  hand.wait_until("it is there",
                  [&] { return light_panorama(hand.document().scene.lights.at(0)) != nullptr; });
  EXPECT_EQ(hand.document().scene.lights.size(), 1u);
  EXPECT_EQ(light_panorama(hand.document().scene.lights[0])->image.width, 2);
}

TEST(ViewerLightsUi, GroupsAreNamedSwitchedAndScaled) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.unfold("panel.lights", "light.type");
  EXPECT_FALSE(hand.find("light_group.0.on"));
  hand.click("light.group");
  hand.type("spark");
  hand.frame(2);
  EXPECT_EQ(hand.document().scene.lights[0].group, "spark");
  auto brightness = [&] {
    hand.wait_for_picture();
    double sum = 0;
    for (vec3 pixel : hand.viewer.viewport().shown()->frame->linear) sum += static_cast<double>(pixel.y);
    return sum;
  };
  const double whole = brightness();
  const std::uint64_t restarts = hand.state().status.restarts;
  auto same_samples = [&] {
    hand.wait_for_picture(); // an edit restarts when the render thread takes it
    return hand.state().status.restarts == restarts && hand.state().status.spp >= 1;
  };
  hand.click("light_group.0.on");
  ASSERT_EQ(hand.document().scene.light_groups.size(), 1u);
  EXPECT_FALSE(hand.document().scene.light_groups[0].on);
  const double without = brightness();
  EXPECT_LT(without, whole);
  EXPECT_TRUE(same_samples());
  EXPECT_GT(without, 0) << "the ceiling lamp is in no group";
  hand.click("light_group.0.on");
  EXPECT_EQ(brightness(), whole) << "the same samples again";
  hand.type_into("light_group.0.scale", "3");
  EXPECT_EQ(hand.document().scene.light_groups[0].scale, 3);
  EXPECT_GT(brightness(), whole);
  hand.reveal("light_group.0.solo");
  hand.frame(2);
  hand.click("light_group.0.solo");
  EXPECT_TRUE(hand.document().scene.light_groups[0].solo);
  EXPECT_NEAR(brightness(), 3 * (whole - without), 1e-4 * whole) << "three times what it gives";
  hand.click("light_group.0.solo");
  EXPECT_TRUE(same_samples());
  hand.frame(3);
  hand.screenshot("light_groups");
  // A surface that shines may join.
  hand.click("emitters/3");
  hand.frame(3);
  hand.reveal("light.group");
  hand.frame(3);
  hand.click("light.group");
  hand.type("lamp");
  hand.frame(2);
  EXPECT_EQ(hand.document().scene.materials[3].group, "lamp");
  EXPECT_FALSE(same_samples()) << "another layer";
  hand.reveal("light_group.0.on");
  hand.click("light_group.0.on");
  hand.reveal("light_group.1.on");
  hand.click("light_group.1.on");
  EXPECT_EQ(brightness(), 0) << "all are off";
}

} // namespace
