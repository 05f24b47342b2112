// Radiance RGBE pictures: Ward, "Real Pixels", Graphics Gems II (1991), and the run lengths of Radiance's
// color.c. stb_image reads them, too, but returns uninitialised memory for truncated files, and supports
// neither the exposure nor other orientations.
//
// A mantissa m with exponent byte e is m * 2^(e - 136), as most programs read it (Radiance itself adds half
// a step to m).

#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstring>

namespace candela {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

/// The header's lines, then the pixels' bytes.
class Cursor {
public:
  Cursor(ByteView bytes, const Location& where) : bytes_(bytes), where_(where) {}

  std::string_view line() {
    std::size_t begin = at_;
    while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
    if (at_ >= bytes_.size()) throw damaged_image(where_, "the HDR ends within its header");
    std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + begin, at_++ - begin);
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
  }
  std::uint8_t byte() {
    if (at_ >= bytes_.size()) throw damaged_image(where_, "the HDR ends early");
    return bytes_[at_++];
  }
  Rgbe pixel() {
    Rgbe p{};
    for (auto& b : p) b = byte();
    return p;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  /// Whether a scan line in Radiance's new run-length encoding starts here.
  bool starts_new_rle(int length) const {
    return length >= 8 && length < 32768 && left() >= 4 && bytes_[at_] == 2 && bytes_[at_ + 1] == 2 &&
           (bytes_[at_ + 2] << 8 | bytes_[at_ + 3]) == length;
  }
  void skip(std::size_t n) { at_ += n; }

private:
  ByteView bytes_;
  const Location& where_;
  std::size_t at_ = 0;
};

/// The four components in turn, each run-length encoded.
void read_new_rle(Cursor& in, std::vector<Rgbe>& row, const Location& where) {
  in.skip(4);
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t x = 0; x < row.size();) {
      std::size_t count = in.byte();
      bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > row.size() - x)
        throw damaged_image(where, "a run of the HDR leaves its scan line");
      std::uint8_t value = run ? in.byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) row[x++][c] = run ? value : in.byte();
    }
}

/// Uncompressed pixels, with the old encoding's repeat marks (1, 1, 1, count); counts of consecutive marks
/// are the bytes of one number, lowest first.
void read_flat(Cursor& in, std::vector<Rgbe>& row, const Location& where) {
  int shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    Rgbe p = in.pixel();
    if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
      row[x++] = p;
      shift = 0;
      continue;
    }
    std::size_t count = shift < 32 ? static_cast<std::size_t>(p[3]) << shift : row.size() + 1;
    if (x == 0 || count > row.size() - x) throw damaged_image(where, "a run of the HDR leaves its scan line");
    for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
    shift += 8;
  }
}

struct Resolution {
  int width = 0, height = 0;
  bool flip_x = false, flip_y = false, by_columns = false;
};

/// "-Y 512 +X 768": the order of scan lines. -Y first means from the top.
Resolution parse_resolution(std::string_view text, const Location& where) {
  struct Axis {
    bool positive = false;
    char name = 0;
    std::int64_t count = 0;
  };
  std::array<Axis, 2> axes;
  auto bad = [&] { return damaged_image(where, "the HDR's line of its size is damaged"); };
  for (Axis& axis : axes) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    if (text.size() < 4 || (text[0] != '-' && text[0] != '+') || text[2] != ' ') throw bad();
    axis.positive = text[0] == '+';
    axis.name = text[1];
    text.remove_prefix(3);
    auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), axis.count);
    if (status != std::errc()) throw bad();
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  bool by_columns = axes[0].name == 'X';
  const Axis& y = axes[by_columns ? 1 : 0];
  const Axis& x = axes[by_columns ? 0 : 1];
  if (x.name != 'X' || y.name != 'Y') throw bad();
  check_image_size(where, x.count, y.count);
  return {static_cast<int>(x.count), static_cast<int>(y.count), !x.positive, y.positive, by_columns};
}

/// EXPOSURE and COLORCORR lines have the factors by which the pixels were multiplied.
std::array<double, 3> parse_numbers(std::string_view text, std::size_t count, const Location& where) {
  std::array<double, 3> values{1, 1, 1};
  for (std::size_t i = 0; i < count; ++i) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), values[i]);
    if (status != std::errc() || !std::isfinite(values[i]) || values[i] <= 0)
      throw damaged_image(where, "the HDR's exposure is no positive number");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  if (count == 1) values.fill(values[0]);
  return values;
}

} // namespace

bool is_hdr(ByteView bytes) { return bytes.size() >= 2 && bytes[0] == '#' && bytes[1] == '?'; }

