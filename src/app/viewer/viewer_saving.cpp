// Saving scenes and pictures in the background.

#include "app/viewer/picture_saver.h"
#include "app/viewer/viewer.h"
#include "core/error.h"
#include "io/files/text_file.h"
#include "io/scene_export.h"
#include "scene/scene_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace candela {

namespace fs = std::filesystem;

namespace {

/// Frames until a new field has the keyboard focus, at most.
constexpr int kFramesToFocus = 6;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code failed;
  return a == b || fs::equivalent(a, b, failed);
}

} // namespace

bool Viewer::is_bundled(const std::string& path) const {
  return std::ranges::any_of(state_.scenes,
                             [&](const fs::path& scene) { return same_file(scene.string(), path); });
}

/// Saves to the scene's file if it is a writable .json file; otherwise asks for a path.
void Viewer::save_scene() {
  const std::string& path = scene_->path;
  const bool elsewhere = std::exchange(state_.save_as_requested, false);
  if (!elsewhere && !path.empty() && fs::path(path).extension() == ".json" && !is_bundled(path)) {
    save_scene_to(path);
    return;
  }
  const std::string stem = path.empty() ? "scene" : fs::path(path).stem().string();
  // Suggests the folder of the source, so that meshes are named relative to it; for examples, the working
  // folder.
  const fs::path folder = path.empty() || is_bundled(path) ? fs::path() : fs::path(path).parent_path();
  state_.save_path = (folder / (stem + ".json")).string();
  ask_for_path();
}

void Viewer::ask_for_path() {
  state_.save_as_visible = state_.save_field_wanted = true;
  field_awaited_ = kFramesToFocus;
}

void Viewer::save_scene_to(std::string path) {
  std::error_code failed;
  if (const auto absolute = path.rfind("//"); absolute != std::string::npos)
    path.erase(0, absolute + 1); // an absolute path was typed after the suggested folder
  if (!fs::path(path).has_extension() && fs::path(path).has_filename()) path += ".json"; // what else
  if (fs::path(path).extension() != ".json") {
    state_.fail(ErrorCause::save,
                fmt::format("{}: scenes are saved as .json: give the name that ending", path));
    return;
  }
  const bool own = same_file(path, scene_->path);
  if (!own && fs::exists(path, failed) && state_.replace_path != path) {
    state_.replace_path = path; // asked once
    state_.question = Question::replace;
    return;
  }
  state_.replace_path.clear();
  state_.question = Question::none;
  const bool was_asked = std::exchange(state_.save_as_visible, false);
  Document document = state_.document;
  if (state_.fit_film) { // the window's size is not saved
    document.settings.film.width = state_.home.settings.film.width;
    document.settings.film.height = state_.home.settings.film.height;
  }
  writer_.post(
      [this, path, was_asked, document = std::move(document), scene = scene_]() -> TaskThread::Completion {
        try {
          FileStamps written;
          for (const ExportedFile& copied : export_candela_json(document, path)) // pictures from elsewhere
            written.emplace(canonical_path(copied.to), file_stamp(copied.to));
          for (const std::string& file : {path, canonical_path(path)})
            written.emplace(file, file_stamp(file));
          return [this, path, document, scene, written] {
            scene->files.erase(canonical_path(scene->path));
            scene->path = path;
            scene->saved = document;
            for (const std::string& file : source_files(document.scene)) scene->files.try_emplace(file);
            for (const auto& [file, stamp] : written) scene->files[file] = stamp;
            if (scene == scene_) state_.scene_path = path, watch_files(written);
            remember_recent(path);
            update_modified();
            notify(fmt::format("Saved {}", path));
            state_.settle(ErrorCause::save);
            if (state_.quit_after_save) wants_close_ = true;
          };
        } catch (const std::exception& error) {
          return [this, was_asked, problem = std::string(error.what())] {
            state_.fail(ErrorCause::save, problem);
            state_.quit_after_save = false;
            if (was_asked) ask_for_path(); // for another path
          };
        }
      });
}

void Viewer::save_shown_picture() {
  writer_.post(
      [this, image = state_.picture, folder = options_.screenshot_folder]() -> TaskThread::Completion {
        try {
          const SavedPicture saved = save_picture(*image, folder, "candela");
          return [this, saved] {
            state_.settle(ErrorCause::picture);
            notify(fmt::format("Saved {} and {}", saved.png.lexically_normal().string(),
                               saved.exr.filename().string()));
          };
        } catch (const std::exception& error) {
          return [this, problem = std::string(error.what())] { state_.fail(ErrorCause::picture, problem); };
        }
      });
}

} // namespace candela
