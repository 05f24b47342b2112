#include "io/path_policy.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace candela {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

namespace {

/// Never throws: what cannot be resolved stays as it is and is not found later.
fs::path canonical_or_same(const fs::path& path) {
  std::error_code failed;
  fs::path absolute = fs::absolute(path, failed);
  if (failed) absolute = path;
  fs::path canonical = fs::weakly_canonical(absolute, failed);
  return failed ? absolute.lexically_normal() : canonical;
}

bool is_inside(const fs::path& file, const fs::path& root) {
  auto [r, f] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return r == root.end();
}

bool is_file(const fs::path& path) {
  std::error_code failed;
  return fs::is_regular_file(path, failed);
}

} // namespace

std::string canonical_path(const std::string& path) { return canonical_or_same(path).string(); }

std::optional<std::string> path_below(const std::string& folder, const std::string& file) {
  fs::path root = canonical_or_same(folder), found = canonical_or_same(file);
  if (file.empty() || !is_file(found) || !is_inside(found, root)) return std::nullopt;
  return found.lexically_relative(root).generic_string();
}

PathPolicy::PathPolicy(const std::string& root_folder, bool allow_outside)
    : root_(canonical_or_same(root_folder).string()), allow_outside_(allow_outside) {}

std::optional<FoundFile> PathPolicy::find(const std::string& reference, const std::string& base_folder,
                                          const Location& where, std::string_view element) const {
  constexpr std::size_t kLongestPath = 4096;
  if (reference.empty() || reference.size() > kLongestPath || reference.find('\0') != std::string::npos)
    throw input_error(where, element, "this is no file name", "give the path of a file");
  std::string name = reference;
  auto full = [&] { return (fs::path(base_folder) / name).lexically_normal(); };
  if (name.find('\\') != std::string::npos && !is_file(full()))
    std::replace(name.begin(), name.end(), '\\', '/');
  if (!allow_outside_ && fs::path(name).is_absolute())
    throw input_error(where, element, fmt::format("'{}' is an absolute path", reference),
                      "name it relative to the scene, or allow it with --allow-outside");
  // Resolved as written: "link/../x" is beside what the link points to.
  fs::path canonical = canonical_or_same(fs::path(base_folder) / name);
  if (!allow_outside_ && !is_inside(canonical, root_) && !admitted_.contains(canonical.string()))
    throw input_error(where, element,
                      fmt::format("'{}' lies outside the scene's folder tree ({})", reference, root_),
                      "move it there, or allow it with --allow-outside");
  if (!asked_->contains(canonical.string()))
    asked_->emplace(canonical.string(), file_stamp(canonical.string()));
  if (!is_file(canonical)) return std::nullopt;
  // The short form leads elsewhere if it drops a ".." behind a link; files beside this one start from it.
  fs::path shown = full();
  return FoundFile{(canonical_or_same(shown) == canonical ? shown : canonical).string(), canonical.string()};
}

FoundFile PathPolicy::require(const std::string& reference, const std::string& base_folder,
                              const Location& where, std::string_view element) const {
  if (auto found = find(reference, base_folder, where, element)) return *found;
  const fs::path folder = (fs::path(base_folder) / reference).lexically_normal().parent_path();
  throw input_error(where, element, fmt::format("there is no file '{}'", reference),
                    fmt::format("put it into {}, or correct the name",
                                folder.empty() ? "the current folder" : folder.string()));
}

} // namespace candela
