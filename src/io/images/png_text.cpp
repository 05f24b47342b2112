// Text in PNG (ISO/IEC 15948, clause 11.3.4.5, iTXt): name, and UTF-8 that may be compressed by zlib.

#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <zlib.h>

namespace candela {

namespace {

/// Texts of at least this size are compressed; shorter ones stay readable in the file.
constexpr std::size_t kLongText = 256;
constexpr std::size_t kEndChunk = 12; ///< IEND has no data

void append_big_endian(Bytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

Bytes compressed(std::string_view text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  Bytes out(size);
  if (compress2(out.data(), &size, reinterpret_cast<const Bytef*>(text.data()),
                static_cast<uLong>(text.size()), Z_BEST_COMPRESSION) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

Error damaged_text(const Location& where, std::string_view name) {
  return damaged_image(where, fmt::format("its text '{}' is damaged", name));
}

std::string decompressed(ByteView data, std::string_view name, const Location& where) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  struct Guard {
    z_stream& stream;
    ~Guard() { inflateEnd(&stream); }
  } guard{stream};
  stream.next_in = const_cast<Bytef*>(data.data()); // zlib does not modify it
  stream.avail_in = static_cast<uInt>(data.size());
  std::string out;
  std::array<char, 65536> part;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state != Z_OK && state != Z_STREAM_END) throw damaged_text(where, name);
    const std::size_t made = part.size() - stream.avail_out;
    if (made == 0 && state == Z_OK && stream.avail_in == 0) throw damaged_text(where, name);
    if (out.size() + made > kMaxPictureText) // the decompressed size is limited
      throw limit_error(where, fmt::format("text '{}'", name),
                        fmt::format("it is longer than {} bytes", kMaxPictureText),
                        "it is no text that Candela has written");
    out.append(part.data(), made);
  }
  return out;
}

} // namespace

Bytes with_png_text(Bytes png, const ImageMetadata& text) {
  const Bytes end(png.end() - kEndChunk, png.end());
  png.resize(png.size() - kEndChunk);
  for (const auto& [name, value] : text) {
    const bool compress = value.size() >= kLongText;
    Bytes chunk{'i', 'T', 'X', 't'};
    chunk.insert(chunk.end(), name.begin(), name.end());
    // End of the name, compression flag, method (zlib), no language, no translated name.
    for (int byte : {0, compress ? 1 : 0, 0, 0, 0}) chunk.push_back(static_cast<std::uint8_t>(byte));
    if (compress) {
      const Bytes data = compressed(value);
      chunk.insert(chunk.end(), data.begin(), data.end());
    } else {
      chunk.insert(chunk.end(), value.begin(), value.end());
    }
    append_big_endian(png, static_cast<std::uint32_t>(chunk.size() - 4));
    png.insert(png.end(), chunk.begin(), chunk.end());
    append_big_endian(png,
                      static_cast<std::uint32_t>(::crc32(0, chunk.data(), static_cast<uInt>(chunk.size()))));
  }
  png.insert(png.end(), end.begin(), end.end());
  return png;
}

std::optional<std::string> png_text(ByteView bytes, std::string_view name, const Location& where) {
  auto length_at = [&](std::size_t at) {
    return std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 | std::size_t{bytes[at + 2]} << 8 |
           bytes[at + 3];
  };
  for (std::size_t at = 8; std::memcmp(&bytes[at + 4], "IEND", 4) != 0; at += 12 + length_at(at)) {
    if (std::memcmp(&bytes[at + 4], "iTXt", 4) != 0) continue;
    ByteView data = bytes.subspan(at + 8, length_at(at));
    if (data.size() < name.size() + 1 || !std::equal(name.begin(), name.end(), data.begin()) ||
        data[name.size()] != 0)
      continue;
    data = data.subspan(name.size() + 1);
    if (data.size() < 4 || data[0] > 1 || data[1] != 0) throw damaged_text(where, name);
    const bool compressed_text = data[0] == 1;
    data = data.subspan(2);
    for (int i = 0; i < 2; ++i) { // skips the language and the translated name
      const auto zero = std::find(data.begin(), data.end(), 0);
      if (zero == data.end()) throw damaged_text(where, name);
      data = data.subspan(static_cast<std::size_t>(zero - data.begin()) + 1);
    }
    if (compressed_text) return decompressed(data, name, where);
    return std::string(data.begin(), data.end());
  }
  return std::nullopt;
}

} // namespace candela
