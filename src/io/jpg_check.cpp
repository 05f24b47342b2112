// A walk over a JPEG's markers (ITU-T T.81, annex B). Debian's stb_image 2.27 writes past its arrays for a
// Huffman table of more than 256 codes (fixed in 2.28), and fills in grey for what a short file lacks; both
// are refused here before it sees the file. The walk finds the same segments as stb_image does: what lies
// between them is skipped up to the next marker.

#include "io/image_codec.h"

namespace candela {

namespace {

/// One segment may define several tables: a class and number, 16 counts, the values (B.2.4.2).
void check_huffman_tables(ByteView tables, const Location& where) {
  while (!tables.empty()) {
    if (tables.size() < 17) throw damaged_image(where, "a Huffman table of the JPEG is damaged");
    std::size_t count = 0;
    for (std::size_t i = 1; i <= 16; ++i) count += tables[i];
    if (count > 256 || tables.size() < 17 + count)
      throw damaged_image(where, "a Huffman table of the JPEG is damaged");
    tables = tables.subspan(17 + count);
  }
}

} // namespace

bool is_jpg(ByteView bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

void check_jpg(ByteView bytes, const Location& where) {
  constexpr std::uint8_t kHuffman = 0xc4, kEnd = 0xd9, kRestart0 = 0xd0, kRestart7 = 0xd7;
  auto early = [&] { return damaged_image(where, "the JPEG ends before its end marker"); };
  for (std::size_t at = 2;;) {
    while (at < bytes.size() && bytes[at] != 0xff) ++at; // coded pixels, padding
    while (at < bytes.size() && bytes[at] == 0xff) ++at;
    if (at >= bytes.size()) throw early();
    std::uint8_t marker = bytes[at++];
    if (marker == 0 || (marker >= kRestart0 && marker <= kRestart7)) continue; // still coded pixels
    if (marker == kEnd) return;
    if (bytes.size() - at < 2) throw early();
    std::size_t length = static_cast<std::size_t>(bytes[at] << 8 | bytes[at + 1]);
    if (length < 2) throw damaged_image(where, "a segment of the JPEG has no length");
    if (length > bytes.size() - at) throw early();
    if (marker == kHuffman) check_huffman_tables(bytes.subspan(at + 2, length - 2), where);
    at += length;
  }
}

} // namespace candela
