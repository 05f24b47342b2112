#include "core/color.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/image_file.h"
#include "io/texture_reader.h"
#include "support/scratch_folder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace candela {
namespace {

using test::ScratchFolder;

/// Values over many orders of magnitude, of both signs where asked for.
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

template <class Action>
ExitCode code_of(Action action) {
  try {
    action();
  } catch (const Error& error) { return error.code(); }
  return ExitCode::done;
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
  Imf::InputFile file((folder / "a.exr").c_str());
  const auto* seed = file.header().findTypedAttribute<Imf::StringAttribute>("seed");
  ASSERT_NE(seed, nullptr);
  EXPECT_EQ(seed->value(), "42");
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
      auto texture = read_texture(folder / name);
      EXPECT_EQ(texture->width, width);
      EXPECT_EQ(texture->height, height);
      EXPECT_EQ(texture->srgb, rgb) << name;
      EXPECT_EQ(texture->name, name);
      EXPECT_EQ(texture->source, folder / name);
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
  auto texture = read_texture(folder / "a.jpg");
  ASSERT_EQ(texture->srgb.size(), rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_NEAR(texture->srgb[i], rgb[i], 8) << i;
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

TEST(ImageFile, FloatTexturesAreClippedAndEncoded) {
  ScratchFolder folder;
  Image image{3, 1, {vec3(0.5f), vec3(-1, 7, std::nanf("")), vec3(0.2158605f)}};
  write_linear_image(image, folder / "a.exr");
  auto texture = read_texture(folder / "a.exr");
  EXPECT_EQ(texture->srgb, (std::vector<std::uint8_t>{188, 188, 188, 0, 255, 0, 128, 128, 128}));
}

TEST(ImageFile, ScreenshotsNeverOverwrite) {
  ScratchFolder folder;
  auto rgb = gradient(2, 2);
  EXPECT_EQ(write_srgb8_image_uniquely(2, 2, rgb, folder.path(), "shot"), folder / "shot.png");
  EXPECT_EQ(write_srgb8_image_uniquely(2, 2, rgb, folder.path(), "shot"), folder / "shot-2.png");
  EXPECT_EQ(read_texture(folder / "shot-2.png")->srgb, rgb);
}

TEST(ImageFile, WrongFormatsForAPictureAreUsageErrors) {
  ScratchFolder folder;
  EXPECT_EQ(code_of([&] { write_linear_image(test_image(1, 1), folder / "a.png"); }), ExitCode::usage);
  EXPECT_EQ(code_of([&] { write_srgb8_image(1, 1, gradient(1, 1), folder / "a.exr"); }), ExitCode::usage);
  EXPECT_EQ(code_of([&] { write_srgb8_image(2, 1, gradient(1, 1), folder / "a.png"); }), ExitCode::output);
  EXPECT_EQ(code_of([&] { write_linear_image(Image{}, folder / "a.exr"); }), ExitCode::output);
}

// EXR variants ------------------------------------------------------------------------------------------

TEST(ImageExr, EveryCompressionAndPixelType) {
  ScratchFolder folder;
  constexpr int kWidth = 70, kHeight = 45;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
    for (Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
      Imf::Header header(kWidth, kHeight);
      header.compression() = static_cast<Imf::Compression>(compression);
      std::vector<half> halves(kWidth * kHeight);
      std::vector<float> floats(halves.size());
      for (std::size_t i = 0; i < halves.size(); ++i)
        floats[i] = halves[i] = half(1.0f + std::sin(static_cast<float>(i % kWidth) * 0.05f) *
                                                std::cos(static_cast<float>(i / kWidth) * 0.05f));
      for (const char* name : {"R", "G", "B", "A"}) header.channels().insert(name, Imf::Channel(type));
      {
        Imf::OutputFile file((folder / "a.exr").c_str(), header);
        Imf::FrameBuffer frame;
        for (const char* name : {"R", "G", "B", "A"})
          frame.insert(name, type == Imf::HALF
                                 ? Imf::Slice(type, reinterpret_cast<char*>(halves.data()), 2, 2 * kWidth)
                                 : Imf::Slice(type, reinterpret_cast<char*>(floats.data()), 4, 4 * kWidth));
        file.setFrameBuffer(frame);
        file.writePixels(kHeight);
      }
      Image image = read_image(folder / "a.exr");
      ASSERT_EQ(image.width, kWidth);
      ASSERT_EQ(image.height, kHeight);
      bool lossy = compression == Imf::B44_COMPRESSION || compression == Imf::B44A_COMPRESSION ||
                   compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION ||
                   compression == Imf::PXR24_COMPRESSION;
      for (std::size_t i = 0; i < floats.size(); ++i)
        ASSERT_NEAR(image.pixels[i].y, floats[i], lossy ? 0.03f : 0.0f) << "compression " << compression;
    }
}

TEST(ImageExr, TilesADataWindowAndMissingChannels) {
  ScratchFolder folder;
  Imath::Box2i window({-5, 7}, {34, 31});
  Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
  header.setTileDescription(Imf::TileDescription(16, 16));
  header.channels().insert("G", Imf::Channel(Imf::FLOAT));
  std::vector<float> green(40 * 25);
  for (std::size_t i = 0; i < green.size(); ++i) green[i] = static_cast<float>(i);
  {
    Imf::TiledOutputFile file((folder / "a.exr").c_str(), header);
    Imf::FrameBuffer frame;
    frame.insert("G", Imf::Slice::Make(Imf::FLOAT, green.data(), window, 4, 4 * 40));
    file.setFrameBuffer(frame);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  Image image = read_image(folder / "a.exr");
  ASSERT_EQ(image.width, 40);
  ASSERT_EQ(image.height, 25);
  for (std::size_t i = 0; i < green.size(); ++i) ASSERT_EQ(image.pixels[i], vec3(0, green[i], 0));
}

void write_channels(const std::string& path, std::initializer_list<const char*> names,
                    const Imf::Chromaticities* primaries = nullptr) {
  Imf::Header header(2, 1);
  if (primaries) Imf::addChromaticities(header, *primaries);
  std::vector<std::vector<float>> data;
  Imf::FrameBuffer frame;
  for (const char* name : names) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    float value = static_cast<float>(data.size() + 1);
    data.push_back({value, value});
  }
  std::size_t i = 0;
  for (const char* name : names)
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(data[i++].data()), 4, 8));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(1);
}

TEST(ImageExr, ChannelsByName) {
  ScratchFolder folder;
  std::string path = folder / "a.exr";
  write_channels(path, {"Y"});
  EXPECT_EQ(read_image(path).pixels[1], vec3(1));
  write_channels(path, {"B", "G", "R", "Z"});
  EXPECT_EQ(read_image(path).pixels[1], vec3(3, 2, 1));
  write_channels(path, {"View.Depth.Z", "View.Combined.R", "View.Combined.G", "View.Combined.B"});
  EXPECT_EQ(read_image(path).pixels[1], vec3(2, 3, 4));
  write_channels(path, {"Z"});
  try {
    read_image(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("Z"), std::string::npos);
  }
}

TEST(ImageExr, LuminanceAndChroma) {
  ScratchFolder folder;
  std::string path = folder / "a.exr";
  std::vector<Imf::Rgba> pixels(16 * 8, Imf::Rgba(0.5f, 0.25f, 0.125f));
  {
    Imf::RgbaOutputFile file(path.c_str(), 16, 8, Imf::WRITE_YC);
    file.setFrameBuffer(pixels.data(), 1, 16);
    file.writePixels(8);
  }
  vec3 expected(0.5f, 0.25f, 0.125f);
  for (vec3 p : read_image(path).pixels)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(p[c], expected[c], 0.005f);
}

TEST(ImageExr, OtherPrimariesBecomeRec709) {
  ScratchFolder folder;
  std::string path = folder / "a.exr";
  // Rec. 2020 has the same white. The matrix of ITU-R BT.2087-0 (2020 to 709, inverted) has 1.6605,
  // -0.5876, -0.0728 in its first row.
  Imf::Chromaticities rec2020({0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f});
  write_channels(path, {"R", "G", "B"}, &rec2020); // 1, 2, 3
  vec3 pixel = read_image(path).pixels[0];
  EXPECT_NEAR(pixel.x, 1.6605f - 2 * 0.5876f - 3 * 0.0728f, 1e-3f);
  EXPECT_NEAR(pixel.y, -0.1246f + 2 * 1.1329f - 3 * 0.0083f, 1e-3f);
  EXPECT_NEAR(pixel.z, -0.0182f - 2 * 0.1006f + 3 * 1.1187f, 1e-3f);
  // White stays white under another white point (ACES AP0).
  Imf::Chromaticities aces({0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, {0.32168f, 0.33767f});
  write_channels(path, {"Y"}, &aces);
  pixel = read_image(path).pixels[0];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], 1, 1e-5f);
}

} // namespace
} // namespace candela
