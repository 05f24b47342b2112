// Messages of the window: positions and duration.

#include "app/figures/typeface.h"
#include "app/harness.h"
#include "io/candela/candela_json.h"
#include "support/build_gate.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

void fail_to_open(ViewerHarness& hand, const std::string& path) {
  hand.send(FilesDropped{{path}});
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  hand.frame(2);
}

TEST(ViewerMessagesUi, AnErrorMovesNoField) {
  ViewerHarness hand;
  hand.control(Key::s, true, 6);
  const auto field = hand.find("save.path");
  ASSERT_TRUE(field);
  fail_to_open(hand, "/nowhere/a.json");
  const auto after = hand.find("save.path"), error = hand.find("error.text");
  EXPECT_EQ(after->lo, field->lo);
  EXPECT_EQ(after->hi, field->hi);
  EXPECT_GE(error->lo.y, field->hi.y) << "nor does it cover it";
  hand.screenshot("error_below_save_as");
}

TEST(ViewerMessagesUi, AnErrorGoesWithItsCause) {
  ScratchFolder folder;
  const std::string good = folder / "good.json";
  write_candela_json(test_document(), good);
  ViewerHarness hand(test_document(), {.screenshot_folder = folder.path()});
  hand.wait_for_picture();
  hand.unfold_all();

  fail_to_open(hand, "/nowhere/a.json");
  hand.key(Key::escape);
  EXPECT_EQ(hand.state().error, "") << "Escape dismisses it";

  fail_to_open(hand, "/nowhere/a.json");
  hand.click("scene.path");
  hand.type("x");
  EXPECT_EQ(hand.state().error, "") << "the path that was wrong is edited";
  fail_to_open(hand, "/nowhere/b.json");
  EXPECT_NE(hand.state().path_input.find('x'), std::string::npos) << "what is being typed is left alone";
  hand.click("statistics.progress");

  fail_to_open(hand, "/nowhere/a.json");
  hand.key(Key::p); // something else that goes well
  hand.wait_until("the picture is saved", [&] { return hand.state().notice.starts_with("Saved"); });
  EXPECT_NE(hand.state().error, "") << "which is no remedy";
  hand.send(FilesDropped{{good}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == good; });
  EXPECT_EQ(hand.state().error, "");

  hand.type_into("camera.position.z", "0"); // where the target is
  ASSERT_NE(hand.state().error, "");
  hand.type_into("camera.position.z", "3");
  EXPECT_EQ(hand.state().error, "") << "a good value took its place";
  hand.type_into("camera.position.z", "0");
  ASSERT_NE(hand.state().error, "");
  hand.key_down(Key::w);
  hand.frame(3);
  hand.key_up(Key::w);
  EXPECT_EQ(hand.state().error, "") << "the camera is elsewhere";

  hand.control(Key::s, true, 6);
  hand.control(Key::a);
  hand.type("/nowhere/at/all.json");
  hand.key(Key::enter);
  hand.wait_until("the error shows", [&] { return !hand.state().error.empty(); });
  hand.control(Key::s, true, 6);
  hand.type("x");
  EXPECT_EQ(hand.state().error, "") << "another name is typed";
}

TEST(ViewerMessagesUi, APictureThatCouldNotBeSavedIsToldUntilOneIs) {
  ScratchFolder folder;
  const fs::path later = fs::path(folder.path()) / "later";
  ViewerHarness hand(test_document(), {.screenshot_folder = later});
  hand.wait_for_picture();
  hand.key(Key::p);
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  fs::create_directory(later);
  hand.key(Key::p);
  hand.wait_until("it is saved", [&] { return hand.state().notice.starts_with("Saved"); });
  EXPECT_EQ(hand.state().error, "");
}

TEST(ViewerMessagesUi, NothingOfThePictureCoversAMessage) {
  ViewerHarness hand;
  hand.wait_for_picture();
  hand.key(Key::i);
  hand.move({300, 300});
  hand.frame(3);
  ASSERT_TRUE(hand.find("probe"));
  const float high = hand.find("probe")->lo.y;
  fail_to_open(hand, "/nowhere/a.json");
  const auto error = hand.find("error.text"), dismiss = hand.find("error.dismiss");
  EXPECT_GE(hand.find("probe")->lo.y, std::max(error->hi.y, dismiss->hi.y));
  hand.screenshot("probe_below_error");
  hand.click("error.dismiss");
  EXPECT_EQ(hand.state().error, "");
  hand.frame(3);
  EXPECT_EQ(hand.find("probe")->lo.y, high) << "and it is back where it was";
  hand.key(Key::f2);
  hand.frame(3);
  EXPECT_GE(hand.find("probe")->lo.x, hand.find("lab.close")->hi.x) << "beside the lab, not over it";
}

TEST(ViewerMessagesUi, AnErrorGivesWayToWhatIsTypedInTheLab) {
  ViewerHarness hand;
  hand.key(Key::f2);
  hand.frame(3);
  fail_to_open(hand, "/nowhere/a.json");
  // The topmost field: the first one of the current lesson.
  std::optional<WidgetRecord> field;
  for (const WidgetRecord& w : hand.viewer.widgets())
    if (w.name.starts_with("lab.") && w.hi.x < 452 &&
        (w.name.ends_with("seed") || w.name.ends_with("samples")))
      if (!field || w.lo.y < field->lo.y) field = w;
  if (!field) // names of settings
    for (const WidgetRecord& w : hand.viewer.widgets())
      if ((w.name == "samples" || w.name == "sampler.seed") && w.hi.x < 452) field = w;
  ASSERT_TRUE(field);
  hand.key_down(Key::left_control);
  hand.click(0.5f * (field->lo + field->hi));
  hand.key_up(Key::left_control);
  hand.frame(3);
  const auto error = hand.find("error.text");
  ASSERT_TRUE(error);
  const bool apart = error->lo.y >= field->hi.y || error->hi.y <= field->lo.y;
  EXPECT_TRUE(apart);
}

