// Typed and displayed numbers, dropped files, stored window sizes, typefaces, the process deadline.

#include "app/figures/typeface.h"
#include "app/platform/process_deadline.h"
#include "app/tools/transform_parts.h"
#include "app/ui/typed_number.h"
#include "app/ui/ui_style.h"
#include "app/viewer/dropped_files.h"
#include "app/viewer/preferences.h"
#include "io/files/text_file.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

TEST(TypedNumber, ADecimalCommaIsAComma) {
  EXPECT_EQ(typed_number("1,5"), 1.5);
  EXPECT_EQ(typed_number("1.5"), 1.5);
  EXPECT_EQ(typed_number(" -0,25\t"), -0.25);
  EXPECT_EQ(typed_number("+3"), 3.0);
  EXPECT_EQ(typed_number(",5"), 0.5);
  EXPECT_EQ(typed_number("5,"), 5.0);
  EXPECT_EQ(typed_number("1,5e3"), 1500.0);
  EXPECT_EQ(typed_number("2E-2"), 0.02);
  EXPECT_EQ(typed_number("1,234"), 1.234) << "a comma is never a mark of thousands";
}

TEST(TypedNumber, WhatIsNoNumberIsRefused) {
  for (const char* text : {"",     " ",   "2+3",  "2*3", "1,234.5", "1.234,5", "1,2,3",   "1.2.3", "1 2",
                           "0x10", "inf", "nan",  "e5",  "1e",      "1e+",     "--1",     "+-1",   "+",
                           ".",    ",",   "five", "1m",  "10%",     "1e400",   "\xc2\xbd"})
    EXPECT_EQ(typed_number(text), std::nullopt) << text;
}

TEST(PlainNumber, HasNoExponentWhereItCanBeWrittenOut) {
  EXPECT_EQ(plain_number(123456, 3), "123456");
  EXPECT_EQ(plain_number(123456, 4), "123456");
  EXPECT_EQ(plain_number(-1234567, 4), "-1234567");
  EXPECT_EQ(plain_number(9999.6, 4), "9999.6");
  EXPECT_EQ(plain_number(9999.96, 4), "10000");
  EXPECT_EQ(plain_number(0.12345, 4), "0.1235");
  EXPECT_EQ(plain_number(1.5, 4), "1.5");
  EXPECT_EQ(plain_number(0, 4), "0");
  EXPECT_EQ(plain_number(1e12, 4), "1e+12") << "which nobody could count the zeros of";
}

TEST(PlainNumber, OneIsSingular) {
  EXPECT_EQ(unit_of("1", "stops"), "stop");
  EXPECT_EQ(unit_of("-1", "stops"), "stop");
  EXPECT_EQ(unit_of("1.5", "stops"), "stops");
  EXPECT_EQ(unit_of("0", "samples"), "samples");
  EXPECT_EQ(unit_of("1", "W/sr"), "W/sr");
  EXPECT_EQ(scene_units(1), "1 scene unit");
  EXPECT_EQ(scene_units(2.5f), "2.5 scene units");
  EXPECT_EQ(counted(1, "warning"), "1 warning");
  EXPECT_EQ(counted(2, "warning"), "2 warnings");
}

TEST(WindowSize, IsRememberedForEver) {
  for (int percent = 100; percent <= 400; ++percent) {
    const float scale = static_cast<float>(percent) / 100;
    for (int side = 64; side < 4000; side += 37)
      ASSERT_EQ(size_at_scale_one(size_at_scale(ivec2(side), scale), scale), ivec2(side)) << scale;
  }
}

TEST(TransformParts, TurnAndScaleAboutTheMiddle) {
  const vec3 middle(3, -2, 5);
  const mat4 before = transform_of({{10, 20, 30}, {0, 40, 0}, {1, 2, 3}});
  for (const TransformParts& typed : {TransformParts{{10, 20, 30}, {0, 40, 0}, {-1, 2, 3}},
                                      TransformParts{{10, 20, 30}, {70, 10, -20}, {1, 2, 3}}}) {
    const TransformParts parts = about_middle(before, typed, middle);
    EXPECT_EQ(parts.rotation, typed.rotation);
    EXPECT_EQ(parts.scale, typed.scale);
    EXPECT_LT(glm::length(transform_point(transform_of(parts), middle) - transform_point(before, middle)),
              1e-4f);
  }
}

