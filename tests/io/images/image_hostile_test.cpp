// Damaged, inconsistent and oversized pictures: each is rejected with a located message, or read; none
// crashes.

#include "core/error.h"
#include "io/images/image_file.h"
#include "io/images/texels_reader.h"
#include "support/scratch_folder.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace candela {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

/// Reads the file both ways; done, bad_input or limit, and any error names the file.
ExitCode outcome(const std::string& path) {
  ExitCode codes[2] = {ExitCode::done, ExitCode::done};
  for (bool texture : {false, true}) {
    try {
      if (texture) {
        auto t = read_texels(path);
        EXPECT_STREQ(texels_problem(*t), "");
      } else {
        Image image = read_image(path);
        EXPECT_EQ(image.pixels.size(),
                  static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
      }
    } catch (const Error& error) {
      codes[texture] = error.code();
      EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::limit) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with(path + ": image: ")) << error.what();
    }
  }
  return codes[0];
}

void write_every_format(const ScratchFolder& folder, int width, int height) {
  Image image{width, height, {}};
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < width * height; ++i) {
    image.pixels.push_back(vec3(static_cast<float>(i % 7), static_cast<float>(i), 0.25f));
    for (int value : {i, i * 7, 9}) rgb.push_back(static_cast<std::uint8_t>(value));
  }
  for (const char* name : {"a.exr", "a.hdr", "a.pfm"}) write_linear_image(image, folder / name);
  for (const char* name : {"a.png", "a.jpg", "a.ppm"}) write_srgb8_image(width, height, rgb, folder / name);
  // A TGA of 24 bits with run lengths, and a BMP of 24 bits.
  auto u16 = [](int v) { return std::string{static_cast<char>(v & 255), static_cast<char>(v >> 8)}; };
  std::string tga =
      std::string{0, 0, 10} + std::string(9, '\0') + u16(width) + u16(height) + std::string{24, 0};
  for (int left = width * height; left > 0; left -= 128)
    tga += static_cast<char>(0x80 | (std::min(left, 128) - 1)) + std::string{1, 2, 3};
  test::write_text(folder / "a.tga", tga);
  int row = (width * 3 + 3) / 4 * 4;
  std::string bmp = "BM" + u16(54 + row * height) + std::string(6, '\0') + u16(54) + u16(0) + u16(40) +
                    u16(0) + u16(width) + u16(0) + u16(height) + u16(0) + u16(1) + u16(24) +
                    std::string(24, '\0') + std::string(static_cast<std::size_t>(row * height), 'x');
  test::write_text(folder / "a.bmp", bmp);
}

constexpr const char* kNames[] = {"a.exr", "a.hdr", "a.pfm", "a.png", "a.jpg", "a.ppm", "a.tga", "a.bmp"};

TEST(ImageHostile, TheSamplesAreValid) {
  ScratchFolder folder;
  write_every_format(folder, 33, 21);
  for (const char* name : kNames) {
    auto texture = read_texels(folder / name);
    EXPECT_EQ(texture->width, 33) << name;
    EXPECT_EQ(texture->height, 21) << name;
  }
}

TEST(ImageHostile, EveryTruncationIsRefused) {
  ScratchFolder folder;
  write_every_format(folder, 33, 21);
  for (const char* name : kNames) {
    std::string whole = test::read_text(folder / name);
    std::string ending = fs::path(name).extension().string();
    std::string path = folder / ("cut" + ending);
    std::size_t step = std::max<std::size_t>(1, whole.size() / 150);
    for (std::size_t size = 0; size < whole.size(); size += step) {
      test::write_text(path, whole.substr(0, size));
      // The run-length encoding of a TGA has no end mark, so truncation may go unnoticed; it must not crash.
      ExitCode code = outcome(path);
      if (ending != ".tga" && ending != ".bmp") {
        EXPECT_EQ(code, ExitCode::bad_input) << name << " cut to " << size << " of " << whole.size();
      }
    }
  }
}

