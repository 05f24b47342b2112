#pragma once
// The front door to all scene formats.

#include "io/candela/candela_json.h"
#include "io/files/warning_list.h"
#include "scene/document.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace candela {

struct ReadOptions {
  bool allow_outside = false; ///< whether a scene may name files outside of its folder's tree
  /// Receives the progress of reading, and can cancel it.
  std::shared_ptr<Progress> progress = std::make_shared<Progress>();
};

/// Pixels of the film.
struct PictureCrop {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PictureCrop&) const = default;
};

struct LoadedScene {
  Document document;
  std::vector<Warning> warnings;
  std::vector<std::string> output_files; ///< the outputs of an .ini job
  std::optional<PictureCrop> crop;       ///< the part of the film of a picture's state
  /// Every file that the scene depends on, including missing ones: its own, those that it names and those
  /// that they name (material libraries, textures, cube faces), with their stamps before they were read. To
  /// watch, pack or list a scene's files, use this list.
  FileStamps files;
};

/// Reads a scene by the ending of its name, in either case:
///
/// - .json: Candela's own format (io/candela/candela_json.h)
/// - .obj: the mesh alone, framed by the camera; if nothing in it shines, a constant light is added
/// - .xml: CS123 (io/cs123/cs123_reader.h)
/// - .png, .exr: a picture that Candela saved, with the scene in it (io/picture_state.h)
/// - .ini: a job of the path tracing assignment (io/ini_job.h), which names one of the others
///
/// Throws Error with exit code 3 (invalid file) or 4 (limit exceeded) and a message `file:line:col: element:
/// cause: remedy`.
LoadedScene read_scene(const std::string& path, const ReadOptions& options = {});

} // namespace candela
