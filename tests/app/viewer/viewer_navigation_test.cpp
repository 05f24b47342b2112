// Orbit, pan, zoom and the views along the axes by mouse and keys; undo, redo, pause and step.

#include "app/harness.h"
#include "support/build_gate.h"

namespace candela::test {
namespace {

vec3 view_of(const Camera& c) { return glm::normalize(c.target - c.position); }

void drag_with(ViewerHarness& hand, MouseButton button, vec2 from, vec2 to) {
  hand.pause();
  hand.move(from);
  hand.press(button);
  hand.move(0.5f * (from + to));
  hand.move(to);
  hand.release(button);
}

TEST(ViewerNavigationUi, TheMiddleButtonOrbitsPansAndZooms) {
  ViewerHarness hand;
  const Camera before = hand.document().scene.camera;
  drag_with(hand, MouseButton::middle, {300, 300}, {400, 330});
  const Camera orbited = hand.document().scene.camera;
  EXPECT_NEAR(glm::length(orbited.position - before.target), glm::length(before.position), 1e-3f);
  EXPECT_LT(glm::length(orbited.target - before.target), 1e-3f) << "about what it looks at";
  EXPECT_LT(orbited.position.x, -0.5f) << "the scene turns with the hand";
  EXPECT_GT(orbited.position.y, 0.1f);

  hand.key_down(Key::left_shift);
  drag_with(hand, MouseButton::middle, {300, 300}, {350, 300});
  hand.key_up(Key::left_shift);
  const Camera panned = hand.document().scene.camera;
  EXPECT_LT(glm::length(view_of(panned) - view_of(orbited)), 1e-5f);
  const float unit =
      2 * std::tan(0.5f * before.vertical_fov) * 3.6f / static_cast<float>(hand.viewer.picture_rect().height);
  EXPECT_NEAR(glm::length(panned.position - orbited.position), 50 * unit, 1e-3f);

  hand.key_down(Key::left_control);
  drag_with(hand, MouseButton::middle, {300, 300}, {300, 200});
  hand.key_up(Key::left_control);
  const Camera zoomed = hand.document().scene.camera;
  EXPECT_LT(glm::length(zoomed.position - zoomed.target), 0.8f * 3.6f);
  EXPECT_LT(glm::length(zoomed.target - panned.target), 1e-3f);
}

TEST(ViewerNavigationUi, GesturesBeforeTheFirstPictureAreThoseAfterIt) {
  BuildGate gate(true);
  ViewerHarness hand(test_document(), {.on_build = gate.hook()});
  ASSERT_FALSE(hand.state().picture) << "the scene is still being built";
  const PixelRect before = hand.viewer.picture_rect();
  EXPECT_NEAR(static_cast<float>(before.width) / static_cast<float>(before.height), 64 / 48.0f, 0.01f);
  gate.open();
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.picture_rect(), before);
}

TEST(ViewerNavigationUi, AltStandsInForAMiddleButton) {
  ViewerHarness hand;
  const Camera before = hand.document().scene.camera;
  hand.key_down(Key::left_alt);
  hand.drag({300, 300}, {420, 300});
  hand.key_up(Key::left_alt);
  const Camera now = hand.document().scene.camera;
  EXPECT_LT(glm::length(now.target - before.target), 1e-3f);
  EXPECT_GT(glm::length(now.position - before.position), 0.5f);
}

TEST(ViewerNavigationUi, TheWheelZooms) {
  ViewerHarness hand;
  hand.scroll({400, 300}, 1);
  const Camera close = hand.document().scene.camera;
  EXPECT_LT(close.position.z, 3.3f);
  EXPECT_LT(glm::length(close.target), 1e-5f);
  hand.scroll({400, 300}, -1);
  EXPECT_NEAR(hand.document().scene.camera.position.z, 3.6f, 1e-4f);
  EXPECT_EQ(hand.state().speed_factor, 1.0f);
}

TEST(ViewerNavigationUi, TheNumberPadLooksAlongTheAxes) {
  ViewerHarness hand;
  hand.key(Key::keypad_3);
  EXPECT_LT(glm::length(view_of(hand.document().scene.camera) - vec3(-1, 0, 0)), 1e-3f);
  hand.key(Key::keypad_7);
  EXPECT_LT(glm::length(view_of(hand.document().scene.camera) - vec3(0, -1, 0)), 2e-3f);
  hand.control(Key::keypad_1);
  EXPECT_LT(glm::length(view_of(hand.document().scene.camera) - vec3(0, 0, 1)), 1e-3f);
  hand.unfold("panel.camera", "camera.front");
  hand.click("camera.front");
  EXPECT_LT(glm::length(view_of(hand.document().scene.camera) - vec3(0, 0, -1)), 1e-3f);
  hand.key(Key::keypad_5);
  EXPECT_EQ(hand.document().scene.camera.projection, Projection::orthographic);
  hand.key(Key::keypad_5);
  EXPECT_EQ(hand.document().scene.camera.projection, Projection::perspective);
  EXPECT_NEAR(glm::length(hand.document().scene.camera.position), 3.6f, 1e-3f);
  EXPECT_EQ(document_problem(hand.document()), "");
}

TEST(ViewerNavigationUi, UndoTakesBackGestureByGesture) {
  ViewerHarness hand;
  EXPECT_EQ(hand.state().undo_name, "");
  const Document first = hand.document();
  drag_with(hand, MouseButton::middle, {300, 300}, {400, 330});
  const Document orbited = hand.document();
  hand.frame();
  EXPECT_EQ(hand.state().undo_name, "Camera");
  for (int i = 0; i < 3; ++i) hand.scroll({400, 300}, 1); // one step: there was no pause
  hand.frame(3, 1.0);
  const Document zoomed = hand.document();
  hand.type_into("display.exposure", "2");
  hand.frame();
  EXPECT_EQ(hand.state().undo_name, "display.exposure");
  auto control = [&](Key key, bool shift = false) {
    hand.key_down(Key::left_control);
    if (shift) hand.key_down(Key::left_shift);
    hand.key(key);
    if (shift) hand.key_up(Key::left_shift);
    hand.key_up(Key::left_control);
    hand.frame();
  };
  control(Key::z);
  EXPECT_EQ(hand.document(), zoomed);
  control(Key::z);
  EXPECT_EQ(hand.document(), orbited);
  hand.click("undo");
  hand.frame();
  EXPECT_EQ(hand.document(), first);
  EXPECT_EQ(hand.state().undo_name, "");
  control(Key::z);
  EXPECT_EQ(hand.document(), first) << "there is nothing before it";
  control(Key::z, true);
  EXPECT_EQ(hand.document(), orbited);
  control(Key::y);
  EXPECT_EQ(hand.document(), zoomed);
  hand.click("redo");
  hand.frame();
  EXPECT_EQ(hand.document().settings.display.exposure, 2.0f);
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.viewport().shown()->display.exposure, 2.0f) << "and the picture follows";
}

