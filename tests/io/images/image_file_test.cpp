#include "core/color.h"
#include "io/files/atomic_file.h"
#include "io/images/image_file.h"
#include "io/images/texels_reader.h"
#include "support/exit_code.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace candela {
namespace {

using test::code_of;
using test::ScratchFolder;

/// Values over many orders of magnitude, of both signs if requested.
Image test_image(int width, int height, bool negative = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(-12, 12), sign(-1, 1);
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    vec3 v;
    for (int c = 0; c < 3; ++c) v[c] = std::exp2(exponent(random)) * (negative && sign(random) < 0 ? -1 : 1);
    image.pixels.push_back(i % 5 == 0 ? vec3(0.25f) : v); // some runs too
  }
  return image;
}

std::vector<std::uint8_t> gradient(int width, int height) {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int value : {x * 255 / std::max(1, width - 1), y * 255 / std::max(1, height - 1), 77})
        rgb.push_back(static_cast<std::uint8_t>(value));
  return rgb;
}

TEST(ImageFile, TheEndingTellsTheFormat) {
  EXPECT_EQ(image_format_of("a.png"), ImageFormat::png);
  EXPECT_EQ(image_format_of("a.b/c.d.JPEG"), ImageFormat::jpg);
  EXPECT_EQ(image_format_of("A.EXR"), ImageFormat::exr);
  EXPECT_EQ(image_format_of("x.hdr"), ImageFormat::hdr);
  EXPECT_EQ(image_format_of("x.ppm"), ImageFormat::ppm);
  EXPECT_EQ(image_format_of("x.pfm"), ImageFormat::pfm);
  for (const char* path : {"a", "a.gif", "folder.png/a", ".", ""}) {
    try {
      image_format_of(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      for (const char* known : {".png", ".jpg", ".ppm", ".exr", ".hdr", ".pfm"})
        EXPECT_NE(std::string(error.what()).find(known), std::string::npos) << error.what();
    }
  }
}

TEST(ImageFile, ExrAndPfmKeepEveryBit) {
  ScratchFolder folder;
  for (auto [width, height] : {std::pair(37, 19), {1, 1}, {1, 40}, {300, 1}}) {
    Image image = test_image(width, height, true);
    image.pixels[0] = vec3(kInfinity, -0.0f, 1e-42f);
    for (const char* name : {"a.exr", "a.pfm"}) {
      write_linear_image(image, folder / name);
      EXPECT_EQ(read_image(folder / name), image) << name;
    }
  }
}

TEST(ImageFile, ExrKeepsNanAndMetadata) {
  ScratchFolder folder;
  Image image{2, 1, {vec3(std::nanf("")), vec3(1)}};
  write_linear_image(image, folder / "a.exr", {{"seed", "42"}, {"scene", "box"}});
  Image read = read_image(folder / "a.exr");
  EXPECT_TRUE(std::isnan(read.pixels[0].y));
  // An attribute is its name, its type, the size of its value and the value (the file layout's
  // specification).
  std::string bytes = test::read_text(folder / "a.exr");
  EXPECT_NE(bytes.find(std::string("seed\0string\0\2\0\0\0"
                                   "42",
                                   18)),
            std::string::npos);
}

TEST(ImageFile, AnExrAttributeThatCannotBeIsAnOutputError) {
  ScratchFolder folder;
  Image image{1, 1, {vec3(1)}};
  EXPECT_EQ(code_of([&] {
              write_linear_image(image, folder / "a.exr", {{"channels", "no"}});
            }),
            ExitCode::output);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}

TEST(ImageFile, HdrIsWithinHalfAStep) {
  ScratchFolder folder;
  for (auto [width, height] : {std::pair(5, 3), {8, 2}, {200, 30}, {1, 1}}) { // flat below 8, runs from 8 on
    Image image = test_image(width, height);
    write_linear_image(image, folder / "a.hdr", {{"note", "two\nlines"}});
    Image read = read_image(folder / "a.hdr");
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      // The mantissa of the largest channel is at least 127.5, and rounds by half at most.
      float step = max_component(image.pixels[i]) / 127.5f;
      for (int c = 0; c < 3; ++c)
        ASSERT_LE(std::abs(read.pixels[i][c] - image.pixels[i][c]), 0.5f * step) << i;
    }
  }
}

