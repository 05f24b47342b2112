// The window as a whole: picture, size, files, input.

#include "app/harness.h"
#include "core/color.h"
#include "io/candela/candela_json.h"
#include "io/images/image_file.h"
#include "session/offline_render.h"

#include <fmt/format.h>

#include <fstream>

/// Mesa keeps a few kilobytes per context until the process ends; LeakSanitizer calls this function for
/// suppressions.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so"; }

namespace candela::test {
namespace {

namespace fs = std::filesystem;

/// The part of the framebuffer that the rectangle covers.
std::vector<std::uint8_t> region(const ViewerHarness& hand, const PixelRect& rect) {
  const std::vector<std::uint8_t> all = hand.pixels();
  std::vector<std::uint8_t> out;
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    const auto row = all.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * hand.size().x + rect.x);
    out.insert(out.end(), row, row + static_cast<std::ptrdiff_t>(4) * rect.width);
  }
  return out;
}

/// Waits until the initial hint over the picture is gone.
void wait_for_hint_to_go(ViewerHarness& hand) { hand.frame(2, 11); }

TEST(ViewerWindowUi, ThePictureOnTheScreenIsTheHeadlessOneBitForBit) {
  ViewerHarness hand(test_document(), {.size = {320, 240}, .fit_film = true});
  hand.key(Key::tab);
  wait_for_hint_to_go(hand);
  hand.wait_for_picture();
  const PixelRect rect = hand.viewer.picture_rect();
  ASSERT_EQ(rect, (PixelRect{0, 0, 320, 240}));
  const std::vector<std::uint8_t> screen = region(hand, rect);
  EXPECT_EQ(screen, hand.viewer.session().display()->rgba);

  const OfflineResult headless = render_document(hand.document());
  EXPECT_EQ(hand.viewer.session().latest()->linear, headless.film.image().pixels);
}

TEST(ViewerWindowUi, PanelsCoverThePictureButDoNotRestartIt) {
  ViewerHarness hand(test_document(), {.size = {900, 500}, .fit_film = true});
  hand.wait_for_picture();
  wait_for_hint_to_go(hand);
  const std::uint64_t restarts = hand.viewer.session().status().restarts;
  const PixelRect with_panels = hand.viewer.picture_rect();
  EXPECT_EQ(with_panels.width, 900) << "a film pixel is a screen pixel, panels or not";
  EXPECT_TRUE(hand.find("panel.render"));
  hand.key(Key::tab);
  hand.frame(2);
  EXPECT_EQ(hand.viewer.widgets().size(), 0u) << "Tab hides everything";
  EXPECT_EQ(hand.viewer.picture_rect(), (PixelRect{0, 0, 900, 500}));
  hand.key(Key::tab);
  hand.frame(2);
  EXPECT_TRUE(hand.find("panel.render"));
  EXPECT_EQ(hand.viewer.picture_rect(), with_panels);
  hand.wait_for_picture();
  EXPECT_EQ(hand.viewer.session().status().restarts, restarts);
}

TEST(ViewerWindowUi, AFixedFilmIsLetterboxedOnNeutralGrey) {
  ViewerHarness hand; // 64 x 48
  hand.wait_for_picture();
  hand.key(Key::tab);
  wait_for_hint_to_go(hand);
  const PixelRect rect = hand.viewer.picture_rect();
  EXPECT_EQ(rect, (PixelRect{160, 0, 960, 720})); // 4:3 on 1280 x 720
  const std::vector<std::uint8_t> frame = region(hand, {0, 0, 160, 720});
  for (std::size_t i = 0; i < frame.size(); i += 4)
    ASSERT_TRUE(frame[i] == frame[i + 1] && frame[i] == frame[i + 2] && frame[i] < 40);
  // Magnified by 15 without a filter: each film pixel is a square of equal pixels.
  const auto shown = hand.viewer.viewport().shown();
  const std::vector<std::uint8_t> screen = region(hand, rect);
  for (int y = 0; y < 720; y += 7)
    for (int x = 0; x < 960; x += 7)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(screen[4 * static_cast<std::size_t>(y * 960 + x) + c],
                  shown->rgba[4 * static_cast<std::size_t>(y / 15 * 64 + x / 15) + c])
            << x << ' ' << y;
}

