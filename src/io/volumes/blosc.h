#pragma once
// Blocks that the compressors of OpenVDB have made.

#include "io/files/file_bytes.h"

namespace candela {

/// Decompresses a Blosc 1 buffer (compressors LZ4 and zlib, with or without its byte shuffle) to exactly
/// out.size() bytes. False if it is damaged or of another kind; then `out` holds anything. Never reads or
/// writes beyond either.
bool decompress_blosc(ByteView in, std::span<std::uint8_t> out);

/// The same of a zlib stream.
bool decompress_zlib(ByteView in, std::span<std::uint8_t> out);

/// The same of an LZ4 block.
bool decompress_lz4(ByteView in, std::span<std::uint8_t> out);

} // namespace candela
