// Strands in binary files and in scenes: what is written is read again, and damage is told.

#include "io/curves/curves_file.h"
#include "io/scene_export.h"
#include "io/scene_files.h"
#include "support/seed.h"

#include <cstring>
#include <random>

namespace candela::test {
namespace {

Strands two_strands(CurveBasis basis, bool per_point) {
  Strands s;
  s.basis = basis;
  s.counts = {4, 7};
  for (int i = 0; i < 11; ++i) s.points.emplace_back(0.1f * static_cast<float>(i), -1.5f, 1 / 3.0f);
  s.widths = {0.02f, 0};
  if (per_point) s.widths.assign(11, 0.3f);
  return s;
}

struct CurvesFile : ::testing::Test {
  SceneFiles files;
  WarningList warnings;

  std::string error() {
    try {
      read_curves_file(files / "hair.curves", warnings);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      return e.what();
    }
    return "";
  }
  /// With a number in the place of that of a byte.
  std::string error_with(std::string bytes, std::size_t at, std::uint32_t value) {
    std::memcpy(bytes.data() + at, &value, 4);
    write_text(files / "hair.curves", bytes);
    return error();
  }
};

TEST_F(CurvesFile, ReadsWhatItWrites) {
  for (CurveBasis basis : {CurveBasis::bspline, CurveBasis::bezier})
    for (bool per_point : {false, true}) {
      Strands s = two_strands(basis, per_point);
      write_curves_file(s, files / "hair.curves");
      s.source = files / "hair.curves";
      EXPECT_EQ(*read_curves_file(s.source, warnings), s);
    }
}

TEST_F(CurvesFile, IsLaidOutAsDescribed) {
  Strands s = two_strands(CurveBasis::bezier, false);
  write_curves_file(s, files / "hair.curves");
  const std::string bytes = read_text(files / "hair.curves");
  ASSERT_EQ(bytes.size(), 8u + 5 * 4 + 2 * 4 + 11 * 12 + 2 * 4);
  EXPECT_EQ(bytes.substr(0, 8), "CNDLCRVS");
  const std::uint8_t header[] = {1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 11, 0,
                                 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 7, 0, 0,  0};
  EXPECT_EQ(std::memcmp(bytes.data() + 8, header, sizeof(header)), 0);
  const std::uint8_t minus_one_and_a_half[] = {0, 0, 0xc0, 0xbf};
  EXPECT_EQ(std::memcmp(bytes.data() + 36 + 4, minus_one_and_a_half, 4), 0) << "y of the first point";
}

TEST_F(CurvesFile, DamageIsToldWithItsPlace) {
  write_curves_file(two_strands(CurveBasis::bspline, false), files / "hair.curves");
  const std::string good = read_text(files / "hair.curves");
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(has, error_with(good, 0, 0), "hair.curves: header: it is no file of curves: ");
  EXPECT_PRED2(has, error_with(good, 8, 2), "version: 2 is not known");
  EXPECT_PRED2(has, error_with(good, 12, 7), "basis: 7 is not 0 or 1");
  EXPECT_PRED2(has, error_with(good, 16, 3), "size: 148 bytes follow");
  EXPECT_PRED2(has, error_with(good, 16, 0xffffffff), "size: ");
  EXPECT_PRED2(has, error_with(good, 20, 0xffffffff), "size: ");
  EXPECT_PRED2(has, error_with(good, 24, 3), "widths: there are 3 for 11 control points");
  EXPECT_PRED2(has, error_with(good, 28, 3), "counts: strand 0 has 3 control points");
  EXPECT_PRED2(has, error_with(good, 28, 5), "points: there are 11 for strands of 12");
  EXPECT_PRED2(has, error_with(good, 36, 0x7fc00000), "points: number 0 is not finite");
  EXPECT_PRED2(has, error_with(good, good.size() - 4, 0xbf800000), "widths: number 1 is not 0 or above");
  EXPECT_EQ(error_with(good, 12, 1), "") << "four and seven points are Bezier curves, too";
  for (std::size_t size = 0; size < good.size(); ++size) {
    write_text(files / "hair.curves", good.substr(0, size));
    ASSERT_FALSE(error().empty()) << size;
  }
  write_text(files / "hair.curves", good + "x");
  EXPECT_PRED2(has, error(), "size: ");
}

TEST_F(CurvesFile, RandomDamageIsRefusedOrGivesValidStrands) {
  write_curves_file(two_strands(CurveBasis::bspline, true), files / "hair.curves");
  const std::string good = read_text(files / "hair.curves");
  std::mt19937_64 random(fresh_seed());
  SCOPED_TRACE(seed_note());
  for (int i = 0; i < 400; ++i) {
    std::string bytes = good;
    for (int k = 0; k < 3; ++k) bytes[random() % (k == 0 ? 36 : bytes.size())] = static_cast<char>(random());
    write_text(files / "hair.curves", bytes);
    try {
      EXPECT_EQ(strands_problem(*read_curves_file(files / "hair.curves", warnings)), "");
    } catch (const Error& e) { EXPECT_EQ(e.code(), ExitCode::bad_input); }
  }
}

Document with_curves(std::shared_ptr<const Strands> strands) {
  Document document;
  document.scene.materials.emplace_back();
  CurvesShape shape;
  shape.strands = std::move(strands);
  shape.form = static_cast<int>(CurveForm::ribbon);
  shape.thickness = 0.5f;
  document.scene.instances.push_back({"hair", shape, glm::scale(mat4(1), vec3(2)), {0}});
  return document;
}

TEST_F(CurvesFile, ScenesHoldStrandsInlineBitForBit) {
  for (CurveBasis basis : {CurveBasis::bspline, CurveBasis::bezier})
    for (int widths = 0; widths < 3; ++widths) {
      Strands s = two_strands(basis, widths == 2);
      if (widths == 1) s.widths = {0.1f, 0.1f};
      if (widths == 0) s.source = "/nowhere/hair.curves"; // remembered, as meshes do
      const Document document = with_curves(std::make_shared<const Strands>(s));
      write_candela_json(document, files / "s.json");
      const LoadedScene again = files.read("s.json");
      EXPECT_TRUE(same_content(document, again.document)) << read_text(files / "s.json");
    }
}

TEST_F(CurvesFile, ScenesNameFilesAndShareThem) {
  const Strands s = two_strands(CurveBasis::bspline, false);
  write_curves_file(s, files / "hair.curves");
  files.write("s.json",
              R"({"candela": 1, "instances": [{"shape": "curves", "file": "hair.curves", "form": "ribbon"},
    {"shape": "curves", "file": "hair.curves", "thickness": 2}]})");
  const LoadedScene scene = files.read("s.json");
  const auto& first = std::get<CurvesShape>(scene.document.scene.instances.at(0).shape);
  const auto& second = std::get<CurvesShape>(scene.document.scene.instances.at(1).shape);
  EXPECT_EQ(first.strands, second.strands);
  EXPECT_EQ(first.strands->points, s.points);
  EXPECT_EQ(first.curve_form(), CurveForm::ribbon);
  EXPECT_EQ(second.thickness, 2);
  const std::string text = candela_json(scene.document, files.path());
  EXPECT_NE(text.find("\"file\": \"hair.curves\""), std::string::npos) << text;
  // Exported to another folder, the file comes along.
  const ScratchFolder elsewhere;
  const auto copied = export_candela_json(scene.document, elsewhere / "out.json");
  ASSERT_EQ(copied.size(), 1u);
  EXPECT_EQ(read_text(elsewhere / "out_files/hair.curves"), read_text(files / "hair.curves"));
  const LoadedScene again = read_scene(elsewhere / "out.json");
  EXPECT_EQ(std::get<CurvesShape>(again.document.scene.instances.at(0).shape).strands->points, s.points);
}

