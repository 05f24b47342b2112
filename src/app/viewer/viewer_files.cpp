// Opening scenes in the background. Watching their files is in viewer_watching.cpp, saving in
// viewer_saving.cpp.

#include "app/panels/texture_picker.h"
#include "app/ui/item_list.h"
#include "app/ui/typed_number.h"
#include "app/viewer/dropped_files.h"
#include "app/viewer/picture_saver.h"
#include "app/viewer/viewer.h"
#include "core/error.h"
#include "io/builder/scene_builder.h"
#include "io/files/path_policy.h"
#include "io/files/text_file.h"
#include "io/ies/ies_reader.h"
#include "io/images/image_file.h"
#include "io/images/panorama_reader.h"
#include "io/images/texels_reader.h"
#include "io/picture_state.h"
#include "io/volumes/volume_reader.h"
#include "scene/media_edits.h"
#include "scene/scene_files.h"

#include <fmt/format.h>
#include <imgui.h>

#include <set>
#include <utility>

namespace candela {

namespace fs = std::filesystem;

namespace {

std::string opened_text(const char* verb, const std::string& path, std::size_t warnings) {
  if (warnings == 0) return fmt::format("{} {}", verb, path);
  return fmt::format("{} {} with {}: see Scenes", verb, path,
                     counted(static_cast<long long>(warnings), "warning"));
}

std::string with_remark(const std::string& text, const std::string& remark) {
  return remark.empty() ? text : fmt::format("{}; {}", text, remark);
}

/// The panorama at the path, unless it is not a picture or holds a scene.
std::shared_ptr<const Panorama> panorama_without_scene(const std::string& path,
                                                       std::shared_ptr<Progress> progress) {
  if (!is_image_name(path)) return nullptr;
  if (const std::string ending = lower_ending(path);
      (ending == ".png" || ending == ".exr") && holds_picture_state(path))
    return nullptr;
  WarningList corrections(std::move(progress)); // of invalid values, which the user cannot correct
  return read_panorama(std::span(&path, 1), corrections);
}

} // namespace

void Viewer::light_with(std::shared_ptr<const Panorama> panorama, const FileStamps& files) {
  const auto selected = static_cast<std::size_t>(std::max(state_.selected_light, 0));
  state_.selected_light =
      static_cast<int>(set_environment(state_.document.scene, std::move(panorama), selected));
  state_.edited = true;
  watch_files(files);
}

void Viewer::shape_light_with(std::shared_ptr<const IesProfile> profile, const FileStamps& files) {
  auto& lights = state_.document.scene.lights;
  auto index = static_cast<std::size_t>(std::max(state_.selected_light, 0));
  if (index >= lights.size() || !takes_profile(lights[index]))
    index = static_cast<std::size_t>(std::ranges::find_if(lights, takes_profile) - lights.begin());
  if (index >= lights.size()) {
    state_.fail(
        ErrorCause::open,
        fmt::format("{}: there is no light that it could shape: add a point or spot light", profile->name));
    return;
  }
  notify(fmt::format("{} shapes {}: see Lights", profile->name,
                     name_or_number(lights[index].name, "Light", index)));
  if (takes_panorama(lights[index])) set_panorama(lights[index], nullptr);
  set_profile(lights[index], std::move(profile));
  state_.selected_light = static_cast<int>(index);
  state_.edited = true;
  watch_files(files);
}

void Viewer::fill_with(std::shared_ptr<const VolumeGrid> grid, const FileStamps& files) {
  SceneDesc& scene = state_.document.scene;
  const std::string name = fs::path(grid->source).filename().string();
  const auto selected = static_cast<std::size_t>(std::max(state_.selected_medium, 0));
  if (selected < scene.media.size() && takes_grid(scene.media[selected]))
    set_medium_grid(scene.media[selected], std::move(grid));
  else
    state_.selected_medium = static_cast<int>(add_grid_medium(scene, std::move(grid), state_.bounds));
  notify(fmt::format("{} fills {}: see Media", name,
                     scene.media[static_cast<std::size_t>(state_.selected_medium)].name));
  state_.edited = true;
  watch_files(files);
}

void Viewer::take_dropped(const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const std::string key = parameter_at(ui_.widgets(), vec2(mouse.x, mouse.y));
  if (!key.empty() && paths.size() == 1 && is_image_name(paths.front()))
    read_texture(paths.front(), {static_cast<std::size_t>(state_.selected_material), key});
  else
    state_.open_paths = paths;
}

void Viewer::read_texture(const std::string& path, const TextureTarget& target) {
  state_.settle(ErrorCause::open);
  reader_.post([this, path, target]() -> TaskThread::Completion {
    try {
      const FileStamps stamps{{path, file_stamp(path)}};
      WarningList corrections; // ignored, as for a panorama
      auto texture = std::make_shared<const Texture>(
          Texture{fs::path(path).filename().string(), ImageTexture{path, read_texels(path, corrections)}});
      return [this, path, target, texture, stamps] {
        set_parameter_texture(state_.document.scene, target, texture);
        state_.edited = true;
        watch_files(stamps);
        notify(fmt::format("{} is the texture of {}", path, target.key));
      };
    } catch (const std::exception& error) {
      return [this, problem = std::string(error.what())] { state_.fail(ErrorCause::open, problem); };
    }
  });
}

void Viewer::open_scene(const std::vector<std::string>& paths, bool reload) {
  reading_->cancel(); // the newest request replaces it
  reading_ = std::make_shared<Progress>();
  state_.loading_path = paths.front();
  state_.loading_since = now_;
  state_.settle(ErrorCause::open);
  const bool is_part = is_image_name(paths.front()) || lower_ending(paths.front()) == ".ies" ||
                       is_volume_name(paths.front()); // shown in the light, or the medium
  if (!reload && !typing_ && !is_part) state_.path_input = paths.front();
  const std::uint64_t request = ++open_requests_;
  state_.reading = true;
  ReadOptions options = options_.reading;
  options.progress = reading_;
  reader_.post([this, paths, request, reload, options]() -> TaskThread::Completion {
    std::string problem;
    try {
      const Dropped chosen = choose_dropped(paths);
      const std::string& path = chosen.open;
      const FileStamps stamps{{path, file_stamp(path)}};
      if (path.empty()) {
        problem = chosen.remark;
      } else if (lower_ending(path) == ".ies") {
        WarningList corrections(options.progress); // ignored, as for a panorama
        return [this, request, profile = read_ies(path, corrections), stamps] {
          if (request != open_requests_) return;
          state_.reading = false;
          shape_light_with(profile, stamps);
        };
      } else if (is_volume_name(path)) {
        WarningList corrections(options.progress); // ignored, as for a panorama
        return [this, request, grid = read_volume(path, corrections), stamps] {
          if (request != open_requests_) return;
          state_.reading = false;
          fill_with(grid, stamps);
        };
      } else if (auto panorama = panorama_without_scene(path, options.progress)) {
        return [this, chosen, request, panorama, stamps] {
          if (request != open_requests_) return;
          state_.reading = false;
          light_with(panorama, stamps);
          notify(with_remark(fmt::format("{} lights the scene: see Lights", chosen.open), chosen.remark));
        };
      } else {
        LoadedScene loaded = read_scene(path, options);
        problem = camera_problem(loaded.document.scene.camera);
        if (problem.empty()) {
          const Bounds3 bounds = scene_bounds(loaded.document.scene);
          return [this, chosen, request, reload, bounds,
                  scene = std::make_shared<LoadedScene>(std::move(loaded))] {
            if (request == open_requests_) finish_opening(chosen, *scene, bounds, reload);
          };
        }
        problem = fmt::format("{}: {}", path, problem);
      }
    } catch (const std::bad_alloc&) {
      problem = fmt::format("{}: there is not enough memory for it: close other programs", paths.front());
    } catch (const std::exception& error) { // an Error, or what a library throws: shown either way
      problem = error.what();
    }
    return [this, problem, request] {
      if (request != open_requests_) return; // cancelled or replaced by a newer request
      state_.reading = false;
      state_.fail(ErrorCause::open, problem);
    };
  });
}

void Viewer::finish_opening(const Dropped& chosen, LoadedScene& loaded, const Bounds3& bounds, bool reload) {
  const std::string& path = chosen.open;
  state_.reading = false;
  std::vector<std::string> warnings;
  for (const Warning& warning : loaded.warnings) warnings.push_back(warning.text);
  const Selection selection = state_.selection;
  const int material = state_.selected_material, light = state_.selected_light;
  Camera seen = state_.document.scene.camera;
  install_scene(std::move(loaded.document), path, std::move(warnings), bounds, std::move(loaded.files));
  if (reload) { // a reload keeps the view and the selection
    state_.document.scene.camera = seen;
    state_.selection = checked_selection(state_.document.scene, selection);
    state_.selected_material = material;
    state_.selected_light = light;
  } else {
    if (!typing_) state_.path_input = path;
    remember_recent(path);
  }
  notify(
      with_remark(opened_text(reload ? "Reloaded" : "Opened", path, state_.warnings.size()), chosen.remark));
}

void Viewer::install_scene(Document document, std::string path, std::vector<std::string> warnings,
                           const Bounds3& bounds, FileStamps files) {
  if (path != state_.scene_path) state_.texture_view.visible = false; // else it shows the changed file
  auto scene = std::make_shared<OpenScene>(
      OpenScene{std::move(path), document, document, bounds, std::move(warnings), std::move(files)});
  const FileStamps read = scene->files;
  show_state({std::move(document), state_.fit_film, std::move(scene)}, read);
  state_.selected_material = state_.selected_texture = state_.selected_light = 0;
  state_.selection = {};
  state_.error.clear();
  state_.question = Question::none;
}

void Viewer::show_state(const EditState& edit, const FileStamps& read) {
  state_.document = edit.document;
  state_.fit_film = edit.fit_film;
  const bool is_other = std::exchange(scene_, edit.scene) != edit.scene;
  if (is_other) {
    watch_files(read);
    scene_is_new_ = true;
  }
  state_.home = scene_->home;
  state_.scene_path = scene_->path;
  state_.warnings = scene_->warnings;
  state_.bounds = scene_->bounds;
  state_.natural_speed = natural_speed(scene_->bounds, scene_->home.scene.camera);
  if (is_other) learn_letters_of_scene();
  state_.edited = true;
}

/// Cancels reading; the current scene stays.
void Viewer::cancel_opening() {
  if (!state_.reading) return;
  reading_->cancel();
  ++open_requests_;
  state_.reading = false;
  notify(fmt::format("Cancelled opening {}", state_.loading_path));
}

/// Undoes the edits whose geometry is being built; they can be redone.
void Viewer::cancel_building() {
  const RenderSession::Built shown = session_->built();
  if (state_.status.phase != SessionPhase::building || !shown.document) return;
  history_.observe(edit_state(), state_.edited, false); // records unfinished edits, too
  const auto undos = history_.undos_to(shown.document->scene.instances);
  if (undos.value_or(0) == 0) return;
  show_state(history_.undo_by(*undos));
  notify("Cancelled building: redo starts it again");
}

void Viewer::serve_file_requests() {
  if (state_.save_requested && state_.picture) { // before the first picture the request is kept
    save_shown_picture();
    state_.save_requested = false;
  }
  if (state_.cancel_requested) state_.reading ? cancel_opening() : cancel_building();
  if (!state_.open_paths.empty()) open_scene(std::exchange(state_.open_paths, {}), false);
  if (state_.reload_requested) open_scene({scene_->path}, true);
  if (state_.save_scene_requested) save_scene();
  if (state_.save_to) save_scene_to(*state_.save_to);
  if (state_.close_requested) {
    // Asked once: a second request quits.
    if (!state_.modified || state_.question == Question::quit)
      wants_close_ = true;
    else
      state_.question = Question::quit;
  }
  if (state_.save_and_quit_requested) {
    state_.quit_after_save = true;
    state_.question = Question::none; // the question is answered
    save_scene();
  }
  state_.save_to.reset();
  state_.cancel_requested = state_.reload_requested = state_.save_scene_requested = state_.close_requested =
      state_.save_and_quit_requested = false;
  look_for_changes();
}

void Viewer::update_modified() {
  state_.modified = differs_from_file(state_.document, scene_->saved, state_.fit_film);
}

void Viewer::remember_recent(const std::string& path) {
  add_recent(preferences_, path);
  state_.recent = preferences_.recent;
  write_preferences_if_changed();
}

void Viewer::write_preferences_if_changed() {
  if (options_.preferences_path.empty()) return;
  preferences_.panels_visible = state_.panels_visible;
  preferences_.overlays_visible = state_.overlays_visible;
  preferences_.text_zoom = text_zoom_;
  preferences_.speed_factor = state_.speed_factor;
  preferences_.open_sections = ui_.open_sections();
  if (const ivec2 size = size_at_scale_one(framebuffer_, content_scale_); std::min(size.x, size.y) >= 64)
    preferences_.window = size;
  if (preferences_ == written_preferences_) return;
  written_preferences_ = preferences_;
  writer_.post([this, preferences = preferences_,
                path = options_.preferences_path]() -> TaskThread::Completion {
    try {
      write_preferences(preferences, path);
      return [this] { state_.settle(ErrorCause::preferences); };
    } catch (const std::exception& error) {
      return [this, problem = std::string(error.what())] { state_.fail(ErrorCause::preferences, problem); };
    }
  });
}

void Viewer::finish_writing() {
  write_preferences_if_changed();
  writer_.finish();
}

} // namespace candela