TEST(ImageHostile, FlippedBytesAreReadOrRefused) {
  SCOPED_TRACE(test::seed_note());
  std::mt19937_64 random(test::fresh_seed());
  ScratchFolder folder;
  write_every_format(folder, 33, 21);
  for (const char* name : kNames) {
    std::string whole = test::read_text(folder / name);
    std::string path = folder / ("flip" + fs::path(name).extension().string());
    for (int i = 0; i < 150; ++i) {
      std::string damaged = whole;
      int count = 1 + static_cast<int>(random() % 3);
      for (int k = 0; k < count; ++k) {
        // Half of them hit the header.
        std::size_t range = random() % 2 ? std::min<std::size_t>(whole.size(), 100) : whole.size();
        damaged[random() % range] = static_cast<char>(random());
      }
      test::write_text(path, damaged);
      ExitCode code = outcome(path);
      if (fs::path(name).extension() == ".png" && damaged != whole) {
        EXPECT_NE(code, ExitCode::done) << "a PNG with a wrong checksum was read";
      }
    }
  }
}

TEST(ImageHostile, SizesAboveTheCapsAreLimitErrors) {
  ScratchFolder folder;
  auto outcome_of = [&](const std::string& name, const std::string& content) {
    test::write_text(folder / name, content);
    return outcome(folder / name);
  };
  EXPECT_EQ(outcome_of("a.ppm", "P6\n65537 1\n255\n"), ExitCode::limit);
  EXPECT_EQ(outcome_of("b.ppm", "P6\n65536 65536\n255\n"), ExitCode::limit);
  EXPECT_EQ(outcome_of("a.pfm", "PF\n1 65537\n-1\n"), ExitCode::limit);
  EXPECT_EQ(outcome_of("a.hdr", "#?RADIANCE\n\n-Y 65536 +X 65536\n"), ExitCode::limit);
  EXPECT_EQ(outcome_of("c.ppm", "P6\n99999999999999999999 1\n255\n"), ExitCode::bad_input);
}

TEST(ImageHostile, SmallFilesThatClaimMuchAreRefused) {
  ScratchFolder folder;
  // Sizes within the limits but too large for the file: rejected before pixels are allocated.
  for (const char* content :
       {"P6\n60000 4000\n255\n", "PF\n60000 4000\n-1\n", "#?RADIANCE\n\n-Y 60000 +X 4000\n"}) {
    test::write_text(folder / "a.x", content);
    EXPECT_EQ(outcome(folder / "a.x"), ExitCode::bad_input);
  }
}

TEST(ImageHostile, WhatIsNoPictureIsRefused) {
  ScratchFolder folder;
  test::write_text(folder / "empty.png", "");
  test::write_text(folder / "text.png", "hello");
  test::write_text(folder / "gif.png", "GIF89a\x01\x01");
  for (const char* name : {"empty.png", "text.png", "gif.png", "absent.png", ""})
    EXPECT_EQ(outcome(folder / name), ExitCode::bad_input) << name;
  EXPECT_EQ(outcome("/dev/zero"), ExitCode::bad_input);
}

TEST(ImageHostile, AHuffmanTableWithTooManyCodesIsRefused) {
  ScratchFolder folder;
  write_every_format(folder, 33, 21);
  std::string jpg = test::read_text(folder / "a.jpg");
  auto table = jpg.find("\xff\xc4");
  ASSERT_NE(table, std::string::npos);
  jpg.replace(table + 5, 16, 16, '\xff'); // 16 * 255 codes
  test::write_text(folder / "b.jpg", jpg);
  EXPECT_EQ(outcome(folder / "b.jpg"), ExitCode::bad_input);
  // A fill byte before the first marker, which some decoders accept.
  for (const char* name : {"c.jpg", "c.tga"}) {
    test::write_text(folder / name, "\xff" + jpg);
    EXPECT_EQ(outcome(folder / name), ExitCode::bad_input);
  }
}

TEST(ImageHostile, KnownMalformedFiles) {
  fs::path folder = fs::path(CANDELA_SHARED_DATA) / "malformed";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  int count = 0;
  for (fs::recursive_directory_iterator it(folder); it != fs::recursive_directory_iterator(); ++it) {
    const fs::directory_entry& entry = *it;
    if (entry.path().filename() == "gltf") it.disable_recursion_pending(); // scenes: their pictures are whole
    if (!entry.is_regular_file()) continue;
    ++count;
    EXPECT_NE(outcome(entry.path().string()), ExitCode::done) << entry.path();
  }
  EXPECT_GT(count, 0);
}

} // namespace
} // namespace candela
