// Portable pixmaps and greymaps (netpbm's ppm(5), pgm(5)): P2, P3 as text, P5, P6 binary. The specification
// has the transfer curve of BT.709, but programs write sRGB, so values are read as sRGB.

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

namespace {

/// The numbers of the file.
struct PnmRaster {
  std::int64_t width = 0, height = 0, maximum = 0;
  std::size_t channels = 1;
  std::vector<std::uint16_t> values;
};

PnmRaster read_raster(ByteView bytes, const Location& where, ProgressPart* progress) {
  PnmHeader header{bytes, where};
  PnmRaster out;
  bool text = bytes[1] == '2' || bytes[1] == '3';
  out.channels = bytes[1] == '3' || bytes[1] == '6' ? 3 : 1;
  out.width = header.integer("width"), out.height = header.integer("height");
  out.maximum = header.integer("largest value");
  header.end();
  if (out.maximum < 1 || out.maximum > 65535)
    throw damaged_image(where, fmt::format("its largest value is {}, not 1 to 65535", out.maximum));
  check_image_size(where, out.width, out.height);
  std::size_t w = static_cast<std::size_t>(out.width), h = static_cast<std::size_t>(out.height);
  std::size_t wide = out.maximum > 255 ? 2 : 1;
  ByteView data = header.rest();
  // A number in text form has at least a digit and a space, the last one only a digit.
  std::size_t due = w * h * out.channels * (text ? 2 : wide) - (text ? 1 : 0);
  if (data.size() < due)
    throw damaged_image(where, fmt::format("it holds {} bytes of pixels where {} are due", data.size(), due));
  const std::uint8_t* p = data.data();
  out.values.resize(w * h * out.channels);
  for (std::size_t y = 0; y < h; ++y) {
    if (progress) progress->reach(static_cast<double>(y) / static_cast<double>(h));
    for (std::uint16_t& v : std::span(out.values).subspan(y * w * out.channels, w * out.channels)) {
      std::int64_t value = 0;
      if (text)
        value = header.integer("last pixel");
      else
        for (std::size_t i = 0; i < wide; ++i) value = value << 8 | *p++;
      if (value < 0 || value > out.maximum)
        throw damaged_image(where, fmt::format("a value of {} is not from 0 to {}", value, out.maximum));
      v = static_cast<std::uint16_t>(value);
    }
  }
  return out;
}

/// The integer for 1, if `maximum` is 1 in the file.
template <class T>
std::vector<T> scaled(const PnmRaster& raster) {
  constexpr std::int64_t kMost = std::numeric_limits<T>::max();
  std::vector<T> out;
  out.reserve(raster.values.size());
  for (std::uint16_t v : raster.values)
    out.push_back(static_cast<T>((v * kMost + raster.maximum / 2) / raster.maximum));
  return out;
}

} // namespace

Image decode_pnm(ByteView bytes, const Location& where, ProgressPart* progress) {
  const PnmRaster raster = read_raster(bytes, where, progress);
  std::vector<float> linear(static_cast<std::size_t>(raster.maximum) + 1);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = linear_from_srgb(static_cast<float>(i) / static_cast<float>(raster.maximum));
  Image image{static_cast<int>(raster.width), static_cast<int>(raster.height),
              std::vector<vec3>(raster.values.size() / raster.channels)};
  const std::uint16_t* p = raster.values.data();
  for (vec3& pixel : image.pixels) {
    pixel = raster.channels == 3 ? vec3(linear[p[0]], linear[p[1]], linear[p[2]]) : vec3(linear[p[0]]);
    p += raster.channels;
  }
  return image;
}

Texels decode_pnm_texels(ByteView bytes, const Location& where, ProgressPart* progress) {
  const PnmRaster raster = read_raster(bytes, where, progress);
  Texels out{
      static_cast<int>(raster.width), static_cast<int>(raster.height), static_cast<int>(raster.channels), {}};
  if (raster.maximum > 255)
    out.data = scaled<std::uint16_t>(raster);
  else
    out.data = scaled<std::uint8_t>(raster);
  return out;
}

Bytes encode_ppm(int width, int height, ByteView rgb) {
  std::string header = fmt::format("P6\n{} {}\n255\n", width, height);
  Bytes out(header.size() + rgb.size());
  std::memcpy(out.data(), header.data(), header.size());
  if (!rgb.empty()) std::memcpy(out.data() + header.size(), rgb.data(), rgb.size());
  return out;
}

} // namespace candela
