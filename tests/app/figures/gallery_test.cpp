#include "app/cli/gallery_command.h"
#include "app/console/denoised_picture.h"
#include "app/console/picture_output.h"
#include "core/error.h"
#include "io/images/image_file.h"
#include "io/images/texels_reader.h"
#include "io/scene_reader.h"
#include "render/film/film_view.h"
#include "session/offline_render.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace candela {
namespace {

using test::ScratchFolder;

/// A small box, and a gallery of figures on it.
class GalleryFolder {
public:
  explicit GalleryFolder(const std::string& figures) {
    std::filesystem::copy_file(CANDELA_SOURCE_DIR "/scenes/cornell_flush.json", folder / "box.json");
    test::write_text(folder / "gallery.json", R"({"gallery": 1, "figures": [)" + figures + "]}");
  }
  GalleryOptions options() const {
    GalleryOptions out;
    out.file = folder / "gallery.json";
    out.folder = folder / "out";
    out.quiet = true;
    return out;
  }
  std::vector<std::uint8_t> bytes(const std::string& name) const {
    const std::string text = test::read_text(folder / ("out/" + name + ".png"));
    return {text.begin(), text.end()};
  }
  ScratchFolder folder;
};

constexpr const char* kStrategies = R"({
  "name": "strategies", "title": "Three", "scene": "box.json", "size": [48, 40], "spp": 2,
  "settings": {"path.max_depth": 2},
  "panels": [{"label": "one", "settings": {"path.light_sampling": "bsdf"}},
             {"label": "two", "settings": {"path.light_sampling": "nee"}, "spp": 4}],
  "details": [[4, 4, 12, 10]],
  "reference": {"spp": 16, "show": true}, "difference": true,
  "plot": {"spp": [1, 2, 4]}})";

std::string error_of(const std::string& figures) {
  const GalleryFolder gallery(figures);
  try {
    read_gallery(gallery.options().file);
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::limit) << error.what();
    return error.what();
  }
  return "no error";
}

TEST(Gallery, ReadsWhatTheFileSays) {
  const GalleryFolder gallery(kStrategies);
  const auto figures = read_gallery(gallery.options().file);
  ASSERT_EQ(figures.size(), 1u);
  const GalleryFigure& f = figures[0];
  EXPECT_EQ(f.title, "Three");
  EXPECT_EQ(f.size, ivec2(48, 40));
  ASSERT_EQ(f.panels.size(), 2u);
  EXPECT_EQ(f.panels[0].settings, (std::vector<std::string>{"path.max_depth=2", "path.light_sampling=bsdf"}));
  EXPECT_EQ(f.panels[0].spp, 2);
  EXPECT_EQ(f.panels[1].spp, 4);
  EXPECT_EQ(f.details, (std::vector<Box>{{4, 4, 12, 10}}));
  EXPECT_TRUE(f.reference->show);
  EXPECT_EQ(f.plot->spp, (std::vector<int>{1, 2, 4}));
  EXPECT_FALSE(f.plain);
}

TEST(Gallery, ErrorsTellWhereAndWhy) {
  struct Case {
    const char* figure;
    const char* says;
  };
  const Case cases[] = {
      {R"({"scene": "box.json"})", "figures[0]: it has no name"},
      {R"({"name": "../up", "scene": "box.json"})", "figures[0].name: it is no name of a file"},
      {R"({"name": "a"})", "figures[0]: it has no scene"},
      {R"({"name": "a", "scene": "none.json"})", "figures[0].scene"},
      {R"({"name": "a", "scene": "/etc/passwd"})", "figures[0].scene"},
      {R"({"name": "a", "scene": "box.json", "size": [10]})", "figures[0].size: 1 elements"},
      {R"({"name": "a", "scene": "box.json", "size": [0, 10]})", "figures[0].size"},
      {R"({"name": "a", "scene": "box.json", "spp": 0})", "figures[0].spp: '0' does not fit"},
      {R"({"name": "a", "scene": "box.json", "colums": 2})", "did you mean 'columns'?"},
      {R"({"name": "a", "scene": "box.json", "settings": {"path.max_dept": 2}})",
       "did you mean 'path.max_depth'?"},
      {R"({"name": "a", "scene": "box.json", "settings": {"path.max_depth": "x"}})", "path.max_depth"},
      {R"({"name": "a", "scene": "box.json", "settings": {"stop.spp": 3}})", "has a key of its own"},
      {R"({"name": "a", "scene": "box.json", "panels": []})", "figures[0].panels: it is empty"},
      {R"({"name": "a", "scene": "box.json", "panels": [{}], "difference": true})", "need a reference"},
      {R"({"name": "a", "scene": "box.json", "difference": true})", "a plain picture"},
      {R"({"name": "a", "scene": "box.json", "size": [8, 8], "panels": [{}], "details": [[4, 4, 5, 1]]})",
       "figures[0].details[0]: '5' does not fit"},
      {R"({"name": "a", "scene": "box.json", "panels": [{}], "reference": {}, "plot": {"spp": [4, 2]}})",
       "figures[0].plot: \"spp\" does not rise"},
      {R"({"name": "a", "scene": "box.json", "panels": [{}], "reference": {}, "plot": {"x": "time"}})",
       "there is no axis 'time'"},
      {R"({"name": "a", "size": [16384, 16384], "scene": "box.json"})", "too many pixels"},
      {R"({"name": "a", "scene": "box.json"}, {"name": "a", "scene": "box.json"})",
       "figures[1]: the name 'a' is taken"},
      {"7", "figures[0]: a number does not fit"},
  };
  for (const Case& c : cases) {
    const std::string error = error_of(c.figure);
    EXPECT_NE(error.find(c.says), std::string::npos) << c.figure << "\n  gave " << error;
    EXPECT_NE(error.find("gallery.json:1:"), std::string::npos) << error;
  }
}

