#pragma once
// Finds the program's files (shaders, scenes) from any working folder: relative to an installed program
// (PREFIX/bin and PREFIX/share/candela, even if the prefix was moved), in the source tree that it was built
// from, or at the configured install prefix.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// Absolute path of a file or folder such as "shaders/picture.frag" or "scenes"; if it is not found, an Error
/// with ExitCode::display that lists the searched places.
std::filesystem::path find_data_file(std::string_view relative);

/// The same, empty instead of an error.
std::filesystem::path find_data_file_if_any(std::string_view relative);

/// The whole file; an Error (ExitCode::display) if it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

/// The scenes that come with the program, sorted by name.
std::vector<std::filesystem::path> bundled_scenes();

} // namespace candela
