#pragma once
// Whole files in memory, which is where the decoders of this folder read them.

#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace candela {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Reads a regular file (a pipe or a device could hold the reader up for ever), piece by piece: a slow disk
/// does not keep who wants to stop. `element` names in messages what the file was to be ("image", "mesh").
/// Throws input_error if it cannot be opened or read, limit_error above max_bytes, before anything is
/// allocated, and Cancelled when `progress`, which may be null, says so.
Bytes read_file_bytes(const std::string& path, const char* element, const Progress* progress = nullptr,
                      std::size_t max_bytes = 0x7fffffff);
/// The same as characters: there is no second copy of a large text.
std::string read_file_characters(const std::string& path, const char* element, std::size_t max_bytes,
                                 const Progress* progress = nullptr);

} // namespace candela
