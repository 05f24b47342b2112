// PNG, BMP and TGA by stb_image. It is compiled here rather than linked from Debian's libstb so that
// malicious files can reach only these formats (its JPEG, GIF, PSD and PIC readers have known
// vulnerabilities), and so that sanitizers check it.

#include "core/color.h"
#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#include <stb_image.h>
#include <stb_image_write.h>

namespace candela {

namespace {

struct Free {
  void operator()(void* p) const { std::free(p); }
};
template <class T>
using StbPixels = std::unique_ptr<T, Free>;

bool is_bmp(ByteView bytes) { return bytes.size() >= 2 && bytes[0] == 'B' && bytes[1] == 'M'; }

/// Missing uncompressed rows would be read as uninitialised memory.
void check_tga(ByteView bytes, const Location& where, std::int64_t pixels) {
  bool run_length = (bytes[2] & 8) != 0;
  std::int64_t bytes_per_pixel = (bytes[16] + 7) / 8;
  // A run-length packet has at most 128 pixels.
  std::int64_t least = run_length ? pixels / 128 * (1 + bytes_per_pixel) : pixels * bytes_per_pixel;
  if (static_cast<std::int64_t>(bytes.size()) - 18 < least)
    throw damaged_image(where, "the TGA is too short for the size it claims");
}

void check_bmp(ByteView bytes, const Location& where, std::int64_t pixels) {
  if (bytes.size() < 30) throw damaged_image(where, "the BMP ends within its header");
  int bits = bytes[14] == 12 ? bytes[24] : bytes[28];
  if (static_cast<std::int64_t>(bytes.size()) * 8 < pixels * bits)
    throw damaged_image(where, "the BMP is too short for the size it claims");
}

/// A TGA's descriptor has a flag for rows from right to left, which stb_image ignores.
bool runs_leftwards(ByteView tga) { return (tga[17] & 0x10) != 0; }

/// Rows of `width` texels of so many values.
template <class T>
void mirror_rows(std::vector<T>& values, std::size_t width, std::size_t channels) {
  const std::size_t row = width * channels;
  for (std::size_t begin = 0; begin + row <= values.size(); begin += row)
    for (std::size_t x = 0; x < width / 2; ++x)
      std::swap_ranges(&values[begin + channels * x], &values[begin + channels * x] + channels,
                       &values[begin + channels * (width - 1 - x)]);
}

Error undecodable(const Location& where) {
  const char* reason = stbi_failure_reason();
  return damaged_image(where,
                       fmt::format("it cannot be decoded ({})", reason ? reason : "for no stated reason"));
}

/// All checks before pixels are allocated; returns the size.
std::pair<int, int> check_stb(ByteView bytes, const Location& where, bool tga) {
  if (is_png(bytes)) check_png(bytes, where);
  bool is_tga = tga && !is_stb_format(bytes);
  // No other format that stb_image recognises has such a second byte (TGA's colour map type), so none can
  // bypass its own check by the ending .tga.
  if (is_tga && (bytes.size() < 18 || bytes[1] > 1)) throw damaged_image(where, "it is no TGA");
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels) == 0)
    throw undecodable(where);
  check_image_size(where, width, height);
  std::int64_t pixels = std::int64_t{width} * height;
  if (is_bmp(bytes)) check_bmp(bytes, where, pixels);
  if (is_tga) check_tga(bytes, where, pixels);
  return {width, height};
}

} // namespace

bool is_stb_format(ByteView bytes) { return is_png(bytes) || is_bmp(bytes); }

namespace {

template <class T>
struct StbPicture {
  int width = 0, height = 0, channels = 0;
  std::vector<T> values;
};

/// `wanted` channels; 0: as many as the file has. T is stbi_uc or stbi_us.
template <class T>
StbPicture<T> load_stb(ByteView bytes, const Location& where, bool tga, int wanted) {
  auto size = check_stb(bytes, where, tga);
  StbPicture<T> out;
  const auto length = static_cast<int>(bytes.size());
  StbPixels<T> data;
  if constexpr (sizeof(T) == 1)
    data.reset(stbi_load_from_memory(bytes.data(), length, &out.width, &out.height, &out.channels, wanted));
  else
    data.reset(
        stbi_load_16_from_memory(bytes.data(), length, &out.width, &out.height, &out.channels, wanted));
  if (!data) throw undecodable(where);
  if (std::pair(out.width, out.height) != size)
    throw damaged_image(where, "its headers disagree about its size");
  if (wanted > 0) out.channels = wanted;
  const auto channels = static_cast<std::size_t>(out.channels);
  std::size_t count = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * channels;
  out.values.assign(data.get(), data.get() + count);
  if (tga && !is_stb_format(bytes) && runs_leftwards(bytes))
    mirror_rows(out.values, static_cast<std::size_t>(out.width), channels);
  return out;
}

bool has_16_bits(ByteView bytes) {
  return is_png(bytes) && stbi_is_16_bit_from_memory(bytes.data(), static_cast<int>(bytes.size())) != 0;
}

template <class T>
Texels load_stb_texels(ByteView bytes, const Location& where, bool tga) {
  auto picture = load_stb<T>(bytes, where, tga, 0);
  // Grey with alpha is expanded to RGBA.
  if (picture.channels == 2) picture = load_stb<T>(bytes, where, tga, 4);
  return {picture.width, picture.height, picture.channels, std::move(picture.values)};
}

} // namespace

Picture8 decode_stb8(ByteView bytes, const Location& where, bool tga) {
  auto picture = load_stb<stbi_uc>(bytes, where, tga, 3);
  return {picture.width, picture.height, std::move(picture.values)};
}

Texels decode_stb_texels(ByteView bytes, const Location& where, bool tga) {
  return has_16_bits(bytes) ? load_stb_texels<stbi_us>(bytes, where, tga)
                            : load_stb_texels<stbi_uc>(bytes, where, tga);
}

Image decode_stb(ByteView bytes, const Location& where, bool tga) {
  if (!has_16_bits(bytes)) return linear_image(decode_stb8(bytes, where, tga));
  const auto picture = load_stb<stbi_us>(bytes, where, tga, 3);
  std::vector<float> linear(65536);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = linear_from_srgb(static_cast<float>(i) / 65535.0f);
  Image image{picture.width, picture.height, std::vector<vec3>(picture.values.size() / 3)};
  const stbi_us* p = picture.values.data();
  for (vec3& pixel : image.pixels) pixel = {linear[p[0]], linear[p[1]], linear[p[2]]}, p += 3;
  return image;
}

namespace {

void append(void* context, void* data, int size) {
  auto* out = static_cast<Bytes*>(context);
  auto* begin = static_cast<const std::uint8_t*>(data);
  out->insert(out->end(), begin, begin + size);
}

} // namespace

Bytes encode_png(int width, int height, ByteView rgb) {
  Bytes out;
  if (stbi_write_png_to_func(append, &out, width, height, 3, rgb.data(), width * 3) == 0)
    throw std::bad_alloc();
  return out;
}

} // namespace candela