Image decode_hdr(ByteView bytes, const Location& where, ProgressPart* progress) {
  Cursor in{bytes, where};
  in.line();
  std::array<double, 3> divisor{1, 1, 1};
  for (std::string_view line = in.line(); !line.empty(); line = in.line()) {
    auto divide = [&](std::string_view key, std::size_t count) {
      if (!line.starts_with(key)) return;
      auto values = parse_numbers(line.substr(key.size()), count, where);
      for (std::size_t c = 0; c < 3; ++c) divisor[c] *= values[c];
    };
    divide("EXPOSURE=", 1);
    divide("COLORCORR=", 3);
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
      throw input_error(where, "image", fmt::format("its format is '{}'", line.substr(7, 40)),
                        "save it as 32-bit_rle_rgbe");
  }
  Resolution size = parse_resolution(in.line(), where);
  int length = size.by_columns ? size.height : size.width;
  int lines = size.by_columns ? size.width : size.height;
  // The least size of a scan line: runs of 127 of each component, or one pixel and repeat marks that grow by
  // a factor of 256.
  std::size_t least = length < 8 ? 4 : 8;
  if (in.left() / least < static_cast<std::size_t>(lines))
    throw damaged_image(where, "the HDR is too short for the size it claims");

  Image image{
      size.width, size.height,
      std::vector<vec3>(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height))};
  std::vector<Rgbe> row(static_cast<std::size_t>(length));
  for (int j = 0; j < lines; ++j) {
    if (progress) progress->reach(static_cast<double>(j) / lines);
    if (in.starts_new_rle(length))
      read_new_rle(in, row, where);
    else
      read_flat(in, row, where);
    for (int i = 0; i < length; ++i) {
      const Rgbe& p = row[static_cast<std::size_t>(i)];
      int x = size.by_columns ? j : i, y = size.by_columns ? i : j;
      vec3& pixel = image.at(size.flip_x ? size.width - 1 - x : x, size.flip_y ? size.height - 1 - y : y);
      double scale = p[3] == 0 ? 0 : std::ldexp(1.0, p[3] - 136);
      for (int c = 0; c < 3; ++c) {
        auto k = static_cast<std::size_t>(c);
        pixel[c] = static_cast<float>(static_cast<double>(p[k]) * scale / divisor[k]);
      }
    }
  }
  return image;
}

namespace {

Rgbe rgbe_of(vec3 color) {
  for (int c = 0; c < 3; ++c) // the format's maximum; comparisons with NaN are false
    color[c] = color[c] > 0 ? std::min(color[c], 255.0f * 0x1p119f) : 0.0f;
  float largest = max_component(color);
  if (largest < 0x1p-128f) return {0, 0, 0, 0};
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Rounding may give a mantissa of 256: then use the next exponent.
  if (std::nearbyint(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
  Rgbe p{0, 0, 0, static_cast<std::uint8_t>(exponent + 128)};
  for (int c = 0; c < 3; ++c)
    p[static_cast<std::size_t>(c)] =
        static_cast<std::uint8_t>(std::nearbyint(std::ldexp(color[c], 8 - exponent)));
  return p;
}

/// Only runs of at least four equal bytes save space.
void write_component(const std::vector<Rgbe>& row, std::size_t c, Bytes& out) {
  constexpr std::size_t kWorth = 4;
  auto run_at = [&](std::size_t x) {
    std::size_t n = 1;
    while (n < 127 && x + n < row.size() && row[x + n][c] == row[x][c]) ++n;
    return n;
  };
  for (std::size_t x = 0; x < row.size();) {
    std::size_t begin = x, run = 0;
    while (x < row.size() && x - begin < 128 && (run = run_at(x)) < kWorth)
      x += std::min(run, 128 - (x - begin));
    if (x > begin) {
      out.push_back(static_cast<std::uint8_t>(x - begin));
      for (std::size_t i = begin; i < x; ++i) out.push_back(row[i][c]);
    }
    if (x < row.size() && run >= kWorth) {
      out.push_back(static_cast<std::uint8_t>(128 + run));
      out.push_back(row[x][c]);
      x += run;
    }
  }
}

} // namespace

Bytes encode_hdr(const Image& image, const ImageMetadata& metadata) {
  std::string header = "#?RADIANCE\n";
  for (const auto& [key, value] : metadata) {
    std::string line = fmt::format("# {}={}", key, value);
    for (char& c : line)
      if (c == '\n' || c == '\r') c = ' ';
    header += line + '\n';
  }
  header += fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
  Bytes out(header.begin(), header.end());
  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  bool runs = image.width >= 8 && image.width < 32768;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) row[static_cast<std::size_t>(x)] = rgbe_of(image.at(x, y));
    if (runs) {
      out.insert(out.end(), {2, 2, static_cast<std::uint8_t>(image.width >> 8),
                             static_cast<std::uint8_t>(image.width & 255)});
      for (std::size_t c = 0; c < 4; ++c) write_component(row, c, out);
    } else {
      for (const Rgbe& p : row) out.insert(out.end(), p.begin(), p.end());
    }
  }
  return out;
}

} // namespace candela