TEST(ImageFile, HdrRepresentableValuesAreExactAndOthersAreClamped) {
  ScratchFolder folder;
  Image image{9,
              1,
              {vec3(1, 0.5f, 0), vec3(255, 1, 2), vec3(0), vec3(0x1p-130f), vec3(-1, 2, std::nanf("")),
               vec3(kInfinity, 0, 0), vec3(255.6f, 1, 0), vec3(0x1.fep126f, 0, 0), vec3(3, 3, 3)}};
  write_linear_image(image, folder / "a.hdr");
  std::vector<vec3> read = read_image(folder / "a.hdr").pixels;
  EXPECT_EQ(read[0], vec3(1, 0.5f, 0));
  EXPECT_EQ(read[1], vec3(255, 1, 2));
  EXPECT_EQ(read[2], vec3(0));
  EXPECT_EQ(read[3], vec3(0));
  EXPECT_EQ(read[4], vec3(0, 2, 0));
  EXPECT_EQ(read[5], vec3(255 * 0x1p119f, 0, 0));
  EXPECT_EQ(read[6],
            vec3(256, 0, 0)); // 255.6 rounds to 128 of the next exponent, whose step is 2 (1 ties to 0)
  EXPECT_EQ(read[7], vec3(0x1.fep126f, 0, 0));
  EXPECT_EQ(read[8], vec3(3));
}

TEST(ImageFile, HdrOrientationExposureAndOldRunsAreUnderstood) {
  ScratchFolder folder;
  auto pixel = [](int value) { return std::string{static_cast<char>(value), 0, 0, static_cast<char>(136)}; };
  std::string head = "#?RGBE\nFORMAT=32-bit_rle_rgbe\n";
  test::write_text(folder / "a.hdr", head + "\n+Y 2 -X 2\n" + pixel(10) + pixel(20) + pixel(30) + pixel(40));
  Image image = read_image(folder / "a.hdr"); // from the bottom, from the right
  EXPECT_EQ(image.at(0, 0).x, 40);
  EXPECT_EQ(image.at(1, 0).x, 30);
  EXPECT_EQ(image.at(0, 1).x, 20);
  EXPECT_EQ(image.at(1, 1).x, 10);
  test::write_text(folder / "b.hdr",
                   head + "\n+X 2 -Y 3\n" + pixel(1) + pixel(2) + pixel(3) + pixel(4) + pixel(5) + pixel(6));
  image = read_image(folder / "b.hdr"); // by columns
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 3);
  EXPECT_EQ(image.at(0, 2).x, 3);
  EXPECT_EQ(image.at(1, 0).x, 4);
  test::write_text(folder / "c.hdr", head + "EXPOSURE=2\nEXPOSURE= 4\n\n-Y 1 +X 1\n" + pixel(16));
  EXPECT_EQ(read_image(folder / "c.hdr").pixels[0].x, 2);
  // A pixel repeated 2 + 256 times in all, by two marks.
  std::string marks{1, 1, 1, 1, 1, 1, 1, 1};
  test::write_text(folder / "d.hdr", head + "\n-Y 1 +X 258\n" + pixel(9) + marks);
  image = read_image(folder / "d.hdr");
  EXPECT_TRUE(std::ranges::all_of(image.pixels, [](vec3 p) { return p.x == 9; }));
}

TEST(ImageFile, PngAndPpmKeepEveryByte) {
  ScratchFolder folder;
  for (auto [width, height] : {std::pair(31, 17), {1, 1}, {256, 2}}) {
    auto rgb = gradient(width, height);
    for (const char* name : {"a.png", "a.ppm"}) {
      write_srgb8_image(width, height, rgb, folder / name);
      auto texture = read_texels(folder / name);
      EXPECT_EQ(texture->width, width);
      EXPECT_EQ(texture->height, height);
      EXPECT_EQ(srgb8_texels(*texture), rgb) << name;
      Image image = read_image(folder / name);
      for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(image.pixels[i][c],
                    linear_from_srgb(static_cast<float>(rgb[i * 3 + static_cast<std::size_t>(c)]) / 255.0f));
    }
  }
}

