// Picking objects and lights, moving them by handles and numbers, focusing, rendering a region.

#include "app/harness.h"
#include "io/candela/candela_json.h"

namespace candela::test {
namespace {

/// The screen position of a point of the world.
vec2 shown(ViewerHarness& hand, vec3 world) {
  const FilmSettings& film = hand.document().settings.film;
  const ScreenProjection screen(hand.document().scene.camera, hand.viewer.picture_rect(),
                                {film.width, film.height});
  return screen.point(world).value_or(vec2(-1));
}

const vec3 kBall(0.2f, -0.6f, 0.1f), kSpark(-0.6f, 0.2f, 0.5f);
constexpr int kBallIndex = 6;

/// Waits for the picture and selects the ball.
struct HandOnBall : ViewerHarness {
  HandOnBall() {
    wait_for_picture();
    click(shown(*this, kBall));
  }
};

TEST(ViewerSelectionUi, AClickSelectsAndThePanelsFollow) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.unfold("panel.objects", "list.objects");
  hand.unfold("panel.materials", "material.type");
  hand.click(shown(hand, kBall));
  hand.frame(2);
  EXPECT_EQ(hand.state().selection, (Selection{Selection::Kind::object, kBallIndex}));
  EXPECT_EQ(hand.state().selected_material, 4);
  EXPECT_EQ(hand.document().scene.camera.focus_distance, 0) << "selecting does not focus";
  EXPECT_TRUE(hand.find("object.position.x"));
  hand.screenshot("selected");

  hand.click(shown(hand, kSpark));
  EXPECT_EQ(hand.state().selection, (Selection{Selection::Kind::light, 0}));
  EXPECT_EQ(hand.state().selected_light, 0);

  hand.click(shown(hand, {0, 0.999f, 0.05f}));
  EXPECT_EQ(hand.state().selection, (Selection{Selection::Kind::object, 5})) << "the lamp";
  EXPECT_EQ(hand.state().selected_light, 1) << "which shines";

  hand.frame(2);
  hand.click("objects/4");
  hand.frame(2);
  EXPECT_EQ(hand.state().selection, (Selection{Selection::Kind::object, 4}));
  hand.key(Key::escape);
  EXPECT_EQ(hand.state().selection, Selection{});
}

TEST(ViewerSelectionUi, AClickOnNothingSelectsNothing) {
  Document document = test_document();
  document.scene.camera.position = {0, 0, 40}; // the room is a few pixels of the picture
  ViewerHarness hand(document);
  hand.wait_for_picture();
  hand.click(shown(hand, {0, 0, 0}));
  EXPECT_EQ(hand.state().selection.kind, Selection::Kind::object);
  const PixelRect rect = hand.viewer.picture_rect();
  hand.click(vec2(rect.x + 20, rect.y + 20));
  EXPECT_EQ(hand.state().selection, Selection{});
}

TEST(ViewerSelectionUi, ASelectionThatIsGoneIsNone) {
  ScratchFolder folder;
  HandOnBall hand;
  Document smaller = test_document();
  smaller.scene.instances.resize(2);
  write_candela_json(smaller, folder / "smaller.json");
  hand.send(FilesDropped{{folder / "smaller.json"}});
  hand.wait_until("it is open", [&] { return hand.document().scene.instances.size() == 2; });
  hand.frame(2);
  EXPECT_EQ(hand.state().selection, Selection{});
}

TEST(ViewerSelectionUi, OrbitsAboutTheSelectionAndFramesIt) {
  HandOnBall hand;
  const vec2 before = shown(hand, kBall);
  hand.key_down(Key::left_alt);
  hand.drag({300, 300}, {360, 320});
  hand.key_up(Key::left_alt);
  EXPECT_NE(hand.document().scene.camera, test_document().scene.camera);
  EXPECT_LT(glm::length(shown(hand, kBall) - before), 0.5f);
  hand.key(Key::keypad_period);
  EXPECT_LT(glm::length(hand.document().scene.camera.target - kBall), 1e-4f);
}

TEST(ViewerSelectionUi, TheMoveHandlesMoveAndUndoPutsBack) {
  HandOnBall hand;
  hand.key(Key::g);
  hand.frame(2);
  const mat4 start = hand.document().scene.instances[kBallIndex].world_from_object;
  const float unit =
      3.5f * 2 * std::tan(radians(20.0f)) / static_cast<float>(hand.viewer.picture_rect().height);
  const vec2 grip = shown(hand, kBall + vec3(60 * unit, 0, 0));
  hand.screenshot("gizmo_move");
  const Camera camera = hand.document().scene.camera;
  hand.drag(grip, grip + vec2(-80, 0));
  const mat4 moved = hand.document().scene.instances[kBallIndex].world_from_object;
  EXPECT_NEAR(moved[3].x - start[3].x, -80 * unit, 2 * unit);
  EXPECT_NEAR(moved[3].y, start[3].y, 1e-5f);
  EXPECT_NEAR(moved[3].z, start[3].z, 1e-5f);
  EXPECT_EQ(hand.document().scene.camera, camera) << "the drag did not look around";
  hand.frame(2);
  EXPECT_EQ(hand.state().undo_name, "ball: move");
  hand.wait_for_picture();
  const auto found = hand.viewer.session().pick(vec2(64, 48) * 0.5f);
  EXPECT_TRUE(found);
  hand.click("undo");
  hand.frame();
  EXPECT_EQ(hand.document().scene.instances[kBallIndex].world_from_object, start);
}

TEST(ViewerSelectionUi, EscapeGivesADragUp) {
  HandOnBall hand;
  hand.click("tool.move");
  const Document before = hand.document();
  hand.pause();
  hand.move(shown(hand, kBall)); // the middle handle
  hand.press();
  hand.move(shown(hand, kBall) + vec2(60, -40));
  EXPECT_NE(hand.document(), before);
  hand.key(Key::escape);
  hand.release();
  hand.frame(2);
  EXPECT_EQ(hand.document(), before);
  EXPECT_EQ(hand.state().undo_name, "");
}

TEST(ViewerSelectionUi, RotateAndScaleTurnAndGrow) {
  HandOnBall hand;
  hand.key(Key::r);
  hand.frame(2);
  const vec2 middle = shown(hand, kBall);
  hand.screenshot("gizmo_rotate");
  hand.drag(middle + vec2(102, 0), middle + vec2(0, -102)); // the outer ring, a quarter turn
  const mat4 turned = hand.document().scene.instances[kBallIndex].world_from_object;
  EXPECT_LT(glm::length(vec3(turned[3]) - kBall), 1e-4f);
  EXPECT_NEAR(glm::length(vec3(turned[0])), 1, 1e-4f);
  EXPECT_GT(glm::length(turned[0] - vec4(1, 0, 0, 0)), 1.0f);
  hand.key(Key::t);
  hand.frame(2);
  hand.screenshot("gizmo_scale");
  hand.drag(middle, middle + vec2(42, 0)); // the middle: half as large again
  const mat4 grown = hand.document().scene.instances[kBallIndex].world_from_object;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(glm::length(vec3(grown[c])), 1.5f, 1e-3f);
  EXPECT_EQ(document_problem(hand.document()), "");
  hand.wait_for_picture();
}

TEST(ViewerSelectionUi, APointLightMovesByItsHandles) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.click(shown(hand, kSpark));
  hand.key(Key::g);
  hand.frame(2);
  hand.drag(shown(hand, kSpark), shown(hand, kSpark) + vec2(50, 0));
  EXPECT_GT(light_position(hand.document().scene.lights[0])->x, kSpark.x + 0.05f);
  EXPECT_NEAR(light_position(hand.document().scene.lights[0])->y, kSpark.y, 1e-3f);
  hand.frame(2);
  EXPECT_EQ(hand.state().undo_name, "spark: position");
}

