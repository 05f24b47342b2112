#pragma once
// Reading whole files into memory, for the decoders.

#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace candela {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Reads a regular file (a pipe or a device could block for ever) in pieces, to react to cancellation on slow
/// disks. `element` is the file's role in messages ("image", "mesh"). Throws input_error if it cannot be
/// opened or read, limit_error above max_bytes, before allocation, and Cancelled when `progress`, which may
/// be null, is cancelled.
Bytes read_file_bytes(const std::string& path, const char* element, const Progress* progress = nullptr,
                      std::size_t max_bytes = 0x7fffffff);
/// The same as characters, without a second copy of the text.
std::string read_file_characters(const std::string& path, const char* element, std::size_t max_bytes,
                                 const Progress* progress = nullptr);

} // namespace candela
