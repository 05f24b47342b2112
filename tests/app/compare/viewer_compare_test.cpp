// Two settings side by side, as a user compares them.

#include "app/harness.h"
#include "imaging/compare.h"
#include "imaging/difference.h"
#include "io/candela/candela_json.h"
#include "io/images/texels_reader.h"
#include "render/film/film_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

Document noisy_document(int spp) {
  Document document = test_document();
  document.settings.stop.spp = spp;
  return document;
}

const CompareState& compare(const ViewerHarness& hand) { return hand.state().compare; }

void wait_for_both(ViewerHarness& hand) {
  hand.wait_until("both sides are finished", [&] {
    const auto& sides = compare(hand).sides;
    return sides[0].status.phase == SessionPhase::finished && sides[1].status.phase == SessionPhase::finished;
  });
  hand.viewer.session().wait_finished(30);
  hand.viewer.comparison().other_session()->wait_finished(30);
  hand.frame(3, 11); // past the hints
}

/// Begins a comparison in which B has independent samples.
void begin(ViewerHarness& hand) {
  hand.key(Key::c);
  hand.frame(3);
  ASSERT_TRUE(compare(hand).active);
  hand.unfold("panel.render", "group.sampler");
  hand.unfold("group.sampler", "sampler.type");
  hand.choose("sampler.type", "independent");
}

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

