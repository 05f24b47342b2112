#pragma once
// Reading text files, and mapping offsets to lines and columns.

#include "core/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace candela {

class WarningList;

/// Reads a text file as UTF-8; UTF-16 with a byte order mark (written by Windows' editors) is converted.
/// Drops a UTF-8 byte order mark at either end, and, with a warning if there is a list, trailing NUL bytes
/// and DOS end marks (0x1a), which some programs write to fill blocks. Throws input_error if the file is
/// missing, not regular or contains other NUL bytes (then it is not a text), limit_error above max_bytes,
/// before allocation, and Cancelled when the warnings' progress is cancelled. `element` is the file's role in
/// messages ("scene", "mesh").
std::string read_text_file(const std::string& path, const char* element, std::size_t max_bytes,
                           WarningList* warnings = nullptr);

/// The line and column (from 1, in bytes) of text[offset]; offset == text.size() is the end of the file.
Location locate(const std::string& file, std::string_view text, std::size_t offset);

/// Removes spaces, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

/// A name as UTF-8, for JSON. Invalid bytes are read as Latin-1, which old exporters write.
std::string utf8_name(std::string_view bytes);

/// The ending of a path in lower case: ".obj"; empty if it has none.
std::string lower_ending(std::string_view path);

} // namespace candela
