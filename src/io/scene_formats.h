#pragma once
// The list of scene formats, used for reading by a file's ending, for files dropped on the window, and in
// messages.

#include "io/files/path_policy.h"
#include "scene/document.h"

#include <span>
#include <string>
#include <string_view>

namespace candela {

struct SceneFormat {
  std::string_view ending; ///< of its files, in lower case, with the dot
  bool is_model = false;   ///< a model rather than a scene: a scene dropped with it is preferred
  /// Throws Error with a located message for invalid files.
  Document (*read)(const FoundFile& file, const PathPolicy& policy, WarningList& warnings) = nullptr;
};

std::span<const SceneFormat> scene_formats();
/// The format of a path's ending, in either case; null if unknown.
const SceneFormat* scene_format(std::string_view path);
/// ".json, .obj": every ending, for messages.
std::string scene_endings(std::string_view separator);

/// The ending of jobs (io/ini_job.h), which refer to a scene of one of the formats.
inline constexpr std::string_view kJobEnding = ".ini";

} // namespace candela