TEST(Gallery, TheShippedOneReadsAndItsSettingsFit) {
  const auto figures = read_gallery(CANDELA_SOURCE_DIR "/scenes/gallery.json");
  EXPECT_GE(figures.size(), 4u);
}

TEST(GalleryRender, APlainPictureIsTheRendersOwn) {
  const GalleryFolder gallery(
      R"({"name": "plain", "scene": "box.json", "size": [24, 20], "spp": 3, "settings": {"sampler.seed": 5}})");
  EXPECT_EQ(run_gallery(gallery.options()), 0);
  Document document = read_scene(gallery.folder / "box.json").document;
  document.settings.film.width = 24;
  document.settings.film.height = 20;
  document.settings.sampler.seed = 5;
  document.settings.stop = {};
  document.settings.stop.spp = 3;
  const OfflineResult result = render_document(document);
  const auto written = read_texels(gallery.folder / "out/plain.png");
  EXPECT_EQ(written->width, 24);
  EXPECT_EQ(written->height, 20);
  EXPECT_EQ(srgb8_texels(*written), displayed_srgb8(result.film.image(), document.settings.display,
                                                    document.settings.view, result.display_scale));
}

TEST(GalleryRender, APictureMayBeDenoisedOrAnotherView) {
  const GalleryFolder gallery(
      R"({"name": "smooth", "scene": "box.json", "size": [24, 20], "spp": 4,
          "settings": {"display.denoise": true}},
         {"name": "spread", "scene": "box.json", "size": [24, 20], "spp": 4, "settings": {"view": "variance"}})");
  EXPECT_EQ(run_gallery(gallery.options()), 0);
  Document document = read_scene(gallery.folder / "box.json").document;
  document.settings.film.width = 24;
  document.settings.film.height = 20;
  document.settings.stop = {};
  document.settings.stop.spp = 4;
  document.settings.display.denoise = true;
  OfflineResult result = render_document(document);
  const auto denoised = denoised_picture(document, result, {});
  ASSERT_TRUE(denoised);
  EXPECT_EQ(
      srgb8_texels(*read_texels(gallery.folder / "out/smooth.png")),
      displayed_srgb8(denoised->image, document.settings.display, View::radiance, result.display_scale));
  document.settings.view = View::variance;
  result = render_document(document);
  EXPECT_EQ(srgb8_texels(*read_texels(gallery.folder / "out/spread.png")),
            displayed_srgb8(view_image(result.film, View::variance), document.settings.display,
                            View::variance, result.display_scale));
}

TEST(GalleryRender, FiguresHoldPanelsDifferencesAndPlot) {
  const GalleryFolder gallery(kStrategies);
  EXPECT_EQ(run_gallery(gallery.options()), 0);
  const Image figure = read_image(gallery.folder / "out/strategies.png");
  EXPECT_GT(figure.width, 3 * 190); // three columns of the least width
  EXPECT_GT(figure.height, 2 * 40 + 320);
  // The relative errors are there: magma's colours are no greys.
  int colored = 0;
  for (vec3 p : figure.pixels) colored += p.x > 1.5f * p.y && p.z > 1.2f * p.y && p.z > 0.02f;
  EXPECT_GT(colored, 200);
}

TEST(GalleryRender, TheSameBytesButForTheSeconds) {
  const GalleryFolder gallery(R"({"name": "one", "scene": "box.json", "size": [32, 32], "spp": 2})");
  run_gallery(gallery.options());
  const auto first = gallery.bytes("one");
  GalleryOptions again = gallery.options();
  again.threads = 1;
  run_gallery(again);
  EXPECT_EQ(gallery.bytes("one"), first);
  again.quick = true;
  run_gallery(again);
  EXPECT_EQ(read_image(gallery.folder / "out/one.png").width, 16);
}

TEST(GalleryRender, NamesChooseAndListSays) {
  const GalleryFolder gallery(R"({"name": "first", "scene": "box.json", "size": [8, 8], "spp": 1},
                                 {"name": "second", "scene": "box.json", "size": [8, 8], "spp": 1})");
  GalleryOptions options = gallery.options();
  options.names = {"second"};
  run_gallery(options);
  EXPECT_FALSE(std::filesystem::exists(gallery.folder / "out/first.png"));
  EXPECT_TRUE(std::filesystem::exists(gallery.folder / "out/second.png"));
  options.names = {"secnd"};
  try {
    run_gallery(options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("second"), std::string::npos);
  }
  options.names.clear();
  options.list = true;
  testing::internal::CaptureStdout();
  run_gallery(options);
  std::fflush(stdout);
  const std::string list = testing::internal::GetCapturedStdout();
  EXPECT_NE(list.find("first"), std::string::npos);
  EXPECT_NE(list.find("box.json"), std::string::npos);
}

TEST(GalleryRender, SettingsThatBreakTheDocumentAreRefused) {
  const GalleryFolder gallery(R"({"name": "bad", "scene": "box.json", "size": [8, 8], "spp": 1,
    "settings": {"camera.position": [0, 0, 0], "camera.target": [0, 0, 0]}})");
  try {
    run_gallery(gallery.options());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("figure 'bad'"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(gallery.folder / "out/bad.png"));
}

} // namespace
} // namespace candela
