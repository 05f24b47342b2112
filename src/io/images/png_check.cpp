// Checks a PNG's chunks (ISO/IEC 15948, clause 5): stb_image verifies neither checksums nor completeness, so
// a damaged file would silently give a wrong picture.

#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

namespace candela {

namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

constexpr std::array<std::uint32_t, 256> kCrcTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}();

std::uint32_t crc32(ByteView bytes) {
  std::uint32_t c = 0xffffffffu;
  for (std::uint8_t byte : bytes) c = kCrcTable[(c ^ byte) & 0xff] ^ (c >> 8);
  return ~c;
}

std::uint32_t big_endian(const std::uint8_t* p) {
  return std::uint32_t{p[0]} << 24 | std::uint32_t{p[1]} << 16 | std::uint32_t{p[2]} << 8 | p[3];
}

/// The least number of bytes in the decompressed rows of a picture, from its IHDR.
std::uint64_t row_bytes(const std::uint8_t* ihdr) {
  constexpr std::array<int, 7> kChannels = {1, 0, 3, 1, 2, 0, 4}; // by colour type
  std::uint64_t width = big_endian(ihdr), height = big_endian(ihdr + 4), depth = ihdr[8];
  std::uint64_t channels =
      ihdr[9] < kChannels.size() ? static_cast<std::uint64_t>(kChannels[ihdr[9]]) : std::uint64_t{0};
  return height * (1 + (width * channels * depth + 7) / 8);
}

} // namespace

bool is_png(ByteView bytes) {
  // Only the first half of the signature: the rest detects damage in transfer, which check_png reports.
  return bytes.size() >= 4 && std::memcmp(bytes.data(), kSignature.data(), 4) == 0;
}

void check_png(ByteView bytes, const Location& where) {
  if (bytes.size() < 8 || std::memcmp(bytes.data(), kSignature.data(), 8) != 0)
    throw damaged_image(where, "the PNG signature is damaged, as by a transfer in text mode");
  std::uint64_t compressed = 0, rows = 0;
  bool first = true;
  for (std::size_t at = 8;;) {
    if (bytes.size() - at < 12) throw damaged_image(where, "the PNG ends early");
    std::uint64_t length = big_endian(&bytes[at]);
    if (length > bytes.size() - at - 12) throw damaged_image(where, "the PNG ends early");
    ByteView type = bytes.subspan(at + 4, 4), data = bytes.subspan(at + 8, length);
    auto is = [&](const char* name) { return std::memcmp(type.data(), name, 4) == 0; };
    if (crc32(bytes.subspan(at + 4, 4 + length)) != big_endian(&bytes[at + 8 + length]))
      throw damaged_image(where, fmt::format("the checksum of the PNG chunk at byte {} is wrong", at));
    if (first) {
      if (!is("IHDR") || length != 13) throw damaged_image(where, "the PNG has no header");
      check_image_size(where, big_endian(data.data()), big_endian(data.data() + 4));
      rows = row_bytes(data.data());
      first = false;
    }
    if (is("IDAT")) {
      // stb_image would call memcpy with a null pointer, which is undefined; no known program writes such
      // files.
      if (compressed == 0 && length == 0) throw damaged_image(where, "the pixels of the PNG start empty");
      compressed += length;
    }
    if (is("IEND")) break;
    at += 12 + length;
  }
  // Deflate expands one byte to at most 1032.
  if (compressed * 1032 < rows) throw damaged_image(where, "the PNG is too short for the size it claims");
}

} // namespace candela
