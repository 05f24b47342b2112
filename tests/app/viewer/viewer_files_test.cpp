// Saving, reloading and cancelling scenes; questions before edits are lost; preferences.

#include "app/harness.h"
#include "io/candela/candela_json.h"
#include "support/build_gate.h"
#include "support/materials.h"

#include <fstream>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

void open(ViewerHarness& hand, const std::string& path) {
  hand.send(FilesDropped{{path}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
}

TEST(ViewerFilesUi, ControlSWritesTheEditedSceneIntoItsFile) {
  ScratchFolder folder;
  const std::string path = folder / "room.json";
  write_candela_json(test_document(), path);
  ViewerHarness hand;
  open(hand, path);
  EXPECT_EQ(hand.viewer.title(), "room.json - Candela");
  hand.type_into("display.exposure", "1.5");
  hand.frame(2);
  EXPECT_EQ(hand.viewer.title(), "room.json* - Candela");
  hand.control(Key::s, false, 2);
  hand.wait_until("it is saved", [&] { return hand.state().notice.starts_with("Saved"); });
  hand.frame();
  EXPECT_EQ(hand.viewer.title(), "room.json - Candela");
  EXPECT_EQ(read_scene(path).document, hand.document());
  hand.click("undo");
  hand.frame(2);
  EXPECT_EQ(hand.viewer.title(), "room.json* - Candela") << "the file has what was undone";
}

TEST(ViewerFilesUi, WhatIsNoJsonOfOnesOwnIsSavedUnderANewName) {
  ScratchFolder folder;
  const std::string obj = folder / "kite.obj";
  write_text(obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ViewerHarness hand;
  open(hand, obj);
  hand.control(Key::s, false, 2);
  ASSERT_TRUE(hand.find("save.path"));
  EXPECT_EQ(hand.state().save_path, folder / "kite.json");
  hand.click("save.to");
  hand.wait_until("it is saved", [&] { return fs::exists(folder / "kite.json"); });
  hand.wait_until("and shown", [&] { return hand.viewer.title() == "kite.json - Candela"; });
  EXPECT_NE(read_text(folder / "kite.json").find("\"kite.obj\""), std::string::npos)
      << "the mesh is named, relative to the scene";
  EXPECT_FALSE(hand.find("save.path"));
  const Document again = read_scene(folder / "kite.json").document;
  EXPECT_EQ(again.scene.instances.size(), 1u);
}

TEST(ViewerFilesUi, AnotherFileIsReplacedOnlyWhenAsked) {
  ScratchFolder folder;
  write_text(folder / "other.json", "someone else's");
  ViewerHarness hand;
  hand.control(Key::s, true, 2);
  ASSERT_TRUE(hand.find("save.path"));
  hand.click("save.path");
  hand.control(Key::a, false, 2);
  hand.type(folder / "other.json");
  hand.key(Key::enter);
  hand.frame(2);
  ASSERT_TRUE(hand.find("question.replace"));
  hand.screenshot("question_replace");
  EXPECT_EQ(read_text(folder / "other.json"), "someone else's");
  hand.click("replace.no");
  hand.frame(2);
  EXPECT_FALSE(hand.find("question.replace"));
  hand.click("save.to");
  hand.frame(2);
  hand.click("replace.yes");
  hand.wait_until("it is replaced", [&] { return hand.state().notice.starts_with("Saved"); });
  EXPECT_EQ(read_scene(folder / "other.json").document.scene.instances.size(), 7u);
}

TEST(ViewerFilesUi, AFileThatCannotBeWrittenIsReported) {
  ViewerHarness hand;
  hand.control(Key::s, true, 2);
  hand.click("save.path");
  hand.control(Key::a, false, 2);
  hand.type("/nowhere/at/all.json");
  hand.key(Key::enter);
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  EXPECT_NE(hand.state().error.find("/nowhere/at"), std::string::npos) << hand.state().error;
}

TEST(ViewerFilesUi, ClosingAsksOnlyWhereEditsWouldBeLost) {
  {
    ViewerHarness hand;
    hand.key_down(Key::w);
    hand.frame(5);
    hand.key_up(Key::w);
    hand.send(CloseRequested{});
    EXPECT_TRUE(hand.viewer.wants_close()) << "who looked around has lost nothing";
  }
  ScratchFolder folder;
  const std::string path = folder / "room.json";
  write_candela_json(test_document(), path);
  {
    ViewerHarness hand;
    open(hand, path);
    hand.type_into("display.exposure", "1");
    hand.send(CloseRequested{});
    hand.frame(2);
    EXPECT_FALSE(hand.viewer.wants_close());
    ASSERT_TRUE(hand.find("question.quit"));
    hand.screenshot("question_quit");
    hand.click("quit.stay");
    hand.frame(2);
    EXPECT_FALSE(hand.find("question.quit"));
    hand.control(Key::q, false, 2);
    hand.click("quit.save");
    hand.wait_until("it is saved and closed", [&] { return hand.viewer.wants_close(); });
    EXPECT_EQ(read_scene(path).document.settings.display.exposure, 1.0f);
  }
  ViewerHarness hand;
  open(hand, path);
  hand.type_into("display.exposure", "3");
  hand.control(Key::q, false, 2);
  EXPECT_FALSE(hand.viewer.wants_close());
  hand.control(Key::q, false, 2);
  EXPECT_TRUE(hand.viewer.wants_close()) << "who asks twice means it";
  EXPECT_EQ(read_scene(path).document.settings.display.exposure, 1.0f);
}

TEST(ViewerFilesUi, OpeningAnotherSceneIsUndone) {
  ScratchFolder folder;
  Document other = test_document();
  other.scene.instances.pop_back();
  write_candela_json(other, folder / "other.json");
  ViewerHarness hand;
  hand.type_into("display.exposure", "1");
  const Document mine = hand.document();
  open(hand, folder / "other.json");
  hand.frame(2);
  EXPECT_EQ(hand.state().undo_name, "Open other.json");
  hand.click("undo");
  hand.frame(2);
  EXPECT_EQ(hand.document(), mine) << "no edit is lost by opening";
  EXPECT_EQ(hand.state().scene_path, "");
  EXPECT_TRUE(hand.state().modified);
}

TEST(ViewerFilesUi, AFileThatChangesIsReadAgain) {
  ScratchFolder folder;
  const std::string path = folder / "room.json";
  Document document = test_document();
  write_candela_json(document, path);
  ViewerHarness hand;
  open(hand, path);
  hand.wait_for_picture();
  hand.key_down(Key::w);
  hand.frame(5);
  hand.key_up(Key::w);
  hand.frame(2);
  const Camera seen = hand.document().scene.camera;
  color(document.scene.materials[0], "diffuse") = {0.1f, 0.2f, 0.9f};
  write_candela_json(document, path);
  hand.wait_until("it is reloaded", [&] {
    return color(hand.document().scene.materials[0], "diffuse") ==
           color(document.scene.materials[0], "diffuse");
  });
  EXPECT_EQ(hand.document().scene.camera, seen);

  hand.type_into("display.exposure", "1");
  color(document.scene.materials[0], "diffuse") = {0.9f, 0.2f, 0.1f};
  write_candela_json(document, path);
  hand.wait_until("it asks", [&] { return hand.find("question.reload").has_value(); });
  EXPECT_EQ(hand.document().settings.display.exposure, 1.0f);
  hand.click("reload.no");
  hand.frame(2);
  EXPECT_FALSE(hand.find("question.reload"));
  color(document.scene.materials[0], "diffuse") = {0.5f, 0.2f, 0.1f};
  write_candela_json(document, path);
  hand.wait_until("it asks", [&] { return hand.find("question.reload").has_value(); });
  hand.click("reload.yes");
  hand.wait_until("it is reloaded", [&] {
    return color(hand.document().scene.materials[0], "diffuse") ==
           color(document.scene.materials[0], "diffuse");
  });
  EXPECT_EQ(hand.document().settings.display.exposure, 0.0f);
}

TEST(ViewerFilesUi, ReadingIsGivenUp) {
  ScratchFolder folder;
  const std::string path = folder / "large.obj";
  {
    std::ofstream out(path);
    out << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 3000000; ++i) out << "f 1 2 3\n";
  }
  ViewerHarness hand;
  hand.wait_for_picture();
  const Document before = hand.document();
  hand.send(FilesDropped{{path}});
  hand.frame(1, 0.5);
  hand.frame(1, 0.5);
  ASSERT_TRUE(hand.find("working.cancel")) << "it takes long";
  hand.wait_until("it tells how far it is", [&] { return hand.state().loaded > 0.02; });
  EXPECT_LT(hand.state().loaded, 1);
  hand.screenshot("reading");
  hand.key(Key::escape);
  EXPECT_FALSE(hand.state().reading);
  hand.wait_until("the reader has ended", [&] { return hand.state().loading == 0; });
  hand.frame(2);
  EXPECT_EQ(hand.document(), before);
  EXPECT_EQ(hand.state().error, "");
  EXPECT_FALSE(hand.find("working.cancel"));
}

TEST(ViewerFilesUi, BuildingIsGivenUpForTheSceneBefore) {
  ScratchFolder folder;
  write_text(folder / "triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string path = folder / "triangle.json";
  write_text(path,
             R"({"candela": 1, "meshes": {"t": {"file": "triangle.obj"}}, "instances": [{"mesh": "t"}]})");
  BuildGate gate(false);
  ViewerHarness hand(test_document(), {.on_build = gate.hook()});
  hand.wait_for_picture();
  const Document before = hand.document();
  const std::string title = hand.viewer.title();
  const auto geometry = hand.viewer.session().scene();
  gate.close();
  for (bool by_key : {false, true}) {
    if (by_key)
      hand.control(Key::y, false, 2); // what was given up is redone
    else
      open(hand, path);
    hand.wait_until("it is being built", [&] { return hand.state().status.phase == SessionPhase::building; });
    hand.frame(1, 2);
    ASSERT_TRUE(hand.find("working")) << "it takes long";
    if (by_key) {
      hand.key(Key::escape);
    } else {
      hand.screenshot("building");
      hand.click("working.cancel");
    }
    hand.wait_for_picture();
    EXPECT_EQ(hand.document(), before);
    EXPECT_EQ(hand.viewer.title(), title);
    EXPECT_EQ(&hand.viewer.session().scene()->geometry(), &geometry->geometry());
    EXPECT_EQ(hand.viewer.session().status().builds_cancelled, by_key ? 2u : 1u);
    EXPECT_FALSE(hand.find("working.cancel"));
    EXPECT_EQ(hand.state().redo_name.empty(), false);
  }
}

// There is nothing to go back to.
TEST(ViewerFilesUi, TheFirstSceneIsNotGivenUp) {
  BuildGate gate(true);
  ViewerHarness hand(test_document(), {.on_build = gate.hook()});
  hand.wait_until("it is being built", [&] { return hand.state().status.phase == SessionPhase::building; });
  hand.frame(1, 2);
  ASSERT_TRUE(hand.find("working"));
  EXPECT_FALSE(hand.find("working.cancel"));
  gate.open();
  hand.wait_for_picture();
  EXPECT_FALSE(hand.find("working"));
}

TEST(ViewerFilesUi, TheLayoutIsRemembered) {
  ScratchFolder folder;
  const fs::path preferences = fs::path(folder.path()) / "deep" / "preferences.json";
  const std::string path = folder / "room.json";
  write_candela_json(test_document(), path);
  {
    ViewerHarness hand(test_document(), {.size = {1000, 640}, .preferences = preferences});
    hand.click("panel.statistics");
    hand.unfold("panel.objects", "list.objects");
    open(hand, path);
    hand.control(Key::equal, false, 2);
  }
  ASSERT_TRUE(fs::exists(preferences));
  ViewerHarness hand(test_document(), {.preferences = preferences});
  EXPECT_FALSE(hand.find("statistics.progress"));
  EXPECT_TRUE(hand.find("list.objects"));
  EXPECT_EQ(hand.state().recent, std::vector<std::string>{fs::canonical(path).string()});
  EXPECT_GT(hand.state().scale, 1.0f);
  std::string warning;
  EXPECT_EQ(read_preferences(preferences, warning).window, ivec2(1000, 640));
  EXPECT_EQ(warning, "");
  hand.unfold("panel.scenes", "list.recent");
  hand.reveal("list.recent");
  hand.click("recent/0");
  hand.wait_until("it is open", [&] { return hand.state().scene_path == fs::canonical(path).string(); });
}

TEST(Preferences, SurviveARoundTrip) {
  ScratchFolder folder;
  Preferences p;
  p.window = {1920, 1000};
  p.text_zoom = 1.25f;
  p.speed_factor = 3;
  p.panels_visible = false;
  p.open_sections = {{"panel.camera", true}, {"group.path", false}};
  for (int i = 0; i < 30; ++i) add_recent(p, folder / ("scene" + std::to_string(i % 15) + ".json"));
  EXPECT_EQ(p.recent.size(), 10u);
  EXPECT_NE(p.recent.front().find("scene14"), std::string::npos);
  write_preferences(p, folder / "p.json");
  std::string warning;
  EXPECT_EQ(read_preferences(folder / "p.json", warning), p);
  EXPECT_EQ(warning, "");
}

TEST(Preferences, HostileOnesAreLeftOut) {
  ScratchFolder folder;
  std::string deep(100000, '[');
  for (const std::string& text :
       {std::string("{"), std::string("7"), std::string("[]"), deep, std::string("\0\xff", 2),
        std::string(R"({"window_width": -5, "text_zoom": 1e99, "recent": ["relative.json", 7, "/abs.json"],
                        "open_sections": {"panel.camera": true, "x": 3}, "panels_visible": "yes"})")}) {
    write_text(folder / "p.json", text);
    std::string warning;
    const Preferences p = read_preferences(folder / "p.json", warning);
    EXPECT_NE(warning, "") << text.substr(0, 40);
    EXPECT_EQ(p.window, Preferences().window);
    EXPECT_EQ(p.text_zoom, 1);
    EXPECT_TRUE(p.panels_visible);
    for (const std::string& path : p.recent) EXPECT_EQ(path, "/abs.json");
  }
  std::string warning;
  EXPECT_EQ(read_preferences(folder / "none.json", warning), Preferences());
  EXPECT_EQ(warning, "") << "the first start is no reason for one";
}

} // namespace
} // namespace candela::test
