// Keyboard focus, and the handling of typed text.

#include "app/harness.h"
#include "io/candela/candela_json.h"
#include "support/materials.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

/// Presses and releases as a window system reports them: the letter with its character, faster than frames.
void type_fast(ViewerHarness& hand, const std::string& text) {
  for (char c : text) {
    const Key key = c >= 'a' && c <= 'z' ? static_cast<Key>(static_cast<int>(Key::a) + (c - 'a')) : Key::none;
    hand.viewer.handle(KeyChanged{key, true});
    hand.viewer.handle(TextTyped{static_cast<char32_t>(c)});
    hand.viewer.handle(KeyChanged{key, false});
  }
}

void settle(ViewerHarness& hand) {
  hand.frame();
  while (hand.viewer.has_pending_events()) hand.frame();
  hand.frame(2);
}

/// State that keys must not change unless they are meant for the view.
struct View {
  Camera camera;
  bool compares, panels, help, paused;
  Tool tool;
  bool operator==(const View&) const = default;
};
View view_of(const ViewerHarness& hand) {
  const ViewerState& s = hand.state();
  return {s.document.scene.camera, s.compare.active, s.panels_visible, s.help_visible, s.paused, s.tool};
}

constexpr const char* kEveryLetter = "abcdefghijklmnopqrstuvwxyz";

TEST(ViewerTypingUi, SaveAsTakesTheKeyboardAtOnce) {
  ScratchFolder folder;
  ViewerHarness hand(test_document(), {.screenshot_folder = folder.path()});
  hand.wait_for_picture();
  const View before = view_of(hand);
  // All events at once, as from a fast user or another program.
  for (Key key : {Key::left_control, Key::left_shift, Key::s}) hand.viewer.handle(KeyChanged{key, true});
  for (Key key : {Key::s, Key::left_shift, Key::left_control}) hand.viewer.handle(KeyChanged{key, false});
  type_fast(hand, kEveryLetter);
  settle(hand);
  EXPECT_EQ(hand.state().save_path, "abcdefghijklmnopqrstuvwxyz.json")
      << "the stem was selected, the ending stays";
  EXPECT_EQ(view_of(hand), before);
  EXPECT_TRUE(fs::is_empty(folder.path())) << "no letter has saved a picture";
  hand.screenshot("save_as_typed");
  hand.key(Key::escape);
  hand.frame(2);
  EXPECT_FALSE(hand.state().save_as_visible) << "one Escape gives it up";
}