TEST(ViewerMessagesUi, APictureOfTheSceneBeforeSaysSo) {
  ScratchFolder folder;
  write_text(folder / "triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string path = folder / "triangle.json";
  write_text(path,
             R"({"candela": 1, "meshes": {"t": {"file": "triangle.obj"}}, "instances": [{"mesh": "t"}]})");
  BuildGate gate(false);
  ViewerHarness hand(test_document(), {.on_build = gate.hook()});
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().picture_of, "");
  gate.close();
  hand.send(FilesDropped{{path}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
  EXPECT_FALSE(hand.find("picture.old")) << "what takes no time is not told";
  hand.frame(1, 2);
  hand.frame(2);
  EXPECT_EQ(hand.state().picture_of, "still the picture of Cornell box");
  EXPECT_TRUE(hand.find("picture.old"));
  hand.screenshot("picture_of_the_scene_before");
  gate.open();
  hand.wait_for_picture();
  hand.frame(3);
  EXPECT_EQ(hand.state().picture_of, "");
  EXPECT_FALSE(hand.find("picture.old"));
}

TEST(ViewerMessagesUi, APictureFromBeforeAnEditSaysSo) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh->triangles = {{0, 1, 2}};
  mesh->slot_names = {""};
  Document document = test_document();
  document.scene.instances.push_back({"a", std::shared_ptr<const Mesh>(mesh), mat4(1), {0}});
  BuildGate gate(false);
  ViewerHarness hand(document, {.on_build = gate.hook()});
  hand.wait_for_picture();
  gate.close();
  hand.viewer.handle(DocumentEdited{[](Document& d) { d.scene.instances[7].world_from_object[3].x = 0.5f; }});
  hand.wait_until("it is being built", [&] { return hand.state().status.phase == SessionPhase::building; });
  hand.frame(1, 2);
  hand.frame(2);
  EXPECT_EQ(hand.state().picture_of, "still the picture from before the edit");
  gate.open();
  hand.wait_for_picture();
  hand.frame(3);
  EXPECT_EQ(hand.state().picture_of, "");
}

TEST(ViewerMessagesUi, DroppedTogether) {
  ScratchFolder folder;
  const fs::path inside = fs::path(folder.path()) / "scene";
  fs::create_directory(inside);
  const std::string a = (inside / "a.json").string(), b = folder / "b.json";
  write_candela_json(test_document(), a);
  write_candela_json(test_document(), b);
  ViewerHarness hand;
  hand.send(FilesDropped{{b, a}});
  hand.wait_until("the first is open", [&] { return hand.state().scene_path == b; });
  EXPECT_NE(hand.state().notice.find("left aside: a.json"), std::string::npos) << hand.state().notice;
  hand.send(FilesDropped{{inside.string()}});
  hand.wait_until("the scene of the folder is open", [&] { return hand.state().scene_path == a; });
  fs::remove(a);
  fail_to_open(hand, inside.string());
  EXPECT_NE(hand.state().error.find("no scene in it"), std::string::npos) << hand.state().error;
}

TEST(ViewerMessagesUi, NamesOfEveryScript) {
  ScratchFolder folder;
  const std::string name =
      "\xd7\xa9\xd7\x9c\xd7\x95\xd7\x9d-\xe5\x9c\xba\xe6\x99\xaf-\xf0\x9f\x98\x80-\xff.json";
  const std::string path = folder / name;
  write_candela_json(test_document(), path);
  ViewerHarness hand;
  hand.unfold("panel.scenes", "scene.path");
  hand.send(FilesDropped{{path}});
  hand.wait_until("it is open", [&] { return hand.state().scene_path == path; });
  hand.wait_for_picture();
  hand.reveal("scene.path");
  hand.frame(3);
  hand.screenshot("names_of_every_script");
  ImGui::SetCurrentContext(hand.viewer.imgui());
  const ImFont& font = *ImGui::GetIO().Fonts->Fonts[0];
  bool any = false, shown = true;
  for (const fs::path& file : find_fallback_typefaces())
    for (char32_t c : {char32_t{0x5e9}, char32_t{0x573a}})
      if (Typeface(file).has(c))
        any = true, shown &= font.FindGlyphNoFallback(static_cast<ImWchar>(c)) != nullptr;
  if (any) { EXPECT_TRUE(shown) << "a typeface that is installed has it"; }
}

TEST(ViewerMessagesUi, LargeNumbersAreWrittenOut) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.type_into("camera.aperture_radius", "123456");
  hand.type_into("display.exposure", "1");
  hand.reveal("camera.aperture_radius");
  hand.frame(2);
  hand.screenshot("large_numbers");
  EXPECT_EQ(hand.document().scene.camera.aperture_radius, 123456.0f);
}

} // namespace
} // namespace candela::test
