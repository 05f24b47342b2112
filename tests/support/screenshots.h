#pragma once
// Pictures that the tests leave behind to be looked at.

#include <filesystem>
#include <string>

namespace candela::test {

/// Where to write screenshots/<name> of the tests' build folder, wherever they are run.
inline std::string screenshot_path(const std::string& name) {
  const std::filesystem::path folder = CANDELA_SCREENSHOTS;
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

} // namespace candela::test