TEST(ViewerSelectionUi, NumbersPlaceAnObject) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.unfold("panel.objects", "list.objects");
  hand.click(shown(hand, kBall));
  hand.frame(2);
  hand.type_into("object.position.y", "0.25");
  EXPECT_EQ(hand.document().scene.instances[kBallIndex].world_from_object[3].y, 0.25f);
  hand.type_into("object.rotation.y", "120");
  hand.type_into("object.rotation.x", "10");
  hand.type_into("object.scale.z", "2");
  const mat4 expected = transform_of({{0.2f, 0.25f, 0.1f}, {10, 120, 0}, {1, 1, 2}});
  EXPECT_EQ(hand.document().scene.instances[kBallIndex].world_from_object, expected)
      << "the typed angles are kept, not replaced by others of the same matrix";
  hand.choose("object.material.0", "red");
  EXPECT_EQ(hand.document().scene.instances[kBallIndex].materials[0], 1);
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.session().status().phase, SessionPhase::finished);
}

TEST(ViewerSelectionUi, ARegionAccumulatesAlone) {
  Document document = test_document();
  document.settings.stop.spp = 0;
  ViewerHarness hand(document);
  hand.wait_until("a picture is there", [&] { return hand.state().picture && hand.state().status.spp > 0; });
  const Camera camera = hand.document().scene.camera;
  hand.control(Key::b);
  EXPECT_TRUE(hand.state().region_armed);
  const PixelRect rect = hand.viewer.picture_rect();
  const vec2 lo(rect.x + rect.width / 4, rect.y + rect.height / 4);
  hand.drag(lo, lo + vec2(rect.width / 2, rect.height / 2));
  ASSERT_TRUE(hand.state().region);
  EXPECT_NEAR(hand.state().region->lo.x, 0.25f, 0.01f);
  EXPECT_NEAR(hand.state().region->hi.y, 0.75f, 0.01f);
  EXPECT_EQ(hand.document().scene.camera, camera);
  hand.frame(3);
  hand.screenshot("region");
  const std::uint64_t restarts = hand.viewer.session().status().restarts;
  hand.wait_until("only the middle changes", [&] {
    const auto a = hand.viewer.session().latest();
    hand.wait_until("the next frame", [&] { return hand.viewer.session().latest() != a; });
    const auto b = hand.viewer.session().latest();
    return a->linear[0] == b->linear[0] && a->linear[24 * 64 + 32] != b->linear[24 * 64 + 32];
  });
  hand.click("region");
  hand.frame();
  EXPECT_FALSE(hand.state().region);
  EXPECT_EQ(hand.viewer.session().status().restarts, restarts);
}

} // namespace
} // namespace candela::test
