#pragma once
// Text files in memory, and the way from an offset in them back to a line and a column.

#include "core/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace candela {

class WarningList;

/// Reads a text file whole, as UTF-8, also where its byte order mark says that it is UTF-16 (Windows' editors
/// write it). A UTF-8 byte order mark at either end is dropped, and NUL bytes and the end mark
/// of DOS (0x1a) at the end, which programs leave that write whole blocks; those are a warning, if there is a
/// list of them. Throws input_error if it is missing, no regular file or holds another NUL byte (then it is
/// no text), limit_error above max_bytes, before it allocates, and Cancelled when the warnings' progress says
/// so. `element` says in messages what the file was to be ("scene", "mesh").
std::string read_text_file(const std::string& path, const char* element, std::size_t max_bytes,
                           WarningList* warnings = nullptr);

/// The line and column (from 1, in bytes) of text[offset]; offset == text.size() is the end of the file.
Location locate(const std::string& file, std::string_view text, std::size_t offset);

/// Without the spaces, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

/// Names go into JSON, which is UTF-8. Bytes that are not are taken for Latin-1, as old exporters write it.
std::string utf8_name(std::string_view bytes);

/// The ending of a path in lower case: ".obj"; empty if it has none.
std::string lower_ending(std::string_view path);

} // namespace candela