TEST(ViewerWindowUi, TheFilmFollowsTheWindow) {
  ViewerHarness hand(test_document(), {.size = {300, 200}, .fit_film = true});
  hand.wait_for_picture();
  EXPECT_EQ(hand.document().settings.film.width, 300);
  hand.resize({411, 233});
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().picture->width, 411);
  EXPECT_EQ(hand.state().picture->height, 233);
}

TEST(ViewerWindowUi, AnySizeOfWindowWillDo) {
  Document document = test_document();
  document.settings.stop.spp = 1;
  ViewerHarness hand(document, {.size = {640, 360}, .fit_film = true});
  for (ivec2 size : {ivec2(1, 1), ivec2(3840, 2160), ivec2(0, 0), ivec2(37, 1200), ivec2(2000, 3)}) {
    SCOPED_TRACE(fmt::format("{} x {}", size.x, size.y));
    hand.resize(size, size.x > 3000 ? 2.0f : 1.0f);
    hand.frame(3);
    hand.wait_for_picture(300);
    EXPECT_EQ(hand.state().picture->width, std::max(size.x, 1));
  }
}

TEST(ViewerWindowUi, EditingTheFilmSizeFixesIt) {
  ViewerHarness hand(test_document(), {.size = {900, 500}, .fit_film = true});
  hand.unfold("group.film", "film.width");
  hand.type_into("film.width", "80");
  EXPECT_FALSE(hand.state().fit_film);
  EXPECT_EQ(hand.document().settings.film.width, 80);
  hand.choose("film.size", "fit window");
  EXPECT_TRUE(hand.state().fit_film);
  EXPECT_EQ(hand.document().settings.film.width, 900);
}

TEST(ViewerWindowUi, DroppedScenesOpenBesideTheRunningOne) {
  ScratchFolder folder;
  const std::string scene = folder / "good.json";
  Document good = test_document();
  good.scene.instances.pop_back();
  write_candela_json(good, scene);
  ViewerHarness hand;
  hand.wait_for_picture();
  const Document before = hand.document();

  const std::string broken = folder / "broken.json";
  write_text(broken, "{\n  \"camera\": 7,,\n}");
  hand.send(FilesDropped{{broken}});
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  EXPECT_NE(hand.state().error.find("broken.json"), std::string::npos) << hand.state().error;
  EXPECT_EQ(hand.document(), before) << "the old scene goes on";
  EXPECT_EQ(hand.viewer.session().status().phase, SessionPhase::finished);
  hand.frame(3);
  hand.screenshot("error_strip");
  hand.click("error.dismiss");
  hand.frame(2);
  EXPECT_FALSE(hand.find("error.text"));

  hand.send(FilesDropped{{folder / "missing.json"}});
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  EXPECT_NE(hand.state().error.find("missing.json"), std::string::npos) << hand.state().error;

  hand.send(FilesDropped{{scene}});
  hand.wait_until("the scene is open", [&] { return hand.state().scene_path == scene; });
  EXPECT_EQ(hand.state().error, "");
  EXPECT_EQ(hand.document().scene.instances.size(), before.scene.instances.size() - 1);
  EXPECT_EQ(hand.viewer.title(), "good.json - Candela");
  hand.wait_for_picture();
}

TEST(ViewerWindowUi, AScenePathIsTyped) {
  ViewerHarness hand;
  hand.unfold("panel.scenes", "scene.path");
  hand.click("scene.path");
  hand.type("/nowhere/w.json"); // its letters must not fly
  const Camera camera = hand.document().scene.camera;
  hand.click("scene.open");
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  EXPECT_NE(hand.state().error.find("/nowhere/w.json"), std::string::npos) << hand.state().error;
  EXPECT_EQ(hand.document().scene.camera, camera);
}

