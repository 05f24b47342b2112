// Comparisons of two settings in the window.

#include "app/compare/compare_testing.h"
#include "imaging/difference.h"
#include "io/candela/candela_json.h"
#include "render/film/film_view.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

/// The screen's pixel at the middle of a film pixel.
vec3 screen_at(const ViewerHarness& hand, const std::vector<std::uint8_t>& screen, const PixelRect& picture,
               ivec2 film, int x, int y) {
  const int sx = picture.x + (2 * x + 1) * picture.width / (2 * film.x);
  const int sy = picture.y + (2 * y + 1) * picture.height / (2 * film.y);
  const auto i = 4 * static_cast<std::size_t>(sy * hand.size().x + sx);
  return {screen[i], screen[i + 1], screen[i + 2]};
}

vec3 shown_at(const DisplayImage& image, int x, int y) {
  const auto i = 4 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
}

/// Compares a pane's lower half (labels are above) with what the session shows.
void expect_shows(const ViewerHarness& hand, const ComparePanes::Pane& pane, const DisplayImage& image) {
  const std::vector<std::uint8_t> screen = hand.pixels();
  int compared = 0;
  for (int y = image.height / 2; y < image.height; y += 5)
    for (int x = 0; x < image.width; x += 3) {
      const int sx = pane.picture.x + (2 * x + 1) * pane.picture.width / (2 * image.width);
      const int sy = pane.picture.y + (2 * y + 1) * pane.picture.height / (2 * image.height);
      if (sx < pane.clip.x + 12 || sx >= pane.clip.x + pane.clip.width - 12 ||
          sy >= pane.clip.y + pane.clip.height)
        continue;
      ++compared;
      ASSERT_EQ(screen_at(hand, screen, pane.picture, {image.width, image.height}, x, y),
                shown_at(image, x, y))
          << x << ' ' << y;
    }
  EXPECT_GT(compared, 20);
}

TEST(ViewerCompareUi, BothVariantsAreRenderedAndShown) {
  ViewerHarness hand(noisy_document(8));
  hand.wait_for_picture();
  begin(hand);
  EXPECT_EQ(compare(hand).edited, 1) << "the panels change B";
  wait_for_both(hand);
  const RenderSession& b = hand.viewer.session();
  const RenderSession& a = *hand.viewer.comparison().other_session();
  EXPECT_EQ(hand.document().settings.sampler.type, SamplerType::independent);
  EXPECT_EQ(hand.viewer.comparison().other_document().settings.sampler.type, SamplerType::sobol);
  EXPECT_NE(a.latest()->linear, b.latest()->linear);
  EXPECT_EQ(compare(hand).variants[1].label, "sampler.type=independent");
  const ComparePanes panes = hand.viewer.compare_panes();
  EXPECT_LE(panes.variants[0].clip.x + panes.variants[0].clip.width, panes.variants[1].clip.x);
  expect_shows(hand, panes.variants[0], *a.display());
  expect_shows(hand, panes.variants[1], *b.display());

  // A's accumulation is restarted neither by the comparison nor when the panels switch to A.
  EXPECT_EQ(a.status().restarts, 1u);
  hand.choose("compare.edited", "A");
  EXPECT_EQ(hand.document().settings.sampler.type, SamplerType::sobol);
  expect_shows(hand, hand.viewer.compare_panes().variants[0], *hand.viewer.session().display());
  EXPECT_EQ(hand.viewer.session().status().restarts, 1u);
}

TEST(ViewerCompareUi, WipeFlipAndDifference) {
  ViewerHarness hand(noisy_document(8));
  begin(hand);
  wait_for_both(hand);
  const auto a = hand.viewer.comparison().other_session()->display();
  const auto b = hand.viewer.session().display();

  hand.key(Key::n);
  ASSERT_EQ(compare(hand).layout, CompareLayout::wipe);
  hand.frame(2);
  ComparePanes panes = hand.viewer.compare_panes();
  expect_shows(hand, panes.variants[0], *a);
  expect_shows(hand, panes.variants[1], *b);
  const Camera before = hand.document().scene.camera;
  const vec2 divider(static_cast<float>(panes.divider), 300);
  hand.drag(divider, divider - vec2(200, 0));
  EXPECT_NEAR(hand.viewer.compare_panes().divider, panes.divider - 200, 2);
  EXPECT_EQ(hand.document().scene.camera, before) << "the divider moved, not the camera";
  expect_shows(hand, hand.viewer.compare_panes().variants[1], *b);

  hand.key(Key::n);
  ASSERT_EQ(compare(hand).layout, CompareLayout::flip);
  hand.frame(2);
  expect_shows(hand, hand.viewer.compare_panes().variants[0], *a);
  hand.key(Key::b);
  hand.frame(2);
  EXPECT_TRUE(compare(hand).flipped);
  expect_shows(hand, hand.viewer.compare_panes().variants[1], *b);
  hand.key_down(Key::b); // held, it shows the other variant only so long
  hand.frame(20);
  EXPECT_FALSE(compare(hand).flipped);
  hand.key_up(Key::b);
  hand.frame(2);
  EXPECT_TRUE(compare(hand).flipped);

  hand.key(Key::n);
  ASSERT_EQ(compare(hand).layout, CompareLayout::difference);
  hand.wait_until("the difference is there",
                  [&] { return hand.viewer.comparison().difference() != nullptr; });
  hand.frame(2);
  const auto difference = hand.viewer.comparison().difference();
  EXPECT_EQ(difference->rgba, difference_rgba8(a->frame->linear, b->frame->linear, false, 0.1f));
  const auto unsigned_rgba = difference->rgba;
  hand.choose("compare.range", "-10 to 10 %");
  hand.wait_until("its sign shows",
                  [&] { return hand.viewer.comparison().difference()->rgba != unsigned_rgba; });
  EXPECT_EQ(hand.viewer.comparison().difference()->rgba,
            difference_rgba8(a->frame->linear, b->frame->linear, true, 0.1f));
}

