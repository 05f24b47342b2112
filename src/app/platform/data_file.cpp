#include "app/platform/data_file.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>

namespace candela {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> data_folders() {
  std::vector<fs::path> folders;
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (!failed) folders.push_back(program.parent_path().parent_path() / "share" / "candela");
  folders.emplace_back(CANDELA_SOURCE_DIR);
  folders.emplace_back(CANDELA_DATA_DIR);
  return folders;
}

} // namespace

fs::path find_data_file_if_any(std::string_view relative) {
  for (const fs::path& folder : data_folders()) {
    std::error_code failed;
    if (fs::exists(folder / relative, failed)) return folder / relative;
  }
  return {};
}

fs::path find_data_file(std::string_view relative) {
  fs::path found = find_data_file_if_any(relative);
  if (!found.empty()) return found;
  std::string places;
  for (const fs::path& folder : data_folders()) places += fmt::format(" {}", folder.string());
  throw Error(ExitCode::display, fmt::format("{}: it is in none of{}: install Candela again, or run it from "
                                             "the tree it was built in",
                                             relative, places));
}

std::string read_text_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw Error(ExitCode::display, fmt::format("{}: cannot be read: check it", path.string()));
  return text.str();
}

std::vector<fs::path> bundled_scenes() {
  std::vector<fs::path> scenes;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(find_data_file_if_any("scenes"), failed))
    if (entry.path().extension() == ".json" && entry.path().filename() != "gallery.json") // of figures
      scenes.push_back(entry.path());
  std::ranges::sort(scenes);
  return scenes;
}

} // namespace candela
