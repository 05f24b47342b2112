// The lab over the picture: every page by its widgets, with screenshots.

#include "app/harness.h"
#include "lab/lessons.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

class LabHand : public ViewerHarness {
public:
  explicit LabHand(const HarnessOptions& options = {}) : ViewerHarness(test_document(), options) {
    key(Key::f2);
    frame(2);
  }
  const LabPanel& lab() const { return viewer.lab(); }

  /// Scrolls the lab until the widget is visible, and returns its centre.
  vec2 reveal_in_lab(const std::string& name) {
    for (int i = 0; i < 200; ++i) {
      const auto widget = find(name);
      if (!widget) break;
      if (is_visible(*widget)) return 0.5f * (widget->lo + widget->hi);
      scroll({3, 300}, widget->lo.y < widget->clip_lo.y + 1 ? 2.0f : -2.0f);
      frame();
    }
    ADD_FAILURE() << name << " is not visible";
    return vec2(-1);
  }
  void open_page(std::string_view lesson) {
    click(reveal_in_lab(fmt::format("lab/{}", lesson)));
    frame(2);
  }
  void choose_in_lab(const std::string& name, const std::string& item) {
    click(reveal_in_lab(name));
    frame(2);
    click(name + "/" + item);
    frame(2);
  }
  void type_in_lab(const std::string& name, const std::string& text) {
    const vec2 at = reveal_in_lab(name);
    key_down(Key::left_control);
    click(at);
    key_up(Key::left_control);
    type(text);
    key(Key::enter);
    frame(2);
  }
  void finish_lesson() {
    for (int i = 0; i < 1000 && lab().busy(); ++i) { // a frame of a large window costs more than a slice
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      frame();
    }
    EXPECT_FALSE(lab().busy());
    frame();
  }
  /// RGBA of a widget's pixels.
  std::vector<std::uint8_t> under(const std::string& name) {
    reveal_in_lab(name);
    const auto widget = find(name);
    const auto all = pixels();
    std::vector<std::uint8_t> out;
    for (int y = static_cast<int>(widget->lo.y); y < static_cast<int>(widget->hi.y); ++y) {
      const auto row = static_cast<std::ptrdiff_t>(4 * (y * size().x));
      out.insert(out.end(), all.begin() + row + 4 * static_cast<std::ptrdiff_t>(widget->lo.x),
                 all.begin() + row + 4 * static_cast<std::ptrdiff_t>(widget->hi.x));
    }
    return out;
  }
};

TEST(ViewerLabUi, OpensAndClosesByKeyAndButton) {
  LabHand hand;
  EXPECT_TRUE(hand.state().lab_visible);
  EXPECT_TRUE(hand.find("lab.look_at"));
  hand.click(hand.reveal_in_lab("lab.close"));
  hand.frame(2);
  EXPECT_FALSE(hand.find("lab.look_at"));
  hand.click("lab.open"); // in the column of panels
  hand.frame(2);
  EXPECT_TRUE(hand.find("lab.look_at"));
  hand.key(Key::f2);
  EXPECT_FALSE(hand.state().lab_visible);
}

TEST(ViewerLabUi, NoLessonRunsWhileItIsClosed) {
  LabHand hand;
  hand.type_in_lab("lab.samples", "1000000000");
  EXPECT_TRUE(hand.lab().busy());
  hand.key(Key::f2);
  hand.wait_until("the last slice is done", [&] { return !hand.lab().running(); });
  for (int i = 0; i < 5; ++i) {
    hand.frame();
    EXPECT_FALSE(hand.lab().running());
  }
  EXPECT_TRUE(hand.lab().busy()) << "it went on to the end";
  hand.key(Key::f2);
  hand.frame();
  EXPECT_TRUE(hand.lab().running());
}