TEST(ImageFile, JpgIsClose) {
  ScratchFolder folder;
  auto rgb = gradient(64, 48);
  write_srgb8_image(64, 48, rgb, folder / "a.jpg");
  const auto texture = srgb8_texels(*read_texels(folder / "a.jpg"));
  ASSERT_EQ(texture.size(), rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_NEAR(texture[i], rgb[i], 8) << i;
}

TEST(ImageFile, TheContentDecidesNotTheName) {
  ScratchFolder folder;
  write_linear_image(test_image(4, 4), folder / "a.exr");
  std::filesystem::rename(folder / "a.exr", folder / "a.png");
  EXPECT_EQ(read_image(folder / "a.png"), test_image(4, 4));
}

TEST(ImageFile, PfmOfEitherByteOrderAndGrey) {
  ScratchFolder folder;
  auto bytes = [](float value, bool swap) {
    auto bits = std::bit_cast<std::uint32_t>(value);
    if (swap) bits = __builtin_bswap32(bits);
    return std::string(reinterpret_cast<const char*>(&bits), 4);
  };
  for (bool big : {false, true}) {
    std::string scale = big ? "1" : "-1";
    test::write_text(folder / "a.pfm", "Pf\n1 2\n" + scale + "\n" + bytes(3.5f, big) + bytes(-2, big));
    Image image = read_image(folder / "a.pfm"); // the first row is the lowest
    EXPECT_EQ(image.at(0, 0), vec3(-2));
    EXPECT_EQ(image.at(0, 1), vec3(3.5f));
  }
}

TEST(ImageFile, PnmOfEveryKind) {
  ScratchFolder folder;
  auto first = [&](const std::string& content) {
    test::write_text(folder / "a.ppm", content);
    return read_image(folder / "a.ppm").pixels.at(0);
  };
  EXPECT_EQ(first("P3 # a comment\n1 1\n255\n255 0 255\n"), vec3(1, 0, 1));
  EXPECT_EQ(first("P2\n1 1 15 15"), vec3(1));
  EXPECT_EQ(first("P5\n1 1\n1\n\x01"), vec3(1));
  EXPECT_EQ(first(std::string("P6\n1 1\n65535\n\xff\xff\0\0\x80\0", 19)),
            vec3(1, 0, linear_from_srgb(32768.0f / 65535.0f)));
  for (const char* bad : {"P3 1 1 255 256 0 0", "P3 1 1 255 -1 0 0", "P6 1 1 0 \n", "P6 1 1 65536 \n", "P6 1",
                          "P6 x 1 255 \n", "P6 1 1 255\nab", "P3 1 1 255 1 2 z", "P6 0 1 255\n"})
    EXPECT_EQ(code_of([&] { first(bad); }), ExitCode::bad_input) << bad;
}

TEST(ImageFile, FloatTexturesStayFloatsAndAreShownClipped) {
  ScratchFolder folder;
  Image image{3, 1, {vec3(0.5f), vec3(-1, 7, std::nanf("")), vec3(0.2158605f)}};
  write_linear_image(image, folder / "a.exr");
  auto texture = read_texels(folder / "a.exr");
  const auto& floats = std::get<std::vector<float>>(texture->data);
  ASSERT_EQ(floats.size(), 9u);
  EXPECT_EQ(std::vector<float>(floats.begin() + 3, floats.begin() + 6), (std::vector<float>{-1, 7, 0}));
  EXPECT_EQ(srgb8_texels(*texture), (std::vector<std::uint8_t>{188, 188, 188, 0, 255, 0, 128, 128, 128}));
}

TEST(ImageFile, ScreenshotsNeverOverwrite) {
  ScratchFolder folder;
  auto rgb = gradient(2, 2);
  EXPECT_EQ(write_srgb8_image_uniquely(2, 2, rgb, folder.path(), "shot"), folder / "shot.png");
  EXPECT_EQ(write_srgb8_image_uniquely(2, 2, rgb, folder.path(), "shot"), folder / "shot-2.png");
  EXPECT_EQ(srgb8_texels(*read_texels(folder / "shot-2.png")), rgb);
}

TEST(ImageFile, WrongFormatsForAPictureAreUsageErrors) {
  ScratchFolder folder;
  EXPECT_EQ(code_of([&] { write_linear_image(test_image(1, 1), folder / "a.png"); }), ExitCode::usage);
  EXPECT_EQ(code_of([&] { write_srgb8_image(1, 1, gradient(1, 1), folder / "a.exr"); }), ExitCode::usage);
  EXPECT_EQ(code_of([&] { write_srgb8_image(2, 1, gradient(1, 1), folder / "a.png"); }), ExitCode::output);
  EXPECT_EQ(code_of([&] { write_linear_image(Image{}, folder / "a.exr"); }), ExitCode::output);
}

/// A TGA of 3 x 2 texels, which are 0, 1, 2 and 3, 4, 5 in its file.
std::string tga(int descriptor) {
  std::string out = std::string{0, 0, 2} + std::string(9, '\0') + std::string{3, 0, 2, 0, 24};
  out += static_cast<char>(descriptor);
  for (int i = 0; i < 6; ++i) out += std::string(3, static_cast<char>(i));
  return out;
}

TEST(ImageTga, RowsAndColumnsRunAsItSays) {
  ScratchFolder folder;
  const std::pair<int, std::vector<int>> kCases[] = {{0x00, {3, 4, 5, 0, 1, 2}},
                                                     {0x20, {0, 1, 2, 3, 4, 5}},
                                                     {0x10, {5, 4, 3, 2, 1, 0}},
                                                     {0x30, {2, 1, 0, 5, 4, 3}}};
  for (const auto& [descriptor, expected] : kCases) {
    test::write_text(folder / "a.tga", tga(descriptor));
    const auto texture = srgb8_texels(*read_texels(folder / "a.tga"));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(texture[3 * i], expected[i]) << descriptor << " " << i;
  }
}

} // namespace
} // namespace candela
