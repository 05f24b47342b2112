// `candela bench scale`: the generated files, the measurements, the report.

#include "app/bench/scale_report.h"
#include "app/bench/scale_scenes.h"
#include "app/platform/separate_process.h"
#include "core/error.h"
#include "io/images/image_file.h"
#include "io/scene_reader.h"
#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>

namespace candela {
namespace {

constexpr ScaleDetail kTiny{32, 16, 32};

Error error_of(const std::function<std::string()>& work) {
  try {
    run_separately(work);
  } catch (const Error& e) { return e; }
  return {ExitCode::done, "nothing was thrown"};
}

TEST(SeparateProcess, ReturnsWhatTheWorkReturns) {
  EXPECT_EQ(run_separately([] { return std::string(100'000, 'x') + '\0' + "y"; }),
            std::string(100'000, 'x') + '\0' + "y");
  EXPECT_EQ(run_separately([] { return std::string(); }), "");
  int changed = 0;
  run_separately([&] { return std::to_string(++changed); });
  EXPECT_EQ(changed, 0); // it was another process's
}

TEST(SeparateProcess, ThrowsWhatTheWorkThrows) {
  const Error error = error_of([]() -> std::string { throw Error(ExitCode::bad_input, "a: b: c"); });
  EXPECT_EQ(error.code(), ExitCode::bad_input);
  EXPECT_STREQ(error.what(), "a: b: c");
  EXPECT_EQ(error_of([]() -> std::string { throw std::bad_alloc(); }).code(), ExitCode::limit);
  auto raised = [](int signal) {
    return error_of([signal] {
      std::raise(signal);
      return std::string();
    });
  };
  EXPECT_EQ(raised(SIGKILL).code(), ExitCode::limit);
  EXPECT_EQ(raised(SIGINT).code(), ExitCode::interrupted);
}

TEST(ScaleScenes, ReadBackWithoutWarnings) {
  test::ScratchFolder folder;
  write_scale_assets(folder.path(), kTiny);
  const LoadedScene landscape = read_scene(write_landscape(folder.path(), "hills", 2'000));
  EXPECT_TRUE(landscape.warnings.empty());
  const SceneDesc& hills = landscape.document.scene;
  ASSERT_EQ(hills.instances.size(), 1u);
  EXPECT_GE(std::get<std::shared_ptr<const Mesh>>(hills.instances[0].shape)->triangles.size(), 2'000u);
  EXPECT_EQ(hills.textures.size(), 2u);
  ASSERT_EQ(hills.lights.size(), 1u);
  ASSERT_NE(light_panorama(hills.lights[0]), nullptr);
  EXPECT_EQ(light_panorama(hills.lights[0])->image.width, kTiny.sky);

  const LoadedScene stones = read_scene(write_stones(folder.path(), "heap", 9, 300));
  EXPECT_TRUE(stones.warnings.empty());
  ASSERT_EQ(stones.document.scene.instances.size(), 10u); // and the ground
  const auto mesh = [&](std::size_t i) {
    return std::get<std::shared_ptr<const Mesh>>(stones.document.scene.instances[i].shape);
  };
  EXPECT_EQ(mesh(1), mesh(9)); // shared
  EXPECT_EQ(mesh(1)->triangles.size(), 300u);
}

TEST(ScaleScenes, AreTheSameBytesEveryTime) {
  test::ScratchFolder a, b;
  for (const test::ScratchFolder* folder : {&a, &b}) {
    write_scale_assets(folder->path(), kTiny);
    write_landscape(folder->path(), "hills", 1'500);
    write_stones(folder->path(), "heap", 5, 100);
  }
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(a.path())) {
    const std::string name = file.path().filename().string();
    EXPECT_EQ(test::read_text(a / name), test::read_text(b / name)) << name;
    ++files;
  }
  EXPECT_EQ(files, 8);
}

TEST(ScaleBench, CountsWhatIsThere) {
  test::ScratchFolder folder;
  write_scale_assets(folder.path(), kTiny);
  SceneOptions scene;
  scene.path = write_stones(folder.path(), "heap", 50, 300);
  scene.threads = 2;
  const ScaleResult r = measure_scene(scene, "heap", {16, 9}, 2);
  EXPECT_EQ(r.name, "heap");
  EXPECT_EQ(r.placed_triangles - r.distinct_triangles, 49u * 300);
  EXPECT_GE(r.distinct_triangles, 300u); // and those of the plane, however that is made
  EXPECT_EQ(r.lights, 1u);
  EXPECT_EQ(r.threads, 2);
  EXPECT_EQ(r.width, 16);
  for (double s : {r.load_s, r.build_s, r.first_pass_s, r.samples_per_s_one, r.samples_per_s, r.speedup})
    EXPECT_GT(s, 0);
  EXPECT_GT(r.accel_bytes, 300u * 10);
  EXPECT_GT(r.scene_bytes, r.accel_bytes);
  EXPECT_GE(r.peak_bytes, r.load_peak_bytes);
  EXPECT_GT(r.load_peak_bytes, std::uint64_t{1} << 20);
}

ScaleResult result(const std::string& name, std::uint64_t triangles, double rate) {
  ScaleResult r;
  r.name = name;
  r.distinct_triangles = r.placed_triangles = triangles;
  r.threads = 2;
  r.load_s = 1.25;
  r.build_s = 0.5;
  r.first_pass_s = 0.25;
  r.samples_per_s = rate;
  r.samples_per_s_one = rate / 2;
  r.speedup = 2;
  return r;
}

TEST(ScaleReport, GoesThroughJsonUnchanged) {
  ScaleResult r = result("a \"name\"", 1'002'528, 2.5e6);
  r.peak_bytes = std::uint64_t{3} << 33;
  const ScaleResult back = scale_result(to_json(r));
  EXPECT_EQ(to_json(back), to_json(r));
  EXPECT_EQ(back.name, r.name);
  EXPECT_EQ(back.peak_bytes, r.peak_bytes);
  EXPECT_EQ(back.samples_per_s, r.samples_per_s);
  ScalePicture p{3840, 2160, 64, 2, 1, 0.5, 240, 1.25e-3, 4e-3, 12};
  EXPECT_EQ(to_json(scale_picture(to_json(p))), to_json(p));
}

TEST(ScaleReport, TablesPlotAndJson) {
  ScaleReport report;
  report.scenes = {result("landscape", 1'002'528, 2.5e6)};
  report.landscapes = {result("landscape_1000", 1'026, 4e6), result("landscape", 1'002'528, 2.5e6)};
  report.picture = ScalePicture{3840, 2160, 64, 2, 1, 0.5, 240, 1.25e-3, 4e-3, std::uint64_t{900} << 20};
  report.load = {0.25, 2};
  const std::string text = scale_tables(report, TableFormat::text);
  for (const char* part : {"1,002,528", "1.25", "0.500", "2.00", "2.50", "3840x2160", "relMSE 0.0013",
                           "900 MiB", "load was 0.2 before and 2.0"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const std::string markdown = scale_tables(report, TableFormat::markdown);
  EXPECT_TRUE(markdown.starts_with("| scene | triangles |")) << markdown;

  const Plot plot = scale_plot(report);
  ASSERT_EQ(plot.series.size(), 1u); // of stones there are none
  ASSERT_EQ(plot.series[0].points.size(), 2u);
  EXPECT_EQ(plot.series[0].points[0].x, 1'026);
  EXPECT_EQ(plot.series[0].points[0].y, 4);
  EXPECT_TRUE(plot.x.logarithmic);
  EXPECT_EQ(y_scale(plot).lo, 0);

  const auto json = nlohmann::json::parse(scale_json(report));
  EXPECT_EQ(json["landscapes"].size(), 2u);
  EXPECT_EQ(json["picture"]["spp"], 64);
  EXPECT_EQ(grouped_digits(0), "0");
  EXPECT_EQ(grouped_digits(999), "999");
  EXPECT_EQ(grouped_digits(12'345'678), "12,345,678");
}

class ScaleCommand : public testing::Test {
protected:
  test::ScratchFolder scratch;
  int run(const std::string& arguments) {
    const int status =
        std::system(fmt::format("cd '{0}' && TMPDIR='{0}' '{1}' bench scale {2} >out.txt 2>err.txt",
                                scratch.path(), CANDELA_PROGRAM, arguments)
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(ScaleCommand, KeepsItsScenesAndWritesWhatItMeasured) {
  ASSERT_EQ(run("--short -o kept --json all.json --plot plot.png --picture picture.png"), 0)
      << test::read_text(scratch / "err.txt");
  const auto json = nlohmann::json::parse(test::read_text(scratch / "all.json"));
  ASSERT_EQ(json["scenes"].size(), 4u);
  EXPECT_GE(json["scenes"][0]["distinct_triangles"], 4'000);
  EXPECT_GE(json["scenes"][1]["placed_triangles"], 20'000);
  EXPECT_EQ(json["scenes"][2]["spheres"], 10'000);
  EXPECT_GE(json["scenes"][3]["lights"], 10'000);
  EXPECT_EQ(json["landscapes"].size(), 2u);
  EXPECT_EQ(json["stones"].size(), 2u);
  EXPECT_GT(json["picture"]["relmse"], 0);
  EXPECT_LT(json["picture"]["relmse"], 3 * json["picture"]["variance_relmse"].get<double>());
  EXPECT_EQ(read_image(scratch / "picture.png").width, 96);
  EXPECT_GT(read_image(scratch / "plot.png").width, 500);
  EXPECT_TRUE(read_scene(scratch / "kept/landscape.json").warnings.empty());
  EXPECT_NE(test::read_text(scratch / "out.txt").find("many_lights"), std::string::npos);
}

TEST_F(ScaleCommand, RemovesItsTemporaryFolder) {
  ASSERT_EQ(run("--short --only stones --quiet"), 0);
  int folders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
    folders += entry.is_directory();
  EXPECT_EQ(folders, 0);
  EXPECT_EQ(test::read_text(scratch / "err.txt"), "");
}

TEST_F(ScaleCommand, MeasuresTheUsersScenesAndPassesErrorsOn) {
  const std::string box = std::string(CANDELA_TEST_SOURCE_DIR) + "/scenes/cornell_flush.json";
  ASSERT_EQ(run(fmt::format("--short '{}' --json one.json", box)), 0);
  EXPECT_EQ(nlohmann::json::parse(test::read_text(scratch / "one.json"))["scenes"].size(), 1u);
  EXPECT_EQ(run("--short missing.json"), 3);
  EXPECT_NE(test::read_text(scratch / "err.txt").find("missing.json"), std::string::npos);
  EXPECT_EQ(run("--short --plot plot.xyz"), 2);
  EXPECT_EQ(run("--only nothing"), 2);
}

} // namespace
} // namespace candela