TEST(ViewerTypingUi, SaveAsIsAnsweredByEnter) {
  ScratchFolder folder;
  const std::string path = folder / "room.json";
  write_candela_json(test_document(), path);
  ViewerHarness hand;
  hand.send(FilesDropped{{path}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
  for (const char* name : {"second", "third"}) { // the field appears anew each time
    hand.control(Key::s, true);
    type_fast(hand, name);
    settle(hand);
    hand.key(Key::enter);
    const std::string wanted = folder / (std::string(name) + ".json");
    hand.wait_until("it is saved", [&] { return hand.state().scene_path == wanted; });
    hand.frame(2);
    EXPECT_FALSE(hand.state().save_as_visible);
  }
}

TEST(ViewerTypingUi, ANameThatCannotBeWrittenIsAskedForAgain) {
  ScratchFolder folder;
  const std::string path = folder / "room.json";
  write_candela_json(test_document(), path);
  ViewerHarness hand;
  hand.send(FilesDropped{{path}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
  hand.control(Key::s, true);
  hand.frame(4);
  hand.type("/nowhere/x"); // behind the folder that the field offers: an absolute path all the same
  hand.key(Key::enter);
  hand.wait_until("the error shows", [&] { return !hand.state().error.empty(); });
  EXPECT_TRUE(hand.state().error.starts_with("/nowhere/x.json:")) << hand.state().error;
  hand.frame(4);
  ASSERT_TRUE(hand.find("save.path"));
  hand.control(Key::a);
  hand.type(folder / "better");
  EXPECT_EQ(hand.state().error, "");
  hand.key(Key::enter);
  hand.wait_until("it is saved", [&] { return hand.state().scene_path == folder / "better.json"; });
}

TEST(ViewerTypingUi, NoSingleKeyActsWhileSomethingAsks) {
  ScratchFolder folder;
  const std::string path = folder / "room.json";
  write_candela_json(test_document(), path);
  ViewerHarness hand(test_document(), {.screenshot_folder = folder.path()});
  hand.send(FilesDropped{{path}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
  hand.wait_for_picture();
  hand.type_into("display.exposure", "1");
  hand.frame(2);
  const auto files = [&] { return std::distance(fs::directory_iterator(folder.path()), {}); };
  const auto files_before = files();
  auto no_key_acts = [&](const char* what) {
    SCOPED_TRACE(what);
    const View before = view_of(hand);
    type_fast(hand, kEveryLetter);
    settle(hand);
    for (Key key : {Key::space, Key::up, Key::home, Key::period, Key::digit_1, Key::keypad_1, Key::keypad_5,
                    Key::f1, Key::f2, Key::tab, Key::pause})
      hand.key(key);
    EXPECT_EQ(view_of(hand), before);
    EXPECT_EQ(files(), files_before);
  };
  hand.key_down(Key::w); // a flight ends where a question begins
  hand.frame(2);
  hand.send(CloseRequested{});
  hand.frame(2);
  ASSERT_EQ(hand.state().question, Question::quit);
  no_key_acts("a question");
  hand.key_up(Key::w);
  hand.key(Key::escape);
  EXPECT_EQ(hand.state().question, Question::none);

  hand.control(Key::s, true);
  hand.frame(4);
  hand.click("statistics.progress"); // the field is left, the dialog is not
  no_key_acts("a dialog whose field has not the keyboard");
  hand.key(Key::escape);
  hand.frame(2);

  hand.click("display.tone_map");
  hand.frame(2);
  no_key_acts("a list");
  hand.key(Key::escape);
  hand.frame(2);
  EXPECT_FALSE(hand.find("display.tone_map/filmic")) << "Escape closes it";

  const Camera camera = hand.document().scene.camera;
  hand.key_down(Key::w);
  hand.frame(3);
  hand.key_up(Key::w);
  EXPECT_NE(hand.document().scene.camera, camera) << "and now they act again";
}

TEST(ViewerTypingUi, LettersAfterAClickGoToTheFieldThatWasClicked) {
  ViewerHarness hand;
  hand.unfold("panel.scenes", "scene.path");
  const vec2 at = hand.reveal("scene.path");
  hand.pause();
  const View before = view_of(hand);
  hand.viewer.handle(MouseMoved{at});
  hand.viewer.handle(MouseButtonChanged{MouseButton::left, true});
  hand.viewer.handle(MouseButtonChanged{MouseButton::left, false});
  type_fast(hand, kEveryLetter);
  settle(hand);
  EXPECT_EQ(hand.state().path_input, kEveryLetter);
  EXPECT_EQ(view_of(hand), before);
}

TEST(ViewerTypingUi, NamesAreTypedInAnyScript) {
  ViewerHarness hand;
  hand.control(Key::s, true);
  hand.frame(4);
  for (char32_t c : {U'\x5149', U'\x308b', U'\x7bb1', U'\x5e9'}) hand.viewer.handle(TextTyped{c});
  settle(hand);
  EXPECT_EQ(hand.state().save_path, "\xe5\x85\x89\xe3\x82\x8b\xe7\xae\xb1\xd7\xa9.json");
}

TEST(ViewerTypingUi, KeysDoNotReachTheViewBehindTheLab) {
  ScratchFolder folder;
  ViewerHarness hand(test_document(), {.screenshot_folder = folder.path()});
  hand.wait_for_picture();
  hand.key(Key::f2);
  hand.frame(2);
  const View before = view_of(hand);
  type_fast(hand, kEveryLetter);
  settle(hand);
  EXPECT_EQ(view_of(hand), before);
  EXPECT_TRUE(fs::is_empty(folder.path())) << "P saved what nobody sees";
  hand.key(Key::escape);
  EXPECT_FALSE(hand.state().lab_visible);
  hand.key(Key::k);
  EXPECT_TRUE(hand.state().paused);
}

TEST(ViewerTypingUi, ADecimalCommaCountsEverywhere) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.type_into("display.exposure", "1,5");
  EXPECT_EQ(hand.document().settings.display.exposure, 1.5f);
  hand.type_into("camera.vertical_fov", "50,25");
  EXPECT_NEAR(degrees(hand.document().scene.camera.vertical_fov), 50.25f, 1e-4f);
  hand.type_into("camera.position.x", "-0,75");
  EXPECT_EQ(hand.document().scene.camera.position.x, -0.75f);
  hand.reveal("list.materials");
  hand.click("materials/1");
  hand.type_into("material.diffuse.g", ",25");
  EXPECT_EQ(color(hand.document().scene.materials[1], "diffuse").g, 0.25f);
  hand.type_into("camera.speed", "2,5");
  EXPECT_EQ(hand.state().speed_factor, 2.5f);
  hand.type_into("path.max_depth", "1e1");
  EXPECT_EQ(hand.document().settings.path.max_depth, 10);
  hand.reveal("list.objects");
  hand.click("objects/0");
  hand.frame(2);
  hand.type_into("object.position.y", "0,5");
  EXPECT_EQ(hand.document().scene.instances[0].world_from_object[3].y, 0.5f);
}

TEST(ViewerTypingUi, WhatIsNoNumberIsRefusedAndSaidSo) {
  ViewerHarness hand;
  hand.unfold_all();
  const Document before = hand.document();
  for (const char* name : {"display.exposure", "camera.vertical_fov", "camera.position.x", "camera.speed",
                           "path.max_depth", "film.width"})
    for (const char* text : {"2+3", "1,234.5", "1.234,5", "abc", "0x10", "1 2", ""}) {
      SCOPED_TRACE(std::string(name) + ": " + text);
      hand.begin_typing(name);
      hand.control(Key::a);
      hand.key(Key::backspace);
      hand.type(text);
      hand.key(Key::enter);
      hand.frame(2);
      EXPECT_EQ(hand.document(), before);
      EXPECT_EQ(hand.state().speed_factor, 1);
      EXPECT_NE(hand.state().notice.find("stays"), std::string::npos) << hand.state().notice;
    }
  hand.type_into("path.max_depth", "2,5");
  EXPECT_EQ(hand.document(), before);
  EXPECT_NE(hand.state().notice.find("no whole number"), std::string::npos) << hand.state().notice;
  hand.reveal("path.max_depth");
  hand.screenshot("number_refused");
}

TEST(ViewerTypingUi, AnUneditedNumberKeepsTheDigitsThatAreNotShown) {
  Document document = test_document();
  document.scene.camera.position.x = 0.123456789f;
  ViewerHarness hand(document);
  hand.unfold_all();
  hand.begin_typing("camera.position.x");
  hand.key(Key::enter);
  hand.frame(2);
  EXPECT_EQ(hand.document().scene.camera.position.x, document.scene.camera.position.x);
}

TEST(ViewerTypingUi, TheColourPickersNumbersAreReadLikeAllOthers) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.click("materials/1");
  hand.click("material.diffuse.swatch");
  hand.frame(2);
  auto type = [&](const std::string& name, const std::string& text) {
    const auto field = hand.find(name);
    ASSERT_TRUE(field) << name;
    hand.key_down(Key::left_control);
    hand.click(0.5f * (field->lo + field->hi));
    hand.key(Key::a);
    hand.key_up(Key::left_control);
    hand.type(text);
    hand.key(Key::enter);
    hand.frame(2);
  };
  type("material.diffuse.picker.r", "255");
  EXPECT_NEAR(color(hand.document().scene.materials[1], "diffuse").r, 1, 1e-5f);
  const vec3 before = color(hand.document().scene.materials[1], "diffuse");
  type("material.diffuse.picker.r", "1,5");
  type("material.diffuse.picker.r", "2+3");
  type("material.diffuse.picker.code", "#12345");
  EXPECT_EQ(color(hand.document().scene.materials[1], "diffuse"), before);
  EXPECT_NE(hand.state().notice.find("no colour"), std::string::npos) << hand.state().notice;
  hand.screenshot("colour_picker");
  type("material.diffuse.picker.code", "#ff0080");
  EXPECT_NEAR(color(hand.document().scene.materials[1], "diffuse").g, 0, 1e-5f);
  EXPECT_NEAR(color(hand.document().scene.materials[1], "diffuse").b, 0.2158605f, 1e-4f);
}

TEST(ViewerTypingUi, NoTooltipLiesOverWhatIsTyped) {
  ViewerHarness hand;
  auto tooltips = [&] {
    int count = 0;
    for (const ImGuiWindow* window : hand.viewer.imgui()->Windows)
      count += (window->Flags & ImGuiWindowFlags_Tooltip) != 0 && window->Active;
    return count;
  };
  hand.move(hand.reveal("display.exposure"));
  hand.frame(3);
  EXPECT_EQ(tooltips(), 1);
  hand.begin_typing("display.exposure");
  hand.frame(3);
  EXPECT_EQ(tooltips(), 0);
  hand.key(Key::escape);
  hand.frame(3);
  EXPECT_EQ(tooltips(), 1);
}

// The mesh of an exporter that writes world coordinates, far from its origin.
TEST(ViewerTypingUi, TypedScaleAndRotationAreAboutTheMiddle) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{4, 0, 0}, {6, 0, 0}, {4, 2, 0}};
  mesh->triangles = {{0, 1, 2}};
  mesh->slot_names = {""};
  Document document = test_document();
  auto& instances = document.scene.instances;
  instances.insert(instances.begin(), {"far", std::shared_ptr<const Mesh>(mesh), mat4(1), {0}});
  ViewerHarness hand(document);
  hand.unfold_all();
  hand.reveal("list.objects");
  hand.click("objects/0");
  hand.frame(2);
  const vec3 middle(5, 1, 0);
  auto placed = [&](vec3 p) {
    return transform_point(hand.document().scene.instances[0].world_from_object, p);
  };
  hand.type_into("object.scale.x", "-1");
  EXPECT_LT(glm::length(placed(middle) - middle), 1e-5f) << "handles mirror it there";
  EXPECT_LT(glm::length(placed({4, 0, 0}) - vec3(6, 0, 0)), 1e-5f);
  hand.type_into("object.rotation.z", "90");
  EXPECT_LT(glm::length(placed(middle) - middle), 1e-5f);
  hand.type_into("object.scale.y", "3");
  EXPECT_LT(glm::length(placed(middle) - middle), 1e-4f);
}

} // namespace
} // namespace candela::test
