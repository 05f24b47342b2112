#include "core/error.h"
#include "io/images/image_file.h"
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

namespace candela {
namespace {

using test::ScratchFolder;

TEST(ImageExr, EveryCompressionAndPixelType) {
  ScratchFolder folder;
  constexpr int kWidth = 70, kHeight = 45;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
    for (Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
      Imf::Header header(kWidth, kHeight);
      header.compression() = static_cast<Imf::Compression>(compression);
      std::vector<half> halves(kWidth * kHeight);
      std::vector<float> floats(halves.size());
      for (std::size_t i = 0; i < halves.size(); ++i) {
        const std::size_t x = i % kWidth, y = i / kWidth;
        floats[i] = halves[i] =
            half(1.0f + std::sin(static_cast<float>(x) * 0.05f) * std::cos(static_cast<float>(y) * 0.05f));
      }
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
    EXPECT_NE(std::string(error.what()).find('Z'), std::string::npos);
  }
}

TEST(ImageExr, WritesLayersBesideTheImage) {
  ScratchFolder folder;
  const std::string path = folder / "a.exr";
  const Image image{2, 1, {vec3(1, 2, 3), vec3(4, 5, 6)}};
  const Image key{2, 1, {vec3(0.1f, 0.2f, 0.3f), vec3(7)}}, fill{2, 1, {vec3(0.5f), vec3(0)}};
  const std::string name = "Combined_a long name of a group, longer than 31 bytes";
  write_exr_layers(image, std::vector<ImageLayer>{{name, key}, {"Combined_fill", fill}}, path,
                   {{"candela.spp", "4"}});
  EXPECT_EQ(read_image(path).pixels, image.pixels) << "that without a name";
  Imf::InputFile file(path.c_str());
  EXPECT_TRUE(file.header().findTypedAttribute<Imf::StringAttribute>("candela.spp"));
  std::vector<float> red(2), blue(2);
  Imf::FrameBuffer frame;
  frame.insert(name + ".R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(red.data()), 4, 8));
  frame.insert("Combined_fill.B", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(blue.data()), 4, 8));
  file.setFrameBuffer(frame);
  file.readPixels(0);
  EXPECT_EQ(red, (std::vector<float>{0.1f, 7}));
  EXPECT_EQ(blue, (std::vector<float>{0.5f, 0}));
  EXPECT_THROW(write_exr_layers(image, std::vector<ImageLayer>{{"small", Image{1, 1, {vec3(1)}}}}, path),
               Error);
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
  // White stays white with another white point (ACES AP0).
  Imf::Chromaticities aces({0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, {0.32168f, 0.33767f});
  write_channels(path, {"Y"}, &aces);
  pixel = read_image(path).pixels[0];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], 1, 1e-5f);
}

} // namespace
} // namespace candela
