#include "app/viewer/dropped_files.h"

#include "io/files/text_file.h"
#include "io/images/image_file.h"
#include "io/scene_formats.h"
#include "io/volumes/volume_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace candela {

namespace fs = std::filesystem;

namespace {

/// Order of preference: files that refer to others come first.
enum class Kind { scene, model, picture, part, other };

Kind kind_of(const std::string& path) {
  const std::string ending = lower_ending(path);
  if (const SceneFormat* format = scene_format(path); format != nullptr)
    return format->is_model ? Kind::model : Kind::scene;
  if (ending == kJobEnding) return Kind::scene;
  if (ending == ".mtl") return Kind::part;
  return is_image_name(path) || ending == ".ies" || is_volume_name(path) ? Kind::picture : Kind::other;
}

std::string name_of(const std::string& path) { return fs::path(path).filename().string(); }

/// "a.json, b.json and 5 more".
std::string listed(const std::vector<std::string>& paths) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(paths.size(), kMost); ++i) names.push_back(name_of(paths[i]));
  std::string text = fmt::format("{}", fmt::join(names, ", "));
  if (paths.size() > kMost) text += fmt::format(" and {} more", paths.size() - kMost);
  return text;
}

/// The only scene of a folder.
Dropped choose_in_folder(const std::string& folder) {
  constexpr std::size_t kMostLooked = 10000;
  std::vector<std::string> scenes, models;
  std::error_code failed;
  std::size_t looked = 0;
  for (fs::directory_iterator file(folder, failed), end; !failed && file != end && looked < kMostLooked;
       file.increment(failed), ++looked) {
    std::error_code unreadable;
    if (!file->is_regular_file(unreadable)) continue;
    const Kind kind = kind_of(file->path().string());
    if (kind == Kind::scene) scenes.push_back(file->path().string());
    if (kind == Kind::model) models.push_back(file->path().string());
  }
  if (failed) return {"", fmt::format("{}: folder: {}: drop a file", folder, failed.message())};
  auto& found = scenes.empty() ? models : scenes;
  if (found.size() == 1) return {found.front(), ""};
  if (found.empty())
    return {"", fmt::format("{}: folder: there is no scene in it: drop a {} or {} file", folder,
                            scene_endings(", "), kJobEnding)};
  std::ranges::sort(found);
  return {"", fmt::format("{}: folder: it has {} scenes ({}): drop one of them", folder, found.size(),
                          listed(found))};
}

} // namespace

Dropped choose_dropped(const std::vector<std::string>& paths) {
  std::vector<std::string> files, problems;
  for (const std::string& path : paths) {
    std::error_code failed;
    if (!fs::is_directory(path, failed)) {
      files.push_back(path);
      continue;
    }
    Dropped inside = choose_in_folder(path);
    if (!inside.open.empty()) files.push_back(std::move(inside.open));
    if (!inside.remark.empty()) problems.push_back(std::move(inside.remark));
  }
  if (files.empty()) return {"", problems.empty() ? "" : problems.front()};
  const auto chosen = std::ranges::min_element(files, {}, kind_of); // the first file of the preferred kind
  std::set<std::string> models;                                     // without their endings
  for (const std::string& file : files)
    if (kind_of(file) == Kind::model) models.insert(fs::path(file).replace_extension().string());
  std::vector<std::string> left;
  for (auto file = files.begin(); file != files.end(); ++file) {
    const bool goes_along =
        kind_of(*file) == Kind::part && models.contains(fs::path(*file).replace_extension().string());
    if (file != chosen && !goes_along) left.push_back(*file);
  }
  Dropped result{*chosen, ""};
  if (!left.empty()) result.remark = fmt::format("left aside: {} (one at a time)", listed(left));
  if (!problems.empty()) result.remark += (left.empty() ? "" : "; ") + problems.front();
  return result;
}

} // namespace candela
