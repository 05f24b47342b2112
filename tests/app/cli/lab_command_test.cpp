// `candela lab`, run as a process.

#include "lab/lessons.h"
#include "scene/document.h"
#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

namespace candela {
namespace {

struct LabOutcome {
  int code = -1;
  std::string out, err;
};

LabOutcome lab(const std::string& arguments) {
  test::ScratchFolder scratch;
  const std::string out = scratch / "out.txt", err = scratch / "err.txt";
  const int status =
      std::system(fmt::format("'{}' lab {} >'{}' 2>'{}'", CANDELA_PROGRAM, arguments, out, err).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::read_text(out), test::read_text(err)};
}

nlohmann::json lab_json(const std::string& arguments) {
  const LabOutcome o = lab(arguments + " --json");
  EXPECT_EQ(o.code, 0) << o.err;
  return nlohmann::json::parse(o.out);
}

TEST(LabCommand, EveryLessonSaysWhatToLookAtAndGivesJson) {
  for (const LessonInfo& info : lessons()) {
    const LabOutcome text = lab(fmt::format("{} --samples 100", info.name));
    EXPECT_EQ(text.code, 0) << text.err;
    if (info.name != "points") { // CSV
      EXPECT_NE(text.out.find(info.look_at), std::string::npos) << text.out;
    }
    EXPECT_EQ(lab_json(fmt::format("{} --samples 100", info.name))["lesson"], info.name);
    const LabOutcome help = lab(fmt::format("{} --help", info.name));
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("--sampler"), std::string::npos) << help.out;
  }
}

TEST(LabCommand, PiCountsAMillionPointsByDefault) {
  const auto j = lab_json("pi");
  EXPECT_EQ(j["samples"], 1000000);
  EXPECT_EQ(j["hits"].get<int>() + j["misses"].get<int>(), 1000000);
  EXPECT_NEAR(j["estimate"], 4e-6 * j["hits"].get<double>(), 1e-12);
  EXPECT_DOUBLE_EQ(j["error"], j["estimate"].get<double>() - j["expected"].get<double>());
  EXPECT_NEAR(j["error"], 0, 0.001); // Sobol' points, and the seed is fixed
  EXPECT_EQ(j["trace"].back()["n"], 1000000);
  const LabOutcome text = lab("pi");
  EXPECT_NE(text.out.find(fmt::format("hits                {}", j["hits"].get<int>())), std::string::npos)
      << text.out;
  EXPECT_NE(text.err.find("1000000 samples"), std::string::npos) << text.err;
}

TEST(LabCommand, IsReplayedByItsSeed) {
  EXPECT_EQ(lab_json("pi --samples 500 --seed 4"), lab_json("pi --samples 500 --seed 4"));
  EXPECT_NE(lab_json("pi --samples 500 --seed 4")["estimate"],
            lab_json("pi --samples 500 --seed 5")["estimate"]);
}

TEST(LabCommand, KnowsTheAnswers) {
  EXPECT_NEAR(lab_json("solid-angle --samples 1")["expected"], 1.840302, 1e-6);
  EXPECT_NEAR(lab_json("solid-angle --sampling disc")["estimate"], 1.840302, 1e-4);
  EXPECT_DOUBLE_EQ(lab_json("integral --samples 1")["expected"], 1.0 / 3);
  EXPECT_NEAR(lab_json("integral --integrand step --samples 4096")["estimate"], 0.3, 1e-3);
  const auto streams = lab_json("integral --cells 64 --streams 8 --samples 64");
  EXPECT_EQ(streams["streams"], 8);
  EXPECT_LT(streams["standard_deviation"], 0.01);
  EXPECT_NEAR(lab_json("brdf --material diffuse --diffuse 0.25 --samples 100")["albedo"][1], 0.25, 1e-5);
}

TEST(LabCommand, EverySamplerOfTheTableIsOffered) {
  std::string header = "n";
  for (std::string_view sampler : find_setting("sampler.type")->choices) {
    EXPECT_EQ(lab_json(fmt::format("pi --samples 64 --sampler {}", sampler))["sampler"], sampler);
    header += fmt::format(",{}", sampler);
  }
  const LabOutcome curves = lab("points --curve --samples 32");
  ASSERT_EQ(curves.code, 0) << curves.err;
  EXPECT_EQ(curves.out.substr(0, curves.out.find('\n')), header);
  EXPECT_EQ(std::ranges::count(curves.out, '\n'), 7); // the header, and 1 to 32 points
  EXPECT_EQ(lab_json("points --curve --samples 32")["discrepancy"]["sobol"].size(), 6u);
}

TEST(LabCommand, PointsAreCsv) {
  const LabOutcome o = lab("points --samples 8 --x film.y --y bsdf_direction.x@2 --pixel-x 3");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(o.out.starts_with("film.y,bsdf_direction.x@2\n")) << o.out;
  EXPECT_EQ(std::ranges::count(o.out, '\n'), 9);
  const auto j = lab_json("points --samples 8 --x film.y --y bsdf_direction.x@2 --pixel-x 3");
  EXPECT_EQ(j["points"].size(), 8u);
  EXPECT_EQ(j["pixel"][0], 3);
  EXPECT_NE(o.out.find(fmt::format("\n{},", j["points"][0][0].get<float>())), std::string::npos) << o.out;
}

TEST(LabCommand, DensitiesFitTheirHistograms) {
  for (const char* lesson : {"warps --warp cone --cone-angle 20", "brdf --roughness 0.5"}) {
    const auto j = lab_json(fmt::format("{} --sampler independent --samples 50000", lesson));
    EXPECT_GT(j["chi_square"]["p_value"], 1e-6) << lesson;
    EXPECT_LE(j["pdf_integral"], 1.00001) << lesson;
    double total = j["histogram"]["outside"];
    for (double count : j["histogram"]["observed"]) total += count;
    EXPECT_EQ(total, 50000) << lesson;
  }
}

TEST(LabCommand, BadArgumentsAreUsageErrorsWithARemedy) {
  struct Case {
    const char* arguments;
    const char* remedy;
  };
  for (const Case& c :
       {Case{"", "solid-angle"}, Case{"solid-angel", "did you mean solid-angle"},
        Case{"pi --samples 0", "from 1 to"}, Case{"pi --samples many", "an integer"},
        Case{"pi --sampler dice", "one of independent"}, Case{"pi --streams -1", "from 1 to"},
        Case{"pi --cells 4", "--cells"}, Case{"pi now", "now"},
        Case{"integral --cells 5000", "from 0 to 4096"}, Case{"integral --integrand cube", "one of square"},
        Case{"solid-angle --sampling cube", "one of sphere"}, Case{"points --x lense", "lens"},
        Case{"points --samples 100000", "65536"}, Case{"warps --cone-angle 181", "from 0.1 to 180"},
        Case{"brdf --roughness 2", "from 0 to 1"}, Case{"brdf --theta 90", "89.9"},
        Case{"brdf --material velvet", "one of diffuse"}}) {
    const LabOutcome o = lab(c.arguments);
    EXPECT_EQ(o.code, 2) << c.arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(c.remedy), std::string::npos) << c.arguments << "\n" << o.err;
    EXPECT_EQ(o.out, "") << c.arguments;
  }
}

} // namespace
} // namespace candela
