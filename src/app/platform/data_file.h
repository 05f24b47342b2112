#pragma once
// Finds the files that come with the program (shaders, scenes) from any working folder: beside an installed
// program (PREFIX/bin and PREFIX/share/candela, wherever the prefix was moved to), in the source tree that
// it was built from, or where the build was told to install.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// Absolute path of "shaders/picture.frag", "scenes" and the like; an Error with ExitCode::display that names
/// the places looked at if it is nowhere.
std::filesystem::path find_data_file(std::string_view relative);

/// The same, empty instead of an error.
std::filesystem::path find_data_file_if_any(std::string_view relative);

/// The whole file; an Error (ExitCode::display) if it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

/// The scenes that come with the program, sorted by name.
std::vector<std::filesystem::path> bundled_scenes();

} // namespace candela
