#pragma once
// The files that a scene may name. Scenes are untrusted input: they may refer to files in their folder's
// tree, not to the rest of the disk.

#include "io/files/file_stamp.h"
#include "io/files/warning_list.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace candela {

/// An existing file. `shown` is the path for messages; `canonical` is absolute and without symbolic links,
/// for opening, comparing and Mesh::source.
struct FoundFile {
  std::string shown;
  std::string canonical;
};

/// Absolute and without symbolic links, as far as the path exists.
std::string canonical_path(const std::string& path);

/// The folder part of a path, "." for a bare name.
std::string folder_of(const std::string& path);

/// The name of a regular file relative to a folder in whose tree it is, following links; nothing for other
/// files.
std::optional<std::string> path_below(const std::string& folder, const std::string& file);

class PathPolicy {
public:
  /// Files may be in `root_folder` and below it, or anywhere if allow_outside.
  PathPolicy(const std::string& root_folder, bool allow_outside);

  /// Allows this file wherever it is.
  void admit(const std::string& canonical) { admitted_.insert(canonical); }

  /// The regular file that `reference`, written in a file of `base_folder`, refers to; nothing if it does not
  /// exist. The check follows symbolic links. Throws input_error at `where` (of `element`) for an absolute
  /// path and for a file outside the root, existing or not, unless outside is allowed. If the name does not
  /// exist, backslashes count as slashes, for files written on Windows.
  std::optional<FoundFile> find(const std::string& reference, const std::string& base_folder,
                                const Location& where, std::string_view element) const {
    return find(reference, base_folder, where, element, false);
  }

  /// The same for files written by exporters, which may have names of another machine: in quotes, with
  /// absolute paths of any system, with missing folders, in another case. A file that is not found or not
  /// allowed at its path is searched in the folder of the file that names it, with a warning. Throws only for
  /// a relative name outside the root.
  std::optional<FoundFile> find_exported(std::string reference, const std::string& base_folder,
                                         const Location& where, std::string_view element,
                                         WarningList& warnings) const;

  /// The same as find, but a missing file is an input_error.
  FoundFile require(const std::string& reference, const std::string& base_folder, const Location& where,
                    std::string_view element) const;

  /// All allowed files that were looked up, existing or not, by canonical path, with their stamps at that
  /// time. Copies of a policy share them.
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
