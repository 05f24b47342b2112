#include "io/images/image_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace candela {
namespace {

const Location kWhere{"shot.png"};

Bytes small_png() {
  const Bytes rgb(2 * 3 * 3, 100);
  return encode_png(2, 3, rgb);
}

Bytes with_text(const std::string& name, const std::string& text) {
  return with_png_text(small_png(), {{name, text}});
}

TEST(PngText, ReadsBackWhatWasWritten) {
  std::mt19937 random(3);
  std::string noise(100000, ' ');
  for (char& c : noise) c = static_cast<char>('!' + random() % 90);
  const ImageMetadata text{{"candela.a", ""}, {"candela.b", "ä short one"}, {"candela.c", noise}};
  const Bytes png = with_png_text(small_png(), text);
  EXPECT_NO_THROW(check_png(png, kWhere));
  for (const auto& [name, value] : text) EXPECT_EQ(png_text(png, name, kWhere), value);
  EXPECT_EQ(png_text(png, "candela", kWhere), std::nullopt);
  EXPECT_EQ(png_text(png, "candela.cc", kWhere), std::nullopt);
  EXPECT_EQ(png_text(small_png(), "candela.a", kWhere), std::nullopt);
}

TEST(PngText, LeavesThePictureAsItWas) {
  EXPECT_EQ(decode_stb8(with_text("candela.a", std::string(5000, 'x')), kWhere).rgb,
            decode_stb8(small_png(), kWhere).rgb);
}

TEST(PngText, CompressesLongTexts) { EXPECT_LT(with_text("a", std::string(100000, 'x')).size(), 2000u); }

/// What follows the chunk's name ("a" and its zero) is replaced.
Bytes with_chunk_body(const std::string& body) {
  Bytes png = with_text("a", body);
  // The writer's own five bytes after the name are cut out, and the chunk becomes shorter by four of them:
  // the name's zero stays.
  const char type[] = {'i', 'T', 'X', 't'};
  auto at = std::search(png.begin(), png.end(), std::begin(type), std::end(type));
  png.erase(at + 6, at + 10);
  *(at - 1) = static_cast<std::uint8_t>(*(at - 1) - 4);
  return png; // its checksum is wrong now, which is check_png's to see
}

TEST(PngText, RefusesDamagedChunks) {
  using namespace std::string_literals;
  EXPECT_EQ(png_text(with_chunk_body("\0\0\0\0good"s), "a", kWhere), "good");
  for (const std::string& body : {""s, "\0"s, "\0\0\0"s, "\2\0\0\0x"s, "\0\1\0\0x"s, "\0\0xyz"s, "\0\0\0xyz"s,
                                  "\1\0\0\0"s, "\1\0\0\0no zlib data"s, "\1\0\0\0\x78\xda"s})
    EXPECT_THROW(png_text(with_chunk_body(body), "a", kWhere), Error) << testing::PrintToString(body);
}

// 300 MiB of zeros are 300 kB of zlib: rejected before all are decompressed.
TEST(PngText, RefusesTextsThatUnpackWithoutEnd) {
  const Bytes png = with_text("a", std::string(kMaxPictureText + 1, '\0'));
  try {
    png_text(png, "a", kWhere);
    FAIL();
  } catch (const Error& error) { EXPECT_EQ(error.code(), ExitCode::limit) << error.what(); }
}

} // namespace
} // namespace candela
