#include "io/files/path_policy.h"

#include "io/files/text_file.h"

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

/// Never throws: a path that cannot be resolved is returned unchanged, and is not found later.
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

/// Whether a name is absolute on Windows: "C:\x", "C:/x", "\\server\x".
bool is_windows_absolute(std::string_view name) {
  auto is_slash = [](char c) { return c == '\\' || c == '/'; };
  auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return (name.size() > 2 && is_letter(name[0]) && name[1] == ':' && is_slash(name[2])) ||
         name.starts_with('\\');
}

bool equal_but_case(std::string_view a, std::string_view b) {
  auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

/// The folder's entry that equals the name up to the case of letters; empty if there is none.
std::string name_in_other_case(const fs::path& folder, const std::string& name) {
  constexpr int kMostEntries = 100'000;
  std::error_code failed;
  std::string found;
  fs::directory_iterator entry(folder, failed);
  for (int i = 0; !failed && i < kMostEntries && entry != fs::directory_iterator(); ++i) {
    const std::string candidate = entry->path().filename().string();
    if (equal_but_case(candidate, name) && (found.empty() || candidate < found)) found = candidate;
    entry.increment(failed);
  }
  return found;
}

/// The name for a message.
std::string shown_name(const std::string& name) { return utf8_name(name.substr(0, 200)); }

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
                                          const Location& where, std::string_view element,
                                          bool absolute_inside) const {
  constexpr std::size_t kLongestPath = 4096;
  if (reference.empty() || reference.size() > kLongestPath || reference.find('\0') != std::string::npos)
    throw input_error(where, element, "this is no file name", "give the path of a file");
  std::string name = reference;
  auto full = [&] { return (fs::path(base_folder) / name).lexically_normal(); };
  if (name.find('\\') != std::string::npos && !is_file(full()))
    std::replace(name.begin(), name.end(), '\\', '/');
  if (!allow_outside_ && !absolute_inside && fs::path(name).is_absolute())
    throw input_error(where, element, fmt::format("'{}' is an absolute path", reference),
                      "name it relative to the scene, or allow it with --allow-outside");
  // Resolved by the system: "link/../x" is next to the target of the link.
  fs::path canonical = canonical_or_same(fs::path(base_folder) / name);
  if (!allow_outside_ && !is_inside(canonical, root_) && !admitted_.contains(canonical.string()))
    throw input_error(where, element,
                      fmt::format("'{}' lies outside the scene's folder tree ({})", reference, root_),
                      "move it there, or allow it with --allow-outside");
  if (!asked_->contains(canonical.string()))
    asked_->emplace(canonical.string(), file_stamp(canonical.string()));
  if (!is_file(canonical)) return std::nullopt;
  // The lexically shortened path differs if it drops a ".." after a link; relative names start from this
  // path.
  fs::path shown = full();
  return FoundFile{(canonical_or_same(shown) == canonical ? shown : canonical).string(), canonical.string()};
}

std::optional<FoundFile> PathPolicy::find_exported(std::string reference, const std::string& base_folder,
                                                   const Location& where, std::string_view element,
                                                   WarningList& warnings) const {
  if (reference.size() > 1 && reference.front() == '"' && reference.back() == '"')
    reference = reference.substr(1, reference.size() - 2);
  if (reference.empty()) return std::nullopt;
  const bool absolute = fs::path(reference).is_absolute(), windows = is_windows_absolute(reference);
  if (!windows && (!absolute || allow_outside_ || is_inside(canonical_or_same(reference), root_)))
    if (auto found = find(reference, base_folder, where, element, true)) return found;
  std::string name = reference;
  if (name.find('\\') != name.npos) std::replace(name.begin(), name.end(), '\\', '/');
  name = fs::path(name).filename().string();
  if (name.empty() || name == "." || name == "..") return std::nullopt;
  auto found = find(name, base_folder, where, element);
  if (!found)
    if (const std::string other = name_in_other_case(base_folder, name); !other.empty())
      found = find(other, base_folder, where, element);
  if (found)
    warnings.add(where, fmt::format("{}: '{}' is not there: '{}' is taken", element, shown_name(reference),
                                    shown_name(found->shown)));
  return found;
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
