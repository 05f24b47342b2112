// Portable pixmaps and greymaps (netpbm's ppm(5), pgm(5)): P2, P3 as text, P5, P6 binary. The specification's
// transfer curve is BT.709's; programs in fact write sRGB, and so it is read.

#include "core/color.h"
#include "io/images/image_codec.h"
#include "io/images/pnm_header.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

namespace candela {

namespace {
bool is_space(std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
} // namespace

std::string_view PnmHeader::word(std::string_view name) {
  while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
    if (bytes_[at_] == '#')
      while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
    else
      ++at_;
  }
  std::size_t begin = at_;
  while (at_ < bytes_.size() && !is_space(bytes_[at_]) && bytes_[at_] != '#') ++at_;
  if (begin == at_) throw damaged_image(where_, fmt::format("it ends before its {}", name));
  return {reinterpret_cast<const char*>(bytes_.data()) + begin, at_ - begin};
}

std::int64_t PnmHeader::integer(std::string_view name) {
  std::string_view text = word(name);
  std::int64_t value = 0;
  auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size())
    throw damaged_image(where_, fmt::format("its {} is no integer", name));
  return value;
}

float PnmHeader::real(std::string_view name) {
  std::string_view text = word(name);
  float value = 0;
  auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw damaged_image(where_, fmt::format("its {} is no number", name));
  return value;
}

void PnmHeader::end() {
  if (at_ >= bytes_.size() || !is_space(bytes_[at_]))
    throw damaged_image(where_, "it ends behind its header");
  ++at_;
}

bool is_pnm(ByteView bytes) {
  return bytes.size() >= 2 && bytes[0] == 'P' &&
         (bytes[1] == '2' || bytes[1] == '3' || bytes[1] == '5' || bytes[1] == '6');
}

Image decode_pnm(ByteView bytes, const Location& where, ProgressPart* progress) {
  PnmHeader header{bytes, where};
  bool text = bytes[1] == '2' || bytes[1] == '3';
  std::size_t channels = bytes[1] == '3' || bytes[1] == '6' ? 3 : 1;
  std::int64_t width = header.integer("width"), height = header.integer("height");
  std::int64_t maximum = header.integer("largest value");
  header.end();
  if (maximum < 1 || maximum > 65535)
    throw damaged_image(where, fmt::format("its largest value is {}, not 1 to 65535", maximum));
  check_image_size(where, width, height);
  std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  std::size_t wide = maximum > 255 ? 2 : 1;
  ByteView data = header.rest();
  // A number as text is a digit and a space, the last without the space.
  std::size_t due = w * h * channels * (text ? 2 : wide) - (text ? 1 : 0);
  if (data.size() < due)
    throw damaged_image(where, fmt::format("it holds {} bytes of pixels where {} are due", data.size(), due));

  std::vector<float> linear(static_cast<std::size_t>(maximum) + 1);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = linear_from_srgb(static_cast<float>(i) / static_cast<float>(maximum));
  const std::uint8_t* p = data.data();
  auto next = [&] {
    std::int64_t value = 0;
    if (text)
      value = header.integer("last pixel");
    else
      for (std::size_t i = 0; i < wide; ++i) value = value << 8 | *p++;
    if (value < 0 || value > maximum)
      throw damaged_image(where, fmt::format("a value of {} is not from 0 to {}", value, maximum));
    return linear[static_cast<std::size_t>(value)];
  };
  Image image{static_cast<int>(width), static_cast<int>(height), std::vector<vec3>(w * h)};
  for (std::size_t y = 0; y < h; ++y) {
    if (progress) progress->reach(static_cast<double>(y) / static_cast<double>(h));
    for (vec3& pixel : std::span(image.pixels).subspan(y * w, w)) {
      pixel.x = next();
      pixel.y = channels == 3 ? next() : pixel.x;
      pixel.z = channels == 3 ? next() : pixel.x;
    }
  }
  return image;
}

Bytes encode_ppm(int width, int height, ByteView rgb) {
  std::string header = fmt::format("P6\n{} {}\n255\n", width, height);
  Bytes out(header.size() + rgb.size());
  std::memcpy(out.data(), header.data(), header.size());
  if (!rgb.empty()) std::memcpy(out.data() + header.size(), rgb.data(), rgb.size());
  return out;
}

} // namespace candela
