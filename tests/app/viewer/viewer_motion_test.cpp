// Motion in the window: of the selected object, of the camera, and the shutter.

#include "app/harness.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

Document document_of_a_ball() {
  Document document = test_document();
  document.scene.instances = {{"", SphereShape{}, mat4(1), {0}}};
  return document;
}

TEST(ViewerMotionUi, OfTheSelectedObjectIsEditedAndUndone) {
  ViewerHarness hand(document_of_a_ball());
  hand.wait_for_picture();
  hand.unfold("panel.objects", "list.objects");
  hand.click("objects/0");
  hand.frame(2);
  hand.unfold("object.motion", "object.motion.angle");
  auto motion = [&]() -> const Motion& { return hand.document().scene.instances[0].motion; };
  const std::uint64_t restarts = hand.viewer.session().status().restarts;
  hand.type_into("object.motion.translate.x", "1.5");
  hand.type_into("object.motion.angle", "720");
  EXPECT_EQ(motion().translate, vec3(1.5f, 0, 0));
  EXPECT_FLOAT_EQ(motion().angle, 4 * kPi);
  hand.wait_until("it is rendered", [&] { return hand.viewer.session().status().restarts > restarts; });
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().undo_name, "Object 0: motion");
  hand.type_into("object.motion.axis.y", "0"); // no axis is left
  EXPECT_EQ(motion().axis, vec3(0, 1, 0));
  EXPECT_EQ(document_problem(hand.document()), "");
  hand.screenshot("object_motion");
  for (int k = 0; k < 10 && motion() != Motion(); ++k) hand.click("undo"), hand.frame(2);
  EXPECT_EQ(motion(), Motion());
}

/// An object that is put elsewhere takes its motion along.
TEST(ViewerMotionUi, AMoveOfTheObjectKeepsItsMotion) {
  Document document = document_of_a_ball();
  document.scene.instances[0].motion.translate = {0, 0, 1};
  ViewerHarness hand(document);
  hand.unfold("panel.objects", "list.objects");
  hand.click("objects/0");
  hand.frame(2);
  hand.type_into("object.position.x", "3");
  const Instance& instance = hand.document().scene.instances[0];
  EXPECT_EQ(instance.world_from_object[3].x, 3);
  EXPECT_EQ(instance.motion.translate, vec3(0, 0, 1));
}

TEST(ViewerMotionUi, TheShutterAndTheCamerasWayAreInItsPanel) {
  ViewerHarness hand(document_of_a_ball());
  hand.wait_for_picture();
  hand.unfold("panel.camera", "camera.shutter_close");
  const std::uint64_t restarts = hand.viewer.session().status().restarts;
  hand.type_into("camera.shutter_close", "0.5");
  hand.type_into("camera.motion_position.x", "0.25");
  const Camera& camera = hand.document().scene.camera;
  EXPECT_EQ(camera.shutter_close, 0.5f);
  EXPECT_EQ(camera.motion_position.x, 0.25f);
  hand.wait_until("it is rendered", [&] { return hand.viewer.session().status().restarts > restarts; });
  hand.wait_for_picture();
  // A way that would end in what it looks at is refused.
  const vec3 way = camera.target - camera.position;
  for (int a = 0; a < 3; ++a)
    hand.type_into(fmt::format("camera.motion_position.{}", "xyz"[a]), fmt::format("{}", way[a]));
  EXPECT_EQ(document_problem(hand.document()), "");
  hand.screenshot("camera_motion");
}

} // namespace
} // namespace candela::test