TEST_F(CurvesFile, MistakesInScenesAreLocated) {
  const auto error_of = [&](const std::string& members) {
    files.write("s.json", "{\"candela\": 1, \"instances\": [{\"shape\": " + members + "}]}");
    return files.error("s.json", ExitCode::bad_input);
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const std::string four = "\"strands\": [[[0,0,0],[0,0,1],[0,0,2],[0,0,3]]]";
  EXPECT_PRED2(has, error_of("\"curves\""), "s.json:1:30: instances[0]: it has no strands");
  EXPECT_PRED2(has, error_of("\"curves\", " + four), "instances[0]: it has no width");
  EXPECT_PRED2(has, error_of("\"curves\", \"strands\": [[[0,0,0]]], \"width\": 1"),
               "s.json:1:62: instances[0].strands[0]: 1 control points: give 4 or more");
  EXPECT_PRED2(has,
               error_of("\"curves\", \"basis\": \"bezier\", \"strands\": "
                        "[[[0,0,0],[0,0,1],[0,0,2],[0,0,3],[0,0,4]]], \"width\": 1"),
               "5 control points: give 4, 7, 10");
  EXPECT_PRED2(has, error_of("\"curves\", \"basis\": \"nurbs\", " + four),
               "instances[0].basis: there is no basis 'nurbs'");
  EXPECT_PRED2(has, error_of("\"curves\", \"width\": -1, " + four), "instances[0].width: -1 is below 0");
  EXPECT_PRED2(has, error_of("\"curves\", \"width\": [1, 2, 3], " + four), "instances[0].width: 3 widths");
  EXPECT_PRED2(has, error_of("\"curves\", \"widths\": [[1, 2, 3]], " + four),
               "instances[0].widths[0]: 3 widths for 4");
  EXPECT_PRED2(has, error_of("\"curves\", \"widths\": [], " + four),
               "instances[0].widths: 0 lists for 1 strands");
  EXPECT_PRED2(has, error_of("\"curves\", \"width\": 1, \"widths\": [], " + four), "both width and widths");
  EXPECT_PRED2(has, error_of("\"curves\", \"width\": 1, \"radius\": 1, " + four), "a curves has no radius");
  EXPECT_PRED2(has, error_of("\"curves\", \"thickness\": 0, \"width\": 1, " + four),
               "instances[0].thickness");
  EXPECT_PRED2(has, error_of("\"curves\", \"file\": \"no.curves\""), "instances[0].file: ");
  EXPECT_PRED2(has, error_of("\"sphere\", " + four), "instances[0]: a sphere has no strands");
  EXPECT_PRED2(has, error_of("\"sphere\", \"form\": \"ribbon\""), "a sphere has no form");
}

} // namespace
} // namespace candela::test