TEST(ViewerLabUi, EveryPageComesToItsEndAndFits) {
  for (auto [size, scale, name] :
       {std::tuple{ivec2(1280, 720), 1.0f, "1280x720"}, {ivec2(3840, 2160), 2.0f, "3840x2160"}}) {
    HarnessOptions options;
    options.size = size;
    options.scale = scale;
    LabHand hand(options);
    for (const LessonInfo& info : lessons()) {
      SCOPED_TRACE(info.name);
      hand.open_page(info.name);
      hand.finish_lesson();
      hand.move(vec2(1)); // no tooltip
      hand.frame();
      hand.screenshot(fmt::format("{}_lab_{}", name, info.name));
      const auto window = hand.find("lab.look_at");
      ASSERT_TRUE(window);
      for (const WidgetRecord& widget : hand.viewer.widgets())
        if (widget.name.starts_with("lab") && widget.name != "lab.open") {
          EXPECT_LE(widget.hi.x, window->clip_hi.x + 1) << widget.name << " is cut off";
          EXPECT_GE(widget.lo.x, window->clip_lo.x - 1) << widget.name;
        }
      if (scale > 1) continue; // most fits without scrolling
      hand.scroll({3, 300}, -100);
      hand.frame(2);
      hand.screenshot(fmt::format("{}_lab_{}_below", name, info.name));
    }
  }
}

TEST(ViewerLabUi, EverySamplerIsOfferedOnEveryPage) {
  LabHand hand;
  for (const LessonInfo& info : lessons()) {
    hand.open_page(info.name);
    hand.click(hand.reveal_in_lab("lab.sampler.type"));
    hand.frame(2);
    for (std::string_view sampler : find_setting("sampler.type")->choices)
      EXPECT_TRUE(hand.find(fmt::format("lab.sampler.type/{}", sampler))) << info.name << ' ' << sampler;
    hand.key(Key::escape);
    hand.frame(2);
  }
}

TEST(ViewerLabUi, AnEditShowsAnotherLesson) {
  struct Case {
    const char *page, *widget, *text, *canvas;
    bool choice;
  };
  LabHand hand;
  for (const Case& c : {Case{"pi", "lab.sampler.type", "independent", "lab.picture", true},
                        Case{"pi", "lab.sampler.seed", "7", "lab.picture", false},
                        Case{"solid-angle", "lab.sampling", "disc", "lab.picture", true},
                        Case{"integral", "lab.integrand", "peak", "lab.picture", true},
                        Case{"integral", "lab.cells", "8", "lab.picture", false},
                        Case{"points", "lab.points", "64", "lab.picture", false},
                        Case{"points", "lab.y", "lens.y", "lab.picture", true},
                        Case{"warps", "lab.warp", "triangle", "lab.domain", true},
                        Case{"brdf", "lab.roughness", "0.8", "lab.lobe", false},
                        Case{"brdf", "lab.type", "phong", "lab.lobe", true}}) {
    SCOPED_TRACE(testing::Message() << c.page << ' ' << c.widget);
    hand.open_page(c.page);
    hand.finish_lesson();
    const auto before = hand.under(c.canvas);
    if (c.choice)
      hand.choose_in_lab(c.widget, c.text);
    else
      hand.type_in_lab(c.widget, c.text);
    hand.finish_lesson();
    EXPECT_NE(before, hand.under(c.canvas));
  }
  // The render's sampler is independent of the lab's.
  EXPECT_EQ(hand.document().settings.sampler, SamplerSettings{});
}

TEST(ViewerLabUi, EverySamplersErrorIsPlottedAtOnce) {
  LabHand hand;
  hand.type_in_lab("lab.samples", "2000");
  hand.finish_lesson();
  const auto before = hand.under("lab.plot");
  hand.click(hand.reveal_in_lab("lab.every_sampler"));
  hand.finish_lesson();
  EXPECT_NE(before, hand.under("lab.plot"));
  hand.screenshot("1280x720_lab_every_sampler");
}

TEST(ViewerLabUi, TheMouseTurnsTheLobeAndNotTheCamera) {
  LabHand hand;
  hand.open_page("brdf");
  hand.finish_lesson();
  const Camera camera = hand.document().scene.camera;
  const auto before = hand.under("lab.lobe");
  const vec2 middle = hand.reveal_in_lab("lab.lobe");
  hand.drag(middle, middle + vec2(60, 20));
  const auto turned = hand.under("lab.lobe");
  EXPECT_NE(before, turned);
  hand.move(middle);
  hand.press(MouseButton::right);
  hand.move(middle - vec2(0, 40));
  hand.release(MouseButton::right);
  hand.finish_lesson();
  EXPECT_NE(turned, hand.under("lab.lobe"));
  hand.screenshot("1280x720_lab_brdf_turned");
  EXPECT_EQ(hand.document().scene.camera, camera);
}

} // namespace
} // namespace candela::test
