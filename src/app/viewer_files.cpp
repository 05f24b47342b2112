// Scenes in, pictures out: all of it beside the UI thread.

#include "app/picture_saver.h"
#include "app/viewer.h"
#include "core/error.h"
#include "io/image_file.h"
#include "io/panorama_reader.h"
#include "io/scene_builder.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// The picture at the path, unless it is none or holds a scene.
std::shared_ptr<const Panorama> panorama_without_scene(const std::string& path, const ReadOptions& reading) {
  if (!is_image_name(path)) return nullptr;
  try {
    read_scene(path, reading);
    return nullptr;
  } catch (const Error&) {
    WarningList corrections; // of values that no light has: nothing that the user could mend
    return read_panorama(std::span(&path, 1), corrections);
  }
}

} // namespace

void Viewer::light_with(std::shared_ptr<const Panorama> panorama) {
  const auto selected = static_cast<std::size_t>(std::max(state_.selected_light, 0));
  state_.selected_light =
      static_cast<int>(set_environment(state_.document.scene, std::move(panorama), selected));
  state_.edited = true;
}

void Viewer::open_scene(const std::string& path) {
  state_.loading_path = path;
  if (!is_image_name(path)) state_.path_input = path; // a panorama's name stands in its light
  const std::uint64_t request = ++open_requests_;
  reader_.post([this, path, request, reading = options_.reading]() -> TaskThread::Completion {
    std::string problem;
    try {
      if (auto panorama = panorama_without_scene(path, reading))
        return [this, path, request, panorama] {
          if (request != open_requests_) return;
          light_with(panorama);
          notify(fmt::format("{} lights the scene: see Lights", path));
        };
      LoadedScene loaded = read_scene(path, reading);
      problem = camera_problem(loaded.document.scene.camera);
      if (problem.empty()) {
        const Bounds3 bounds = scene_bounds(loaded.document.scene);
        return [this, path, request, bounds, scene = std::make_shared<LoadedScene>(std::move(loaded))] {
          if (request != open_requests_) return; // another was asked for meanwhile
          std::vector<std::string> warnings;
          for (const Warning& warning : scene->warnings) warnings.push_back(warning.text);
          install_scene(std::move(scene->document), path, std::move(warnings), bounds);
          const std::size_t count = state_.warnings.size();
          notify(count == 0 ? fmt::format("Opened {}", path)
                            : fmt::format("Opened {} with {} warning{}: see Scenes", path, count,
                                          count == 1 ? "" : "s"));
        };
      }
      problem = fmt::format("{}: {}", path, problem);
    } catch (const std::bad_alloc&) {
      problem = fmt::format("{}: there is not enough memory for it: close other programs", path);
    } catch (const std::exception& error) { // an Error, or what a library throws: shown either way
      problem = error.what();
    }
    return [this, problem] { state_.error = problem; };
  });
}

void Viewer::install_scene(Document document, std::string path, std::vector<std::string> warnings,
                           const Bounds3& bounds) {
  scene_ = std::make_shared<OpenScene>(
      OpenScene{std::move(path), document, document, bounds, std::move(warnings)});
  show_state({std::move(document), state_.fit_film, scene_});
  state_.selected_material = state_.selected_light = 0;
  state_.error.clear();
}

void Viewer::save_shown_picture() {
  writer_.post(
      [this, image = state_.picture, folder = options_.screenshot_folder]() -> TaskThread::Completion {
        try {
          const SavedPicture saved = save_picture(*image, folder, "candela");
          return [this, saved] {
            notify(fmt::format("Saved {} and {}", saved.png.lexically_normal().string(),
                               saved.exr.filename().string()));
          };
        } catch (const std::exception& error) {
          return [this, problem = std::string(error.what())] { state_.error = problem; };
        }
      });
}

} // namespace candela