TEST(DroppedFiles, TheFirstSceneIsOpenedAndTheRestIsTold) {
  ScratchFolder folder;
  const std::string a = folder / "a.json", b = folder / "b.json", sky = folder / "sky.hdr";
  EXPECT_EQ(choose_dropped({a}).open, a);
  EXPECT_EQ(choose_dropped({a}).remark, "");
  const Dropped two = choose_dropped({sky, b, a});
  EXPECT_EQ(two.open, b);
  EXPECT_NE(two.remark.find("sky.hdr, a.json"), std::string::npos) << two.remark;
  const std::string obj = folder / "kite.obj", mtl = folder / "kite.mtl";
  const Dropped model = choose_dropped({mtl, obj});
  EXPECT_EQ(model.open, obj);
  EXPECT_EQ(model.remark, "") << "the materials go with their model";
  EXPECT_EQ(choose_dropped({folder / "other.mtl", obj}).remark, "left aside: other.mtl (one at a time)");
  EXPECT_EQ(choose_dropped({sky}).open, sky);
}

TEST(DroppedFiles, AFolderStandsForTheOneSceneInIt) {
  ScratchFolder folder;
  const fs::path inside = fs::path(folder.path()) / "scene";
  fs::create_directory(inside);
  EXPECT_EQ(choose_dropped({inside.string()}).open, "");
  EXPECT_NE(choose_dropped({inside.string()}).remark.find("no scene in it"), std::string::npos);
  for (const char* name : {"part.obj", "other.obj", "sky.hdr", "notes.txt"})
    write_text((inside / name).string(), "");
  EXPECT_NE(choose_dropped({inside.string()}).remark.find("2 scenes (other.obj, part.obj)"),
            std::string::npos)
      << choose_dropped({inside.string()}).remark;
  write_text((inside / "room.json").string(), "");
  EXPECT_EQ(choose_dropped({inside.string()}).open, (inside / "room.json").string())
      << "which names the models";
  write_text((inside / "hall.xml").string(), "");
  EXPECT_EQ(choose_dropped({inside.string()}).open, "");
}

TEST(Letters, OfOtherScriptsComeFromTheTypefacesThatHaveThem) {
  constexpr char32_t kAlef = 0x5d0; // which DejaVu has and Roboto has not
  EXPECT_EQ(code_points("a\xd7\x90"), (std::vector<char32_t>{U'a', kAlef}));
  EXPECT_FALSE(is_common_glyph(kAlef));
  bool anybody = false;
  for (const fs::path& file : find_fallback_typefaces()) anybody |= Typeface(file).has(kAlef);
  if (!anybody) GTEST_SKIP() << "no typeface with other scripts is installed";
  ImFontAtlas without, with;
  EXPECT_EQ(load_fonts(without, 1).regular->FindGlyphNoFallback(static_cast<ImWchar>(kAlef)), nullptr);
  const UiFonts fonts = load_fonts(with, 1, {kAlef, 0x4e2d, 0xe000});
  ASSERT_NE(fonts.regular->FindGlyphNoFallback(static_cast<ImWchar>(kAlef)), nullptr);
  EXPECT_NE(fonts.regular->FindGlyphNoFallback('a'), nullptr);
  EXPECT_EQ(fonts.regular->FindGlyphNoFallback(0xe000), nullptr) << "nobody has it, and nothing breaks";
}

TEST(ProcessDeadlineDeathTest, EndsWhatHangs) {
  EXPECT_EXIT(
      {
        ProcessDeadline deadline(0.05);
        std::this_thread::sleep_for(std::chrono::minutes(5)); // a thread that cannot be stopped
      },
      testing::ExitedWithCode(0), "");
  { const ProcessDeadline kept(600); } // and leaves alone what does not
}

} // namespace
} // namespace candela::test