TEST(ViewerWindowUi, EveryBundledSceneOpens) {
  ViewerHarness hand;
  hand.unfold("panel.scenes", "scene.path");
  ASSERT_FALSE(hand.state().scenes.empty());
  for (std::size_t i = 0; i < hand.state().scenes.size(); ++i) {
    const std::string path = hand.state().scenes[i].string();
    SCOPED_TRACE(path);
    hand.send(FilesDropped{{path}});
    hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
    EXPECT_EQ(hand.state().error, "");
  }
}

TEST(ViewerWindowUi, SavingNeverOverwrites) {
  ScratchFolder folder;
  write_text(folder / "candela-0001.exr", "someone else's");
  ViewerHarness hand(test_document(), {.screenshot_folder = folder.path()});
  hand.wait_for_picture();
  hand.key(Key::p);
  hand.wait_until("the files are named", [&] { return hand.state().notice.starts_with("Saved"); });
  EXPECT_NE(hand.state().notice.find("candela-0002.png"), std::string::npos) << hand.state().notice;
  EXPECT_FALSE(fs::exists(folder / "candela-0001.png"));
  EXPECT_EQ(fs::file_size(folder / "candela-0001.exr"), 14u);

  const auto shown = hand.viewer.viewport().shown();
  const Image linear = read_image(folder / "candela-0002.exr");
  EXPECT_EQ(linear.pixels, shown->frame->linear);
  const Image png = read_image(folder / "candela-0002.png");
  ASSERT_EQ(png.width, 64);
  for (std::size_t i = 0; i < png.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::lround(255 * srgb_from_linear(png.pixels[i][c])),
                shown->rgba[4 * i + static_cast<std::size_t>(c)]);

  hand.click("save");
  hand.wait_until("the second pair is there", [&] { return fs::exists(folder / "candela-0003.exr"); });
}

TEST(ViewerWindowUi, AFolderThatCannotBeWrittenToIsReported) {
  ViewerHarness hand(test_document(), {.screenshot_folder = "/nowhere/at/all"});
  hand.wait_for_picture();
  hand.key(Key::p);
  hand.wait_until("the error shows", [&] { return hand.find("error.text").has_value(); });
  EXPECT_NE(hand.state().error.find("/nowhere/at/all"), std::string::npos) << hand.state().error;
}

TEST(ViewerWindowUi, HelpComesAndGoes) {
  ViewerHarness hand;
  EXPECT_TRUE(hand.find("hint")) << "the first seconds say where help is";
  hand.key(Key::f1);
  hand.frame(2);
  EXPECT_TRUE(hand.find("help.close"));
  hand.key(Key::escape);
  hand.frame(2);
  EXPECT_FALSE(hand.find("help.close"));
  hand.key(Key::f1);
  hand.frame(2);
  hand.click("help.close");
  hand.frame(2);
  EXPECT_FALSE(hand.find("help.close"));
  wait_for_hint_to_go(hand);
  EXPECT_FALSE(hand.find("hint"));
}

TEST(ViewerWindowUi, ControlQCloses) {
  ViewerHarness hand;
  hand.key(Key::q);
  EXPECT_FALSE(hand.viewer.wants_close());
  const Camera before = hand.document().scene.camera;
  // All within one frame, with control released first, as from a fast user.
  for (auto [key, down] : {std::pair(Key::left_control, true), std::pair(Key::q, true),
                           std::pair(Key::left_control, false), std::pair(Key::q, false)})
    hand.viewer.handle(KeyChanged{key, down});
  while (hand.viewer.has_pending_events()) hand.frame();
  EXPECT_TRUE(hand.viewer.wants_close());
  EXPECT_EQ(hand.document().scene.camera, before);
}

TEST(ViewerWindowUi, AFinishedPictureIsNotDrawnAgain) {
  ViewerHarness hand;
  hand.wait_for_picture();
  wait_for_hint_to_go(hand);
  hand.frame(10);
  EXPECT_FALSE(hand.viewer.wants_redraw());
  EXPECT_GT(hand.viewer.idle_seconds(), 1.0);
  hand.viewer.handle(MouseMoved{{10, 10}});
  EXPECT_TRUE(hand.viewer.wants_redraw());
}

