#include "io/volumes/cvol_file.h"

#include "io/files/atomic_file.h"
#include "io/volumes/volume_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>

namespace candela {

namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(vec3) == 3 * sizeof(float));

constexpr std::string_view kCvolMagic = "candela volume ";
constexpr std::string_view kCvolRemedy = "write it as src/io/volumes/cvol_file.h describes it";

/// The header, line by line.
class CvolHeader {
public:
  CvolHeader(VolumeBytes& bytes, ByteView all) : bytes_(bytes) {
    constexpr std::size_t kMostBytes = 4096;
    const ByteView start = all.first(std::min(all.size(), kMostBytes));
    text_ = {reinterpret_cast<const char*>(start.data()), start.size()};
  }

  /// Next line's words; empty after "data".
  std::vector<std::string_view> line() {
    const std::size_t end = text_.find('\n', next_);
    if (end == std::string_view::npos)
      throw wrong("header", "there is no line 'data' in its first 4096 bytes");
    std::string_view rest = text_.substr(next_, end - next_);
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    next_ = end + 1, ++line_;
    std::vector<std::string_view> words;
    while (!rest.empty()) {
      const std::size_t space = std::min(rest.find(' '), rest.size());
      if (space > 0) words.push_back(rest.substr(0, space));
      rest.remove_prefix(std::min(space + 1, rest.size()));
    }
    if (words.empty()) throw wrong("header", "an empty line is in it");
    return words;
  }

  template <class T>
  T number(std::string_view element, std::string_view word) const {
    T value{};
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc() || end != word.data() + word.size())
      throw wrong(element, fmt::format("'{}' is no number that it could be", printable(word)));
    return value;
  }
  void expect(std::span<const std::string_view> words, std::size_t count) const {
    if (words.size() != count)
      throw wrong(words[0], fmt::format("{} values instead of {}", words.size() - 1, count - 1));
  }
  Error wrong(std::string_view element, std::string_view cause) const {
    return input_error({bytes_.file(), line_}, element, cause, kCvolRemedy);
  }
  std::size_t end() const { return next_; }

  static std::string printable(std::string_view word) {
    std::string out(word.substr(0, 40));
    for (char& c : out)
      if (c < ' ' || c > '~') c = '?';
    return out;
  }

private:
  VolumeBytes& bytes_;
  std::string_view text_;
  std::size_t next_ = 0;
  int line_ = 0;
};

std::vector<std::string> cvol_channels(const CvolHeader& header, std::span<const std::string_view> words) {
  std::vector<std::string> channels;
  for (std::string_view word : words.subspan(1)) {
    if (word != "density" && word != "temperature" && word != "color")
      throw header.wrong("channels", fmt::format("there is no channel '{}'", CvolHeader::printable(word)));
    if (std::ranges::find(channels, word) != channels.end())
      throw header.wrong("channels", fmt::format("'{}' is there twice", word));
    channels.emplace_back(word);
  }
  return channels;
}

template <class T>
void take_channel(VolumeBytes& bytes, std::vector<T>& values, std::uint64_t count) {
  const ByteView taken = bytes.take(count * sizeof(T));
  values.resize(static_cast<std::size_t>(count));
  std::memcpy(values.data(), taken.data(), taken.size());
}

} // namespace

bool is_cvol(ByteView bytes) {
  return bytes.size() >= kCvolMagic.size() &&
         std::memcmp(bytes.data(), kCvolMagic.data(), kCvolMagic.size()) == 0;
}

VolumeGrid parse_cvol(ByteView all, const std::string& file, WarningList& warnings) {
  VolumeBytes bytes(all, file);
  CvolHeader header(bytes, all);
  VolumeGrid grid;
  grid.bounds = {vec3(-1), vec3(1)};
  std::vector<std::string> channels;
  const auto first = header.line();
  if (first.size() != 3 || first[2] != "1") throw header.wrong("version", "only 1 is known");
  for (auto words = header.line(); words[0] != "data"; words = header.line()) {
    if (words[0] == "cells") {
      header.expect(words, 4);
      for (int a = 0; a < 3; ++a)
        grid.cells[a] = header.number<int>("cells", words[static_cast<std::size_t>(a) + 1]);
    } else if (words[0] == "bounds") {
      header.expect(words, 7);
      glm::dvec3 corners[2];
      for (int i = 0; i < 6; ++i)
        corners[i / 3][i % 3] = header.number<double>("bounds", words[static_cast<std::size_t>(i) + 1]);
      grid.bounds = checked_volume_bounds(file, corners[0], corners[1]);
    } else if (words[0] == "channels") {
      channels = cvol_channels(header, words);
    } else {
      throw header.wrong("header", fmt::format("'{}' is not known", CvolHeader::printable(words[0])));
    }
  }
  check_volume_cells(file, grid.cells.x, grid.cells.y, grid.cells.z);
  if (std::ranges::find(channels, "density") == channels.end())
    throw header.wrong("channels", "there is no density");
  bytes.seek(header.end());
  for (const std::string& channel : channels) {
    warnings.check_stop();
    if (channel == "density") take_channel(bytes, grid.density, grid.cell_count());
    if (channel == "temperature") take_channel(bytes, grid.temperature, grid.cell_count());
    if (channel == "color") take_channel(bytes, grid.color, grid.cell_count());
  }
  if (bytes.left() > 0) throw header.wrong("data", fmt::format("{} bytes are left over", bytes.left()));
  return grid;
}

void write_cvol(const VolumeGrid& grid, const std::string& path) {
  const vec3 lo = grid.bounds.lo, hi = grid.bounds.hi;
  const std::string header =
      fmt::format("{}1\ncells {} {} {}\nbounds {} {} {} {} {} {}\nchannels density{}{}\ndata\n", kCvolMagic,
                  grid.cells.x, grid.cells.y, grid.cells.z, lo.x, lo.y, lo.z, hi.x, hi.y, hi.z,
                  grid.temperature.empty() ? "" : " temperature", grid.color.empty() ? "" : " color");
  PendingFile file(path);
  const auto write = [&](const void* data, std::size_t size) {
    file.write({static_cast<const std::uint8_t*>(data), size});
  };
  write(header.data(), header.size());
  write(grid.density.data(), grid.density.size() * sizeof(float));
  write(grid.temperature.data(), grid.temperature.size() * sizeof(float));
  write(grid.color.data(), grid.color.size() * sizeof(vec3));
  file.commit();
}

} // namespace candela
