#pragma once
// Which files a scene may name. A scene is somebody else's input: it may refer to files beside and below it,
// not to the rest of the disk.

#include "io/files/file_stamp.h"
#include "io/files/warning_list.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace candela {

/// A file that exists. `shown` is the path as a person would write it, for messages; `canonical` is absolute
/// and without symbolic links, for opening, comparing and Mesh::source.
struct FoundFile {
  std::string shown;
  std::string canonical;
};

/// Absolute and without symbolic links; as far as that can be told, for what does not exist.
std::string canonical_path(const std::string& path);

/// The folder part of a path, "." for a bare name.
std::string folder_of(const std::string& path);

/// The name of a regular file relative to a folder in whose tree it lies, links followed; nothing for others.
std::optional<std::string> path_below(const std::string& folder, const std::string& file);

class PathPolicy {
public:
  /// Files may lie in `root_folder` and below it, or anywhere if allow_outside.
  PathPolicy(const std::string& root_folder, bool allow_outside);

  /// Lets this file be opened wherever it lies.
  void admit(const std::string& canonical) { admitted_.insert(canonical); }

  /// The regular file that `reference`, written in a file of `base_folder`, means; nothing if there is none.
  /// Symbolic links are followed before the place is judged. Throws input_error at `where` (of `element`) for
  /// an absolute path and for a file outside the root, whether it exists or not, unless outside is allowed.
  /// A backslash counts as a slash where the name as it is does not exist, for files written on Windows.
  std::optional<FoundFile> find(const std::string& reference, const std::string& base_folder,
                                const Location& where, std::string_view element) const {
    return find(reference, base_folder, where, element, false);
  }

  /// The same for files that exporters wrote, who name what they had on their own machine: in quotes, by
  /// absolute paths of any system, by folders that did not travel along, in another case. What is not where
  /// the name says, or may not be named there, is looked for beside the file that names it, with a warning.
  /// Throws for a relative name outside the root alone.
  std::optional<FoundFile> find_exported(std::string reference, const std::string& base_folder,
                                         const Location& where, std::string_view element,
                                         WarningList& warnings) const;

  /// The same as find, but a missing file is an input_error too.
  FoundFile require(const std::string& reference, const std::string& base_folder, const Location& where,
                    std::string_view element) const;

  /// All files that it was asked for and that may be named, whether they exist or not, by their canonical
  /// paths, as they were then. Copies of a policy share it.
  const FileStamps& asked() const { return *asked_; }

private:
  std::optional<FoundFile> find(const std::string& reference, const std::string& base_folder,
                                const Location& where, std::string_view element, bool absolute_inside) const;

  std::string root_; ///< canonical
  bool allow_outside_;
  std::set<std::string> admitted_;
  std::shared_ptr<FileStamps> asked_ = std::make_shared<FileStamps>();
};

} // namespace candela
