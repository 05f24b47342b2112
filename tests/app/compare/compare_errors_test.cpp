// Measurements of a comparison: errors against a reference, and noise without one.

#include "app/compare/compare_testing.h"
#include "imaging/compare.h"
#include "imaging/difference.h"
#include "io/images/texels_reader.h"
#include "render/film/film_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

TEST(CompareErrorsUi, AReferenceGivesErrorsThatFall) {
  ScratchFolder folder;
  ViewerHarness hand(noisy_document(0), {.screenshot_folder = folder.path()});
  begin(hand);
  hand.choose("compare.reference_spp", "256");
  hand.click("compare.render_reference");
  hand.frame(2);
  EXPECT_TRUE(compare(hand).rendering_reference);
  hand.wait_until("the reference is there", [&] { return compare(hand).has_reference; });
  // Restarted, so that the curves begin with few samples.
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
  // The same value as from the command.
  const Image& reference = *hand.viewer.comparison().reference_image();
  hand.wait_until("the last picture is measured", [&] {
    return hand.viewer.session().status().phase == SessionPhase::paused &&
           compare(hand).variants[1].rel_mse ==
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

  // Another view: the reference does not apply until the view returns.
  hand.key_down(Key::w);
  hand.frame(3);
  hand.key_up(Key::w);
  hand.frame(3);
  EXPECT_FALSE(compare(hand).has_reference);
  EXPECT_FALSE(compare(hand).variants[0].rel_mse.has_value());
  EXPECT_EQ(compare(hand).plot.y.label, "noise (est. relMSE)");
  hand.key(Key::home);
  hand.frame(3);
  EXPECT_TRUE(compare(hand).has_reference);
}

TEST(CompareErrorsUi, NoiseIsEstimatedWithoutAReference) {
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
  auto is_measured = [&](int variant, const RenderSession& session) {
    const auto frame = session.latest();
    return session.status().phase == SessionPhase::paused &&
           compare(hand).variants[static_cast<std::size_t>(variant)].noise ==
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

  // A reference gives relMSE instead.
  hand.choose("compare.reference_spp", "64");
  hand.key(Key::k);
  hand.click("compare.render_reference");
  hand.wait_until("the error is known", [&] { return compare(hand).variants[1].rel_mse.has_value(); });
  EXPECT_EQ(compare(hand).plot.y.label, "relMSE");

  // Other views have no noise estimate.
  hand.unfold("panel.display", "display.exposure");
  hand.choose("view", "samples");
  hand.wait_until("nothing is estimated", [&] { return !compare(hand).variants[1].noise; });
}

TEST(CompareErrorsUi, ReferencesComeFromFilesAndVariants) {
  ScratchFolder folder;
  Document document = noisy_document(4);
  ViewerHarness hand(document);
  begin(hand);
  wait_for_both(hand);
  write_linear_image({64, 48, std::vector<vec3>(64 * 48, vec3(0.5f))}, folder / "good.pfm");
  write_linear_image({9, 9, std::vector<vec3>(81, vec3(0.5f))}, folder / "small.exr");
  auto load = [&](const std::string& path) {
    hand.click("compare.reference_path");
    hand.control(Key::a);
    hand.type(path);
    hand.click("compare.load_reference");
  };
  load(folder / "good.pfm");
  hand.wait_until("the file is read", [&] { return compare(hand).has_reference; });
  EXPECT_EQ(compare(hand).reference, "good.pfm");
  hand.wait_until("errors are known", [&] { return compare(hand).variants[0].rel_mse.has_value(); });
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
  hand.wait_until("B has no error against itself", [&] { return compare(hand).variants[1].rel_mse == 0.0; });
  EXPECT_GT(*compare(hand).variants[0].rel_mse, 0);
}

} // namespace
} // namespace candela::test
