#pragma once
// The scene formats. From this list come reading by a file's ending, what may be dropped on the window, and
// the texts that name the formats.

#include "io/files/path_policy.h"
#include "scene/document.h"

#include <span>
#include <string>
#include <string_view>

namespace candela {

struct SceneFormat {
  std::string_view ending; ///< of its files, in lower case, with the dot
  bool is_model = false;   ///< a part of scenes rather than one: a scene beside it is preferred
  /// Throws Error with a located message for what does not fit.
  Document (*read)(const FoundFile& file, const PathPolicy& policy, WarningList& warnings) = nullptr;
};

std::span<const SceneFormat> scene_formats();
/// The format of a path's ending, in either case; null where there is none.
const SceneFormat* scene_format(std::string_view path);
/// ".json, .obj": every ending, for messages.
std::string scene_endings(std::string_view separator);

/// Of jobs (io/ini_job.h), which name a scene of one of the formats.
inline constexpr std::string_view kJobEnding = ".ini";

} // namespace candela