TEST(ViewerCompareUi, WhatIsSharedAndWhatIsNot) {
  ViewerHarness hand(noisy_document(4));
  begin(hand);
  auto other = [&]() -> const Document& { return hand.viewer.comparison().other_document(); };
  hand.key_down(Key::w);
  hand.frame(3);
  hand.key_up(Key::w);
  hand.frame(2);
  EXPECT_NE(hand.document().scene.camera, test_document().scene.camera);
  EXPECT_EQ(other().scene.camera, hand.document().scene.camera) << "flying moves both";
  hand.choose("compare.camera", "each its own");
  hand.key(Key::home);
  hand.frame(2);
  EXPECT_NE(other().scene.camera, hand.document().scene.camera);

  hand.unfold("panel.display", "display.exposure");
  hand.type_into("display.exposure", "2");
  EXPECT_EQ(other().settings.display.exposure, 2) << "a fair comparison has one exposure";
  EXPECT_NE(other().settings.sampler.type, hand.document().settings.sampler.type);

  // Each variant has its own undo.
  hand.choose("compare.edited", "A");
  hand.unfold("group.path", "path.max_depth");
  hand.type_into("path.max_depth", "3");
  hand.frame(2, 0.6);
  hand.choose("compare.edited", "B");
  EXPECT_EQ(hand.document().settings.path.max_depth, -1);
  EXPECT_EQ(other().settings.path.max_depth, 3);
  hand.choose("compare.edited", "A");
  hand.control(Key::z);
  hand.frame(2);
  EXPECT_EQ(hand.document().settings.path.max_depth, -1);

  // Copies in both directions; closing keeps the variant that the panels edit.
  hand.click("compare.copy_b");
  hand.frame(2);
  EXPECT_EQ(hand.document().settings.sampler.type, SamplerType::independent);
  hand.key(Key::c);
  hand.frame(2);
  EXPECT_FALSE(compare(hand).active);
  EXPECT_EQ(hand.viewer.comparison().other_session(), nullptr);
  EXPECT_EQ(hand.document().settings.sampler.type, SamplerType::independent);
  hand.wait_for_picture();
}

TEST(ViewerCompareUi, PausingStepsAndOpeningAScene) {
  ScratchFolder folder;
  write_candela_json(test_document(), folder / "scene.json");
  ViewerHarness hand(noisy_document(0)); // endless
  begin(hand);
  hand.wait_until("both render", [&] {
    return compare(hand).variants[0].status.spp > 4 && compare(hand).variants[1].status.spp > 4;
  });
  hand.key(Key::k);
  hand.wait_until("both are paused", [&] {
    return compare(hand).variants[0].status.phase == SessionPhase::paused &&
           compare(hand).variants[1].status.phase == SessionPhase::paused;
  });
  const int a = compare(hand).variants[0].status.spp, b = compare(hand).variants[1].status.spp;
  hand.key(Key::l);
  hand.wait_until("both made a step", [&] {
    return compare(hand).variants[0].status.spp == a + 1 && compare(hand).variants[1].status.spp == b + 1;
  });
  hand.send(FilesDropped{{folder / "scene.json"}});
  hand.wait_until("the comparison ends", [&] { return !compare(hand).active; });
}

TEST(ViewerCompareUi, Screenshots) {
  struct Size {
    const char* name;
    ivec2 size;
    float scale;
  };
  for (const Size& s : {Size{"1280x720", {1280, 720}, 1.0f}, Size{"3840x2160", {3840, 2160}, 2.0f}}) {
    Document document = noisy_document(4);
    document.settings.film.width = 144; // quick
    document.settings.film.height = 81;
    ViewerHarness hand(document, {.size = s.size, .scale = s.scale});
    begin(hand);
    hand.choose("compare.reference_spp", "64");
    hand.click("compare.render_reference");
    hand.wait_until("the reference is there", [&] { return compare(hand).has_reference; });
    hand.choose("path.light_sampling", "bsdf");
    wait_for_both(hand);
    hand.wait_until("errors are known",
                    [&] { return compare(hand).variants[0].rel_mse && compare(hand).variants[1].rel_mse; });
    hand.click("group.sampler"); // fold again what is long
    hand.reveal("panel.compare");
    hand.frame(3);
    for (const char* layout : {"side_by_side", "wipe", "flip", "difference"}) {
      if (compare(hand).layout == CompareLayout::difference)
        hand.wait_until("the difference is there",
                        [&] { return hand.viewer.comparison().difference() != nullptr; });
      hand.move({400, 300});
      hand.frame(3);
      hand.screenshot(fmt::format("{}_compare_{}", s.name, layout));
      hand.key(Key::n);
      hand.frame(3);
    }
    hand.reveal("compare.export");
    hand.frame(3);
    hand.screenshot(fmt::format("{}_compare_plot", s.name));
  }
}

} // namespace
} // namespace candela::test
