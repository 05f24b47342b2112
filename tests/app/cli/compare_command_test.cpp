#include "app/cli/compare_command.h"
#include "io/images/image_file.h"
#include "io/images/texels_reader.h"
#include "support/exit_code.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace candela {
namespace {

using nlohmann::json;
using test::code_of;
using test::ScratchFolder;

Image uniform(int width, int height, float value) {
  return {width, height, std::vector<vec3>(static_cast<std::size_t>(width * height), vec3(value))};
}

TEST(CompareCommand, PrintsTheMeasuresAsJson) {
  ScratchFolder folder;
  write_linear_image(uniform(6, 4, 0.5f), folder / "a.exr");
  write_linear_image(uniform(6, 4, 0.25f), folder / "b.pfm");
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_compare(folder / "a.exr", folder / "b.pfm", folder / "diff.png"), 0);
  std::fflush(stdout);
  json out = json::parse(testing::internal::GetCapturedStdout());
  EXPECT_EQ(out["width"], 6);
  EXPECT_EQ(out["height"], 4);
  EXPECT_NEAR(out["relMSE"].get<double>(), 0.0625 / 0.0725, 1e-7);
  EXPECT_NEAR(out["MSE"].get<double>(), 0.0625, 1e-12);
  EXPECT_EQ(out["mean_ratio"], json({2.0, 2.0, 2.0}));
  EXPECT_GT(out["PSNR"].get<double>(), 0);
  EXPECT_GT(out["FLIP"].get<double>(), 0);
  EXPECT_EQ(out["nonfinite_pixels"], 0);
  auto diff = read_texels(folder / "diff.png");
  EXPECT_EQ(diff->width, 6);
  EXPECT_EQ(diff->height, 4);
}

TEST(CompareCommand, EqualPicturesHaveNoPsnr) {
  ScratchFolder folder;
  write_linear_image(uniform(2, 2, 0.5f), folder / "a.exr");
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_compare(folder / "a.exr", folder / "a.exr", std::nullopt), 0);
  std::fflush(stdout);
  json out = json::parse(testing::internal::GetCapturedStdout());
  EXPECT_TRUE(out["PSNR"].is_null());
  EXPECT_EQ(out["FLIP"], 0);
}

TEST(CompareCommand, RefusesWhatCannotBeCompared) {
  ScratchFolder folder;
  write_linear_image(uniform(2, 2, 0.5f), folder / "a.exr");
  write_linear_image(uniform(2, 3, 0.5f), folder / "b.exr");
  EXPECT_EQ(code_of([&] { run_compare(folder / "a.exr", folder / "b.exr", {}); }), ExitCode::bad_input);
  EXPECT_EQ(code_of([&] { run_compare(folder / "a.exr", folder / "none.exr", {}); }), ExitCode::bad_input);
  EXPECT_EQ(code_of([&] { run_compare(folder / "a.exr", folder / "a.exr", folder / "d.exr"); }),
            ExitCode::usage);
  EXPECT_EQ(code_of([&] { run_compare(folder / "a.exr", folder / "a.exr", folder / "d.xyz"); }),
            ExitCode::usage);
  EXPECT_EQ(code_of([&] { run_compare(folder / "a.exr", folder / "a.exr", folder / "no/d.png"); }),
            ExitCode::output);
}

} // namespace
} // namespace candela
