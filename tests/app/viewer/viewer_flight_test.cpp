// Flying, looking, focusing: the effect of each key and drag on the camera.

#include "app/harness.h"

namespace candela::test {
namespace {

vec3 right_of(const Camera& c) { return glm::normalize(glm::cross(c.target - c.position, c.up)); }
vec3 forward_of(const Camera& c) { return glm::normalize(c.target - c.position); }

/// The camera after the key was held for `frames` frames of a thirtieth of a second.
Camera after(ViewerHarness& hand, Key key, int frames = 10) {
  hand.key_down(key);
  hand.frame(frames);
  hand.key_up(key);
  return hand.document().scene.camera;
}

struct KeyMove {
  Key key;
  vec3 direction; ///< right, up, forward
};

TEST(ViewerFlightUi, EachMovingKeyMovesAlongItsAxis) {
  for (const KeyMove& move :
       {KeyMove{Key::w, {0, 0, 1}}, KeyMove{Key::up, {0, 0, 1}}, KeyMove{Key::s, {0, 0, -1}},
        KeyMove{Key::down, {0, 0, -1}}, KeyMove{Key::e, {1, 0, 0}}, KeyMove{Key::right, {1, 0, 0}},
        KeyMove{Key::q, {-1, 0, 0}}, KeyMove{Key::left, {-1, 0, 0}}, KeyMove{Key::space, {0, 1, 0}},
        KeyMove{Key::x, {0, -1, 0}}}) {
    SCOPED_TRACE(static_cast<int>(move.key));
    ViewerHarness hand;
    const Camera before = hand.document().scene.camera;
    const Camera now = after(hand, move.key);
    const vec3 moved = now.position - before.position;
    const vec3 axis = move.direction.x * right_of(before) + move.direction.y * before.up +
                      move.direction.z * forward_of(before);
    // 1/60 s for the first frame and a 1/30 s for each of the ten that follow.
    const float expected = hand.state().natural_speed * (1 / 60.0f + 10 / 30.0f);
    EXPECT_NEAR(glm::dot(moved, axis), expected, 1e-4f * expected);
    EXPECT_NEAR(glm::length(moved), expected, 1e-4f * expected);
    EXPECT_LT(glm::length(now.target - before.target - moved), 1e-5f) << "the target comes along";
    hand.frame(5);
    EXPECT_EQ(hand.document().scene.camera, now) << "a released key flies no more";
  }
}

TEST(ViewerFlightUi, EachTurningKeyTurns) {
  struct KeyTurn {
    Key key;
    vec2 to; ///< right, up
  };
  for (const KeyTurn& turn : {KeyTurn{Key::a, {-1, 0}}, KeyTurn{Key::d, {1, 0}}, KeyTurn{Key::insert, {0, 1}},
                              KeyTurn{Key::del, {0, -1}}}) {
    SCOPED_TRACE(static_cast<int>(turn.key));
    ViewerHarness hand;
    const Camera before = hand.document().scene.camera;
    const Camera now = after(hand, turn.key);
    EXPECT_EQ(now.position, before.position);
    const vec3 view = forward_of(now);
    const vec3 to = turn.to.x * right_of(before) + turn.to.y * before.up;
    const float expected = before.vertical_fov * (1 / 60.0f + 10 / 30.0f); // an angle of view a second
    EXPECT_NEAR(std::asin(glm::dot(view, to)), expected, 1e-3f * expected);
    EXPECT_NEAR(glm::length(now.target - now.position), glm::length(before.target - before.position), 1e-4f);
  }
}

TEST(ViewerFlightUi, LookingUpStopsBeforeThePole) {
  ViewerHarness hand;
  const Camera now = after(hand, Key::insert, 300);
  EXPECT_EQ(camera_problem(now), "");
  EXPECT_GT(glm::dot(forward_of(now), now.up), 0.99f);
  EXPECT_NEAR(forward_of(now).x, 0, 1e-3f) << "it did not tip over sideways";
  EXPECT_LT(forward_of(now).z, 0);
}

TEST(ViewerFlightUi, ShiftIsFourTimesAsFast) {
  ViewerHarness hand;
  const vec3 start = hand.document().scene.camera.position;
  const vec3 there = after(hand, Key::w).position;
  const float one = glm::length(there - start);
  hand.key_down(Key::left_shift);
  EXPECT_NEAR(glm::length(after(hand, Key::s).position - there), 4 * one, 1e-3f * one);
}

TEST(ViewerFlightUi, TheWheelChangesTheSpeedOfAFlight) {
  ViewerHarness hand;
  hand.key_down(Key::a);
  hand.scroll({400, 300}, 1);
  EXPECT_NEAR(hand.state().speed_factor, 1.2f, 1e-6f);
  hand.scroll({400, 300}, -2);
  EXPECT_NEAR(hand.state().speed_factor, 1 / 1.2f, 1e-6f);
  EXPECT_NE(hand.state().notice, "");
  for (int i = 0; i < 100; ++i) hand.send(MouseScrolled{{0, -5}});
  EXPECT_GT(hand.state().speed_factor, 0.0f) << "it never stands still";
  const float speed = hand.state().speed_factor;
  hand.scroll(hand.reveal("panel.render"), 1);
  EXPECT_EQ(hand.state().speed_factor, speed) << "over the panels the wheel scrolls";
}

TEST(ViewerFlightUi, HomeAndTheButtonBringTheViewBack) {
  ViewerHarness hand;
  const Camera home = hand.document().scene.camera;
  after(hand, Key::w);
  after(hand, Key::a);
  ASSERT_NE(hand.document().scene.camera, home);
  hand.key(Key::home);
  EXPECT_EQ(hand.document().scene.camera, home);
  after(hand, Key::s);
  hand.unfold("panel.camera", "camera.reset");
  hand.click("camera.reset");
  hand.frame(2);
  EXPECT_EQ(hand.document().scene.camera, home);
}

TEST(ViewerFlightUi, DraggingLooksAround) {
  ViewerHarness hand;
  hand.wait_for_picture();
  const Camera before = hand.document().scene.camera;
  hand.drag({300, 300}, {400, 300});
  const Camera right = hand.document().scene.camera;
  EXPECT_EQ(right.position, before.position);
  const float step = radians_per_pixel(before, hand.viewer.picture_rect().height);
  EXPECT_NEAR(std::asin(glm::dot(forward_of(right), right_of(before))), 100 * step, 1e-3f);
  hand.drag({400, 300}, {400, 260});
  EXPECT_NEAR(std::asin(forward_of(hand.document().scene.camera).y), 40 * step, 1e-3f);
}

TEST(ViewerFlightUi, DraggingAPanelDoesNotLook) {
  ViewerHarness hand;
  const Camera before = hand.document().scene.camera;
  const vec2 at = hand.reveal("panel.render");
  hand.drag(at, {300, 300});
  EXPECT_EQ(hand.document().scene.camera, before);
}

TEST(ViewerFlightUi, FAndControlClickFocusOnWhatIsThere) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.click(hand.reveal("panel.camera"));
  // The middle of the back wall: 4.6 in front of the camera; the film is letterboxed to 4:3.
  const PixelRect rect = hand.viewer.picture_rect();
  const vec2 middle(rect.x + rect.width / 2, rect.y + rect.height / 2 - rect.height / 10);
  hand.move(middle);
  hand.key(Key::f);
  EXPECT_NEAR(hand.document().scene.camera.focus_distance, 4.6f, 1e-4f);
  EXPECT_NE(hand.state().notice.find("pinhole"), std::string::npos)
      << "it says why the focus has no visible effect: " << hand.state().notice;
  hand.type_into("camera.aperture_radius", "0.1");
  hand.wait_for_picture();
  hand.key_down(Key::left_control);
  hand.click(vec2(rect.x + 0.57f * static_cast<float>(rect.width),
                  rect.y + 0.75f * static_cast<float>(rect.height))); // the ball
  hand.key_up(Key::left_control);
  EXPECT_LT(hand.document().scene.camera.focus_distance, 3.6f);
  EXPECT_EQ(hand.state().notice.find("pinhole"), std::string::npos);
}

TEST(ViewerFlightUi, FocusingOnNothingSaysSo) {
  Document document = test_document();
  document.scene.camera.position = {0, 0, 40}; // the room is a few pixels of the picture
  ViewerHarness hand(document);
  hand.wait_for_picture();
  const PixelRect rect = hand.viewer.picture_rect();
  hand.move(vec2(rect.x + 20, rect.y + 20));
  hand.key(Key::f);
  EXPECT_EQ(hand.document().scene.camera.focus_distance, 0);
  EXPECT_NE(hand.state().notice, "");
}

TEST(ViewerFlightUi, KeysDoNotFlyWhileTyping) {
  ViewerHarness hand;
  hand.unfold("panel.scenes", "scene.path");
  hand.click("scene.path");
  const Camera before = hand.document().scene.camera;
  for (Key key : {Key::w, Key::s, Key::a, Key::d, Key::space, Key::p, Key::home}) {
    hand.key_down(key);
    hand.frame(3);
    hand.key_up(key);
  }
  EXPECT_EQ(hand.document().scene.camera, before);
  EXPECT_EQ(hand.state().notice, "");
  hand.begin_typing("display.exposure"); // from the first frame on
  hand.key_down(Key::w);
  hand.frame(3);
  EXPECT_EQ(hand.document().scene.camera, before);
}

TEST(ViewerFlightUi, LosingTheFocusStopsTheFlight) {
  ViewerHarness hand;
  hand.key_down(Key::w);
  hand.frame(3);
  hand.send(FocusLost{});
  const Camera there = hand.document().scene.camera;
  hand.frame(5);
  EXPECT_EQ(hand.document().scene.camera, there);
}

TEST(ViewerFlightUi, FlyingShowsPicturesOfTheWay) {
  Document document = test_document();
  document.settings.stop.spp = 0; // never finished
  ViewerHarness hand(document);
  hand.wait_until("the first picture is there", [&] { return hand.state().picture != nullptr; });
  const std::uint64_t first = hand.state().picture->frame->generation;
  hand.key_down(Key::s);
  int fresh = 0;
  std::uint64_t last = first;
  hand.wait_until("five moments of the way were shown", [&] {
    const std::uint64_t now = hand.state().picture->frame->generation;
    if (now != last) ++fresh, last = now;
    return fresh >= 5;
  });
  hand.key_up(Key::s);
}

} // namespace
} // namespace candela::test
