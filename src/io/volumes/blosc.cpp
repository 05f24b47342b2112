#include "io/volumes/blosc.h"

#include <algorithm>
#include <cstring>
#include <zlib.h>

namespace candela {

namespace {

std::uint32_t little_endian(ByteView bytes, std::size_t at) {
  std::uint32_t out;
  std::memcpy(&out, bytes.data() + at, sizeof(out));
  return out;
}

/// A length of LZ4: 15 goes on in the next bytes, as long as they are 255. False at the end of the input.
bool extend_length(ByteView in, std::size_t& at, std::size_t& length) {
  if (length != 15) return true;
  for (std::uint8_t more = 255; more == 255; length += more) {
    if (at >= in.size()) return false;
    more = in[at++];
  }
  return true;
}

/// The first bytes of all elements, then all second ones … become elements.
void unshuffle(ByteView in, std::span<std::uint8_t> out, std::size_t element) {
  const std::size_t count = in.size() / element;
  for (std::size_t byte = 0; byte < element; ++byte)
    for (std::size_t i = 0; i < count; ++i) out[i * element + byte] = in[byte * count + i];
  std::copy(in.begin() + static_cast<std::ptrdiff_t>(count * element), in.end(),
            out.begin() + static_cast<std::ptrdiff_t>(count * element));
}

} // namespace

bool decompress_zlib(ByteView in, std::span<std::uint8_t> out) {
  uLongf written = out.size();
  return uncompress(out.data(), &written, in.data(), in.size()) == Z_OK && written == out.size();
}

bool decompress_lz4(ByteView in, std::span<std::uint8_t> out) {
  std::size_t at = 0, written = 0;
  while (at < in.size()) {
    const std::uint8_t token = in[at++];
    std::size_t literals = token >> 4;
    if (!extend_length(in, at, literals) || literals > in.size() - at || literals > out.size() - written)
      return false;
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(at), literals,
                out.begin() + static_cast<std::ptrdiff_t>(written));
    at += literals, written += literals;
    if (at == in.size()) break; // the last sequence has no match
    if (in.size() - at < 2) return false;
    const std::size_t back = in[at] | std::size_t{in[at + 1]} << 8;
    at += 2;
    std::size_t match = token & 15;
    if (!extend_length(in, at, match)) return false;
    match += 4;
    if (back == 0 || back > written || match > out.size() - written) return false;
    for (std::size_t i = 0; i < match; ++i, ++written) out[written] = out[written - back]; // may overlap
  }
  return written == out.size();
}

bool decompress_blosc(ByteView in, std::span<std::uint8_t> out) {
  constexpr std::size_t kHeaderBytes = 16, kMostSplits = 16, kLeastSplitBytes = 128;
  constexpr std::uint8_t kByteShuffle = 1, kCopied = 2, kBitShuffle = 4, kNotSplit = 16;
  if (in.size() < kHeaderBytes) return false;
  const std::uint8_t flags = in[2], compressor = flags >> 5;
  const std::size_t element = in[3], size = little_endian(in, 4), block_size = little_endian(in, 8);
  if (size != out.size() || little_endian(in, 12) != in.size() || (flags & kBitShuffle) != 0) return false;
  if (size == 0) return true;
  if ((flags & kCopied) != 0) {
    if (in.size() - kHeaderBytes != size) return false;
    std::memcpy(out.data(), in.data() + kHeaderBytes, size);
    return true;
  }
  constexpr std::uint8_t kLz4 = 1, kZlib = 3;
  if (block_size == 0 || element == 0 || (compressor != kLz4 && compressor != kZlib)) return false;
  const std::size_t blocks = (size + block_size - 1) / block_size;
  if (blocks > (in.size() - kHeaderBytes) / 4) return false;
  Bytes shuffled;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::span<std::uint8_t> block =
        out.subspan(b * block_size, std::min(block_size, size - b * block_size));
    const bool shuffle = (flags & kByteShuffle) != 0 && element > 1;
    shuffled.resize(shuffle ? block.size() : 0);
    const std::span<std::uint8_t> to = shuffle ? std::span<std::uint8_t>(shuffled) : block;
    const bool split = (flags & kNotSplit) == 0 && element <= kMostSplits && block.size() == block_size &&
                       block_size / element >= kLeastSplitBytes;
    const std::size_t parts = split ? element : 1, part_size = block.size() / parts;
    if (part_size * parts != block.size()) return false;
    std::size_t at = little_endian(in, kHeaderBytes + 4 * b);
    for (std::size_t p = 0; p < parts; ++p) {
      if (at > in.size() || in.size() - at < 4) return false;
      const std::size_t packed = little_endian(in, at);
      at += 4;
      if (packed > in.size() - at) return false;
      const ByteView from = in.subspan(at, packed);
      const std::span<std::uint8_t> part = to.subspan(p * part_size, part_size);
      if (packed == part_size)
        std::memcpy(part.data(), from.data(), part_size);
      else if (!(compressor == kLz4 ? decompress_lz4(from, part) : decompress_zlib(from, part)))
        return false;
      at += packed;
    }
    if (shuffle) unshuffle(shuffled, block, element);
  }
  return true;
}

} // namespace candela
