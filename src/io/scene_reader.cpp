#include "io/scene_reader.h"

#include "io/files/apart.h"
#include "io/files/text_file.h"
#include "io/ini_job.h"
#include "io/picture_state.h"
#include "io/scene_formats.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// Reads a scene, or that of a job.
void read_document(const FoundFile& file, const ReadOptions& options, const Location& where,
                   WarningList& warnings, LoadedScene& loaded) {
  const PathPolicy policy(folder_of(file.shown), options.allow_outside);
  const FileStamp stamp = file_stamp(file.canonical);
  const SceneFormat* format = scene_format(file.shown);
  if (format == nullptr)
    throw input_error(where, "scene",
                      fmt::format("no scene format is known by the ending '{}'", lower_ending(file.shown)),
                      fmt::format("give a {} or {} file, or a .png or .exr that Candela saved",
                                  scene_endings(", "), kJobEnding));
  loaded.document = format->read(file, policy, warnings);
  loaded.files = policy.asked();
  loaded.files[file.canonical] = stamp;
}

LoadedScene read_here(const std::string& path, const ReadOptions& options) {
  WarningList warnings(options.progress);
  warnings.check_stop();
  LoadedScene loaded;
  const FileStamp stamp = file_stamp(path);
  if (lower_ending(path) == kJobEnding) {
    IniJob job = read_ini_job(path, options.allow_outside, warnings);
    read_document(job.scene, options, {path}, warnings, loaded);
    loaded.document.settings = job.settings;
    if (!job.output.empty()) loaded.output_files.push_back(job.output);
  } else if (std::string ending = lower_ending(path); ending == ".png" || ending == ".exr") {
    loaded = read_picture_state(path, options, warnings);
  } else {
    // The scene itself may be anywhere, since the user has named it. Opening it reports errors.
    read_document({path, canonical_path(path)}, options, {path}, warnings, loaded);
  }
  loaded.files[canonical_path(path)] = stamp;
  const SceneDesc& scene = loaded.document.scene;
  if (!has_light(scene)) warnings.add({path}, "nothing in the scene emits light: the picture will be black");
  loaded.warnings = warnings.warnings();
  return loaded;
}

} // namespace

LoadedScene read_scene(const std::string& path, const ReadOptions& options) {
  options.progress->check();
  // Readers check for cancellation often, but disks may be slow, and freeing gigabytes takes time, too.
  return run_while([path, options] { return read_here(path, options); }, [&] { options.progress->check(); });
}

} // namespace candela