TEST(ViewerNavigationUi, ASliderDragIsOneStep) {
  ViewerHarness hand;
  const auto slider = hand.find("display.exposure");
  ASSERT_TRUE(slider);
  const float y = 0.5f * (slider->lo.y + slider->hi.y);
  hand.drag({0.5f * (slider->lo.x + slider->hi.x), y}, {slider->hi.x - 30, y});
  hand.frame(2);
  ASSERT_NE(hand.document().settings.display.exposure, 0.0f);
  hand.click("undo");
  hand.frame();
  EXPECT_EQ(hand.document().settings.display.exposure, 0.0f);
  EXPECT_EQ(hand.state().undo_name, "");
}

TEST(ViewerNavigationUi, AFlightIsOneStep) {
  ViewerHarness hand;
  const Camera before = hand.document().scene.camera;
  hand.key_down(Key::w);
  hand.frame(12);
  hand.key_up(Key::w);
  hand.frame(2);
  ASSERT_NE(hand.document().scene.camera, before);
  hand.click("undo");
  hand.frame();
  EXPECT_EQ(hand.document().scene.camera, before);
}

TEST(ViewerNavigationUi, PauseAndStepByKeyAndButton) {
  Document document = test_document();
  document.settings.stop.spp = 0;
  ViewerHarness hand(document);
  hand.key(Key::k);
  hand.wait_for_picture();
  EXPECT_TRUE(hand.state().paused);
  EXPECT_EQ(hand.state().status.phase, SessionPhase::paused);
  const int spp = hand.viewer.session().latest()->spp;
  hand.click("step");
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.session().latest()->spp, spp + 1);
  hand.key(Key::l);
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.session().latest()->spp, spp + 2);
  hand.click("pause");
  EXPECT_FALSE(hand.state().paused);
  hand.wait_until("it goes on", [&] { return hand.viewer.session().latest()->spp > spp + 2; });
}

} // namespace
} // namespace candela::test
