#pragma once
// Pictures that the tests write for inspection.

#include <filesystem>
#include <string>

namespace candela::test {

/// The path of screenshots/<name> in the tests' build folder, independent of the working folder.
inline std::string screenshot_path(const std::string& name) {
  const std::filesystem::path folder = CANDELA_SCREENSHOTS;
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

} // namespace candela::test