TEST(ViewerWindowUi, EveryWidgetIsTouched) {
  ViewerHarness hand;
  hand.unfold_all();
  std::vector<std::string> names;
  for (const WidgetRecord& widget : hand.viewer.widgets()) names.push_back(widget.name);
  EXPECT_GT(names.size(), 60u);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    if (name.starts_with("panel.") || name.starts_with("group.") || name.starts_with("scenes/") ||
        name == "save" || !hand.find(name))
      continue;
    const vec2 at = hand.reveal(name);
    hand.click(at);
    hand.key(Key::escape); // a choice's list, a picker
    hand.click(at);
    hand.key(Key::escape);
    hand.scroll(at, 1);
    EXPECT_EQ(document_problem(hand.document()), "");
  }
}

TEST(ViewerWindowUi, ManyFastEventsAreAllSeen) {
  ViewerHarness hand;
  const vec2 at = hand.reveal("panel.statistics");
  hand.pause();
  // A move, three clicks and their releases within one frame: the fold is closed, open, closed.
  hand.viewer.handle(MouseMoved{at});
  for (int i = 0; i < 3; ++i) {
    hand.viewer.handle(MouseButtonChanged{MouseButton::left, true});
    hand.viewer.handle(MouseButtonChanged{MouseButton::left, false});
  }
  while (hand.viewer.has_pending_events()) hand.frame();
  hand.frame(2);
  EXPECT_FALSE(hand.find("statistics.progress"));
}

TEST(ViewerWindowUi, NothingIsCutOff) {
  for (auto [size, scale] : {std::pair(ivec2(1280, 720), 1.0f), std::pair(ivec2(3840, 2160), 2.0f)}) {
    Document document = test_document();
    document.settings.stop.spp = 1;
    ViewerHarness hand(document, {.size = size, .scale = scale});
    hand.wait_for_picture(300); // rows that tell of it appear with it
    hand.unfold_all();
    hand.frame(2);
    for (const WidgetRecord& widget : hand.viewer.widgets()) {
      SCOPED_TRACE(fmt::format("{} at {} x {}", widget.name, size.x, size.y));
      EXPECT_GE(widget.lo.x, widget.clip_lo.x - 1);
      EXPECT_LE(widget.hi.x, widget.clip_hi.x + 1);
      EXPECT_LE(widget.hi.x, static_cast<float>(size.x));
      if (!widget.name.ends_with("#label")) continue;
      const std::string owner = widget.name.substr(0, widget.name.size() - 6);
      for (const char* part : {"", ".x", ".swatch"}) {
        const auto beside = hand.find(owner + part);
        if (beside) { EXPECT_LT(widget.hi.x, beside->lo.x); }
      }
    }
  }
}

TEST(ViewerScreenshotsUi, LeavesPicturesOfItself) {
  for (auto [size, scale] : {std::pair(ivec2(1280, 720), 1.0f), std::pair(ivec2(3840, 2160), 2.0f)}) {
    Document document = test_document();
    document.settings.stop.spp = scale > 1 ? 1 : 8;
    ViewerHarness hand(document, {.size = size, .scale = scale, .fit_film = true});
    hand.wait_for_picture(300);
    const std::string name = fmt::format("{}x{}", size.x, size.y);
    hand.screenshot(name + "_first");
    hand.key(Key::f1);
    hand.frame(3);
    hand.screenshot(name + "_help");
    hand.key(Key::f1);
    hand.unfold_all();
    hand.reveal("override.brdf");
    hand.frame(2);
    hand.screenshot(name + "_render");
    hand.reveal("scene.path");
    hand.reveal("panel.materials");
    hand.click("materials/1");
    hand.frame(2);
    hand.screenshot(name + "_scene");
    hand.move(hand.reveal("path.light_sampling"));
    hand.frame(2);
    hand.screenshot(name + "_tooltip");
    EXPECT_TRUE(fs::exists(screenshot_path(name + "_tooltip.png")));
  }
}

} // namespace
} // namespace candela::test