TEST(ViewerCompareUi, BothSidesAreRenderedAndShown) {
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
  EXPECT_EQ(compare(hand).sides[1].label, "sampler.type=independent");
  const ComparePanes panes = hand.viewer.compare_panes();
  EXPECT_LE(panes.sides[0].clip.x + panes.sides[0].clip.width, panes.sides[1].clip.x);
  expect_shows(hand, panes.sides[0], *a.display());
  expect_shows(hand, panes.sides[1], *b.display());

  // A's picture was not begun anew by the comparison, nor is it when the panels turn to A.
  EXPECT_EQ(a.status().restarts, 1u);
  hand.choose("compare.edited", "A");
  EXPECT_EQ(hand.document().settings.sampler.type, SamplerType::sobol);
  expect_shows(hand, hand.viewer.compare_panes().sides[0], *hand.viewer.session().display());
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
  expect_shows(hand, panes.sides[0], *a);
  expect_shows(hand, panes.sides[1], *b);
  const Camera before = hand.document().scene.camera;
  const vec2 divider(static_cast<float>(panes.divider), 300);
  hand.drag(divider, divider - vec2(200, 0));
  EXPECT_NEAR(hand.viewer.compare_panes().divider, panes.divider - 200, 2);
  EXPECT_EQ(hand.document().scene.camera, before) << "the divider moved, not the camera";
  expect_shows(hand, hand.viewer.compare_panes().sides[1], *b);

  hand.key(Key::n);
  ASSERT_EQ(compare(hand).layout, CompareLayout::flip);
  hand.frame(2);
  expect_shows(hand, hand.viewer.compare_panes().sides[0], *a);
  hand.key(Key::b);
  hand.frame(2);
  EXPECT_TRUE(compare(hand).flipped);
  expect_shows(hand, hand.viewer.compare_panes().sides[1], *b);
  hand.key_down(Key::b); // held, it shows the other side only so long
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

TEST(ViewerCompareUi, AReferenceGivesErrorsThatFall) {
  ScratchFolder folder;
  ViewerHarness hand(noisy_document(0), {.screenshot_folder = folder.path()});
  begin(hand);
  hand.choose("compare.reference_spp", "256");
  hand.click("compare.render_reference");
  hand.frame(2);
  EXPECT_TRUE(compare(hand).rendering_reference);
  hand.wait_until("the reference is there", [&] { return compare(hand).has_reference; });
  // Anew, so that the curves begin with few samples.
  hand.choose("path.light_sampling", "nee");
  hand.wait_until("the plot has points", [&] {
    const Plot& plot = compare(hand).plot;
    if (plot.series.size() < 3) return false;
    const auto& points = plot.series[1].points;
    return plot.series[0].points.size() >= 2 && points.size() >= 3 && points.front().x < 100 &&
           points.back().x >= 4 * points.front().x;
  });
  const auto& points = compare(hand).plot.series[1].points;
  EXPECT_LT(points.back().y, points.front().y) << "the error falls";
  hand.key(Key::k);
  // It is what the command would say.
  const Image& reference = *hand.viewer.comparison().reference_image();
  hand.wait_until("the last picture is measured", [&] {
    return hand.viewer.session().status().phase == SessionPhase::paused &&
           compare(hand).sides[1].rel_mse ==
               relative_mse(hand.viewer.session().latest()->linear, reference.pixels);
  });
  EXPECT_TRUE(hand.find("compare.plot"));

  hand.click("compare.export");
  hand.wait_until("the figure is written", [&] { return fs::exists(folder / "candela-compare.png"); });
  hand.click("compare.export");
  hand.wait_until("another one is written", [&] { return fs::exists(folder / "candela-compare-2.png"); });
  const auto figure = read_texels(folder / "candela-compare.png");
  EXPECT_GT(figure->width, 3 * 300);
  EXPECT_GT(figure->height, 500) << "pictures and the plot";
  fs::copy_file(folder / "candela-compare.png", screenshot_path("compare_export.png"),
                fs::copy_options::overwrite_existing);

  // Another view: the reference says nothing about it, until one comes back.
  hand.key_down(Key::w);
  hand.frame(3);
  hand.key_up(Key::w);
  hand.frame(3);
  EXPECT_FALSE(compare(hand).has_reference);
  EXPECT_FALSE(compare(hand).sides[0].rel_mse.has_value());
  EXPECT_EQ(compare(hand).plot.y.label, "noise (est. relMSE)");
  hand.key(Key::home);
  hand.frame(3);
  EXPECT_TRUE(compare(hand).has_reference);
}

TEST(ViewerCompareUi, NoiseIsEstimatedWithoutAReference) {
  ScratchFolder folder;
  ViewerHarness hand(noisy_document(0), {.screenshot_folder = folder.path()});
  begin(hand);
  hand.choose("path.light_sampling", "nee");
  hand.wait_until("the plot has points", [&] {
    const Plot& plot = compare(hand).plot;
    return plot.series.size() == 3 && plot.series[1].points.size() >= 3 &&
           plot.series[1].points.back().x >= 4 * plot.series[1].points.front().x;
  });
  EXPECT_EQ(compare(hand).plot.y.label, "noise (est. relMSE)");
  const auto points = compare(hand).plot.series[1].points;
  EXPECT_LT(points.back().y, points.front().y) << "the noise falls";
  hand.key(Key::k);
  auto is_measured = [&](int side, const RenderSession& session) {
    const auto frame = session.latest();
    return session.status().phase == SessionPhase::paused &&
           compare(hand).sides[static_cast<std::size_t>(side)].noise ==
               estimated_relmse(frame->linear, frame->variance, frame->samples);
  };
  hand.wait_until("the last pictures are measured", [&] {
    return is_measured(1, hand.viewer.session()) && is_measured(0, *hand.viewer.comparison().other_session());
  });
  hand.type_into("display.exposure", "1"); // which no noise depends on
  hand.wait_until("the exposure is shown", [&] {
    const auto exposed = [](const RenderSession& session) {
      return session.display()->display.exposure == 1;
    };
    return exposed(hand.viewer.session()) && exposed(*hand.viewer.comparison().other_session());
  });
  hand.frame(2);
  EXPECT_TRUE(is_measured(0, *hand.viewer.comparison().other_session()));
  EXPECT_TRUE(is_measured(1, hand.viewer.session()));
  EXPECT_TRUE(hand.find("compare.noise"));
  EXPECT_TRUE(hand.find("compare.plot"));
  hand.click("panel.display"); // fold what is below
  hand.reveal("panel.compare");
  hand.frame(3);
  hand.screenshot("1280x720_compare_noise");
  hand.click("compare.export");
  hand.wait_until("the figure is written", [&] { return fs::exists(folder / "candela-compare.png"); });
  fs::copy_file(folder / "candela-compare.png", screenshot_path("compare_noise_export.png"),
                fs::copy_options::overwrite_existing);

  // A reference tells more.
  hand.choose("compare.reference_spp", "64");
  hand.key(Key::k);
  hand.click("compare.render_reference");
  hand.wait_until("the error is known", [&] { return compare(hand).sides[1].rel_mse.has_value(); });
  EXPECT_EQ(compare(hand).plot.y.label, "relMSE");

  // Other views have no noise to speak of.
  hand.unfold("panel.display", "display.exposure");
  hand.choose("view", "samples");
  hand.wait_until("nothing is estimated", [&] { return !compare(hand).sides[1].noise; });
}

TEST(ViewerCompareUi, ReferencesComeFromFilesAndSides) {
  ScratchFolder folder;
  Document document = noisy_document(4);
  ViewerHarness hand(document);
  begin(hand);
  wait_for_both(hand);
  write_linear_image({64, 48, std::vector<vec3>(64 * 48, vec3(0.5f))}, folder / "good.pfm");
  write_linear_image({9, 9, std::vector<vec3>(81, vec3(0.5f))}, folder / "small.exr");
  auto load = [&](const std::string& path) {
    hand.click("compare.reference_path");
    hand.key_down(Key::left_control);
    hand.key(Key::a);
    hand.key_up(Key::left_control);
    hand.type(path);
    hand.click("compare.load_reference");
  };
  load(folder / "good.pfm");
  hand.wait_until("the file is read", [&] { return compare(hand).has_reference; });
  EXPECT_EQ(compare(hand).reference, "good.pfm");
  hand.wait_until("errors are known", [&] { return compare(hand).sides[0].rel_mse.has_value(); });
  load(folder / "small.exr");
  hand.wait_until("the file is refused",
                  [&] { return compare(hand).reference.find("9 x 9") != std::string::npos; });
  EXPECT_FALSE(compare(hand).has_reference);
  load(folder / "none.exr");
  hand.wait_until("the missing file is told",
                  [&] { return hand.state().notice.find("none.exr") != std::string::npos; });
  hand.click("compare.freeze_b");
  hand.frame(2);
  EXPECT_EQ(compare(hand).reference, "B at 4 spp");
  hand.wait_until("B has no error against itself", [&] { return compare(hand).sides[1].rel_mse == 0.0; });
  EXPECT_GT(*compare(hand).sides[0].rel_mse, 0);
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

  // Each side has its own undo.
  hand.choose("compare.edited", "A");
  hand.unfold("group.path", "path.max_depth");
  hand.type_into("path.max_depth", "3");
  hand.frame(2, 0.6);
  hand.choose("compare.edited", "B");
  EXPECT_EQ(hand.document().settings.path.max_depth, -1);
  EXPECT_EQ(other().settings.path.max_depth, 3);
  hand.choose("compare.edited", "A");
  hand.key_down(Key::left_control);
  hand.key(Key::z);
  hand.key_up(Key::left_control);
  hand.frame(2);
  EXPECT_EQ(hand.document().settings.path.max_depth, -1);

  // Copies go either way; closing keeps the side that the panels show.
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
    return compare(hand).sides[0].status.spp > 4 && compare(hand).sides[1].status.spp > 4;
  });
  hand.key(Key::k);
  hand.wait_until("both are paused", [&] {
    return compare(hand).sides[0].status.phase == SessionPhase::paused &&
           compare(hand).sides[1].status.phase == SessionPhase::paused;
  });
  const int a = compare(hand).sides[0].status.spp, b = compare(hand).sides[1].status.spp;
  hand.key(Key::l);
  hand.wait_until("both made a step", [&] {
    return compare(hand).sides[0].status.spp == a + 1 && compare(hand).sides[1].status.spp == b + 1;
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
                    [&] { return compare(hand).sides[0].rel_mse && compare(hand).sides[1].rel_mse; });
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
