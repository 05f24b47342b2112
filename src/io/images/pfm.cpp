// Portable float map: "PF" (colour) or "Pf" (grey), width, height, a scale whose sign tells the byte order
// (negative: little-endian), then rows from the bottom up (Debevec's description of the format). The scale's
// magnitude has no agreed meaning and is ignored.

#include "io/images/image_codec.h"
#include "io/images/pnm_header.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace candela {

static_assert(std::endian::native == std::endian::little);

bool is_pfm(ByteView bytes) {
  return bytes.size() >= 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f');
}

Image decode_pfm(ByteView bytes, const Location& where, ProgressPart* progress) {
  PnmHeader header{bytes, where};
  std::size_t channels = bytes[1] == 'F' ? 3 : 1;
  std::int64_t width = header.integer("width"), height = header.integer("height");
  float scale = header.real("scale");
  header.end();
  if (scale == 0) throw damaged_image(where, "the scale of the PFM is 0, which tells no byte order");
  check_image_size(where, width, height);
  std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  ByteView data = header.rest();
  if (data.size() / (4 * channels) / w < h)
    throw damaged_image(where, fmt::format("the PFM holds {} bytes of pixels where {} are due", data.size(),
                                           w * h * 4 * channels));
  bool swap = scale > 0;
  Image image{static_cast<int>(width), static_cast<int>(height), std::vector<vec3>(w * h)};
  const std::uint8_t* p = data.data();
  auto next = [&] {
    std::uint32_t bits = 0;
    std::memcpy(&bits, p, 4);
    p += 4;
    return std::bit_cast<float>(swap ? __builtin_bswap32(bits) : bits);
  };
  for (std::size_t y = h; y-- > 0;) {
    if (progress) progress->reach(1 - static_cast<double>(y + 1) / static_cast<double>(h));
    for (std::size_t x = 0; x < w; ++x) {
      vec3& pixel = image.pixels[y * w + x];
      pixel.x = next();
      pixel.y = channels == 3 ? next() : pixel.x;
      pixel.z = channels == 3 ? next() : pixel.x;
    }
  }
  return image;
}

Bytes encode_pfm(const Image& image) {
  std::string header = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
  std::size_t row = static_cast<std::size_t>(image.width) * sizeof(vec3);
  static_assert(sizeof(vec3) == 12);
  Bytes out(header.size() + row * static_cast<std::size_t>(image.height));
  std::memcpy(out.data(), header.data(), header.size());
  for (int y = 0; y < image.height; ++y)
    std::memcpy(out.data() + header.size() + row * static_cast<std::size_t>(image.height - 1 - y),
                &image.at(0, y), row);
  return out;
}

} // namespace candela
