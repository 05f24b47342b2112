#include "app/viewer/viewer.h"

#include "app/platform/data_file.h"
#include "app/ui/ui_style.h"
#include "core/error.h"
#include "io/builder/scene_builder.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h> // WantTextInputNextFrame

#include <chrono>

namespace candela {

namespace {

constexpr double kNoticeSeconds = 6;
constexpr int kFramesToSettle = 3;
std::unique_ptr<RenderSession> make_session(const ViewerOptions& options) {
  SessionOptions session;
  session.threads = options.threads;
  session.on_publish = options.wake;
  session.on_build = options.on_build;
  return std::make_unique<RenderSession>(std::move(session));
}

} // namespace

std::string scene_title(const ViewerState& state) {
  if (state.scene_path.empty()) return "Cornell box";
  return std::filesystem::path(state.scene_path).filename().string();
}

std::string denoised_text(const DenoisedImage& image) {
  return fmt::format("denoised ({} spp, {})", image.spp, denoiser_name());
}

Viewer::Viewer(const Gl& gl, ViewerOptions options)
    : gl_(gl), options_(std::move(options)), draw_(gl), viewport_(gl), other_viewport_(gl),
      difference_viewport_(gl), session_(make_session(options_)),
      compare_({options_.threads, options_.wake, options_.screenshot_folder}), watch_(options_.wake),
      reader_(options_.wake), writer_(options_.wake), inspector_(gl, options_.wake), lab_(options_.wake),
      texture_viewer_(gl, options_.wake), thumbnails_(gl, options_.thumbnails, options_.wake) {
  imgui_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(imgui_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr; // ImGui must write no file
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasMouseCursors;
  io.ConfigDragClickToInputText = true;
  map_keys();
  state_.scenes = bundled_scenes();
  state_.fit_film = options_.fit_film;
  preferences_ = written_preferences_ = options_.preferences;
  state_.panels_visible = preferences_.panels_visible;
  state_.overlays_visible = preferences_.overlays_visible;
  state_.speed_factor = preferences_.speed_factor;
  state_.recent = preferences_.recent;
  text_zoom_ = preferences_.text_zoom;
  ui_.set_open_sections(preferences_.open_sections);
  const Bounds3 bounds = scene_bounds(options_.document.scene);
  install_scene(std::move(options_.document), options_.scene_path, std::move(options_.warnings), bounds,
                std::move(options_.files));
  history_.reset(edit_state());
  if (!options_.scene_path.empty()) remember_recent(options_.scene_path);
}

Viewer::~Viewer() {
  reading_->cancel();
  write_preferences_if_changed();
  ImGui::DestroyContext(imgui_);
}

void Viewer::handle(Event event) {
  if (!input_since_) input_since_ = MeterClock::now();
  events_.push_back(std::move(event));
}

std::string Viewer::title() const {
  return fmt::format("{}{} - Candela", scene_title(state_), state_.modified ? "*" : "");
}

bool Viewer::frame(double now, bool may_wait) {
  began_ = MeterClock::now();
  ImGui::SetCurrentContext(imgui_);
  if (first_frame_ < 0) first_frame_ = now;
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = static_cast<float>(std::clamp(now - now_, 1e-4, 1.0));
  now_ = now;

  redraws_ = events_.empty() ? std::max(redraws_ - 1, 0) : kFramesToSettle;
  feed_events();
  reader_.run_completions();
  writer_.run_completions();
  learn_letters_of_frame();
  update_scale();
  state_.status = session_->status();
  if (state_.status.phase != SessionPhase::building || drawn_phase_ != SessionPhase::building)
    state_.building_since = now;
  drawn_phase_ = state_.status.phase;
  state_.may_stop_building = false;
  if (drawn_phase_ == SessionPhase::building)
    if (const auto shown = session_->built().document)
      state_.may_stop_building = history_.undos_to(shown->scene.instances).value_or(0) != 0;
  state_.now = now;
  state_.loading = reader_.pending();
  state_.loaded = reading_->share();
  if (now > notice_until_) state_.notice.clear();
  if (state_.status.phase == SessionPhase::failed && failed_generation_ != state_.status.submitted) {
    failed_generation_ = state_.status.submitted;
    state_.fail(ErrorCause::render, state_.status.error);
  }
  if (state_.status.phase != SessionPhase::failed) state_.settle(ErrorCause::render);
  const std::uint64_t restarts_handed_in = meter_.submissions();
  const std::shared_ptr<const DisplayImage> newest = session_->display();
  const bool new_picture = newest != viewport_.shown();
  viewport_.show(newest);
  state_.picture = viewport_.shown();
  describe_picture();
  update_compare();

  io.DisplaySize = ImVec2(static_cast<float>(framebuffer_.x), static_cast<float>(framebuffer_.y));
  ImGui::NewFrame();
  clip_overlays();
  ui_.begin_frame(state_.scale);
  run_shortcuts();
  inspector_.update(state_, *session_, picture_rect(),
                    io.WantCaptureMouse ? std::nullopt : std::optional(vec2(io.MousePos.x, io.MousePos.y)));
  state_.selection = checked_selection(state_.document.scene, state_.selection);
  state_.selection_middle = selection_box_.middle(state_.document.scene, state_.selection);
  thumbnails_.begin_frame(state_);
  draw_ui();
  thumbnails_.end_frame(state_, !user_waits());
  if (std::string refusal = ui_.take_refusal(); !refusal.empty()) notify(std::move(refusal));
  draw_overlay();
  typing_ = io.WantTextInput || imgui_->WantTextInputNextFrame > 0;
  if (typing_ || !single_keys_act(Key::w)) held_.clear(); // a question ends the flight
  use_mouse_on_picture();
  fly();
  serve_requests();
  fit_film();
  keep_history();
  if (state_.edited && state_.compare.active) compare_.follow(state_.compare, state_.document);
  submit();
  send_region();
  serve_compare_requests();
  ImGui::Render();

  const bool restarted = restarts_handed_in != meter_.submissions();
  owes_drawing_ = may_wait && !new_picture && puts_off_drawing(restarted);
  if (!owes_drawing_) drawn_at_ = now;
  if (!owes_drawing_ && framebuffer_.x > 0 && framebuffer_.y > 0) draw_window();
  state_.frame_ms =
      std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began_).count();
  if (events_.empty()) input_since_.reset();
  return !owes_drawing_;
}

void Viewer::fit_film() {
  if (!state_.fit_film) return;
  FilmSettings& film = state_.document.settings.film;
  const ivec2 size = glm::clamp(fitted_film(framebuffer_, state_.document.scene.camera.film_aspect()),
                                ivec2(1), ivec2(16384));
  if (film.width == size.x && film.height == size.y) return;
  film.width = size.x;
  film.height = size.y;
  state_.edited = true;
}

void Viewer::serve_requests() {
  serve_view_requests();
  if (state_.select_requested) select(*state_.select_requested);
  state_.select_requested.reset();
  if (state_.paused != shown_paused_) session_->pause(shown_paused_ = state_.paused);
  if (state_.step_requested) session_->step(), compare_.step(), state_.paused = shown_paused_ = true;
  state_.step_requested = false;
  if (state_.reset_view_requested) {
    state_.edited |= state_.document.scene.camera != state_.home.scene.camera;
    state_.document.scene.camera = state_.home.scene.camera;
    notify("The view is reset to the scene's");
  }
  serve_file_requests();
  state_.reset_view_requested = false;
}

void Viewer::serve_view_requests() {
  const Camera& camera = state_.document.scene.camera;
  if (camera_problem(camera).empty()) {
    if (state_.axis_view_requested) set_camera(axis_camera(camera, pivot(), *state_.axis_view_requested));
    if (state_.projection_requested) set_camera(other_projection(camera, pivot()));
    if (state_.frame_requested) frame_selection();
  }
  state_.axis_view_requested.reset();
  state_.projection_requested = state_.frame_requested = false;
}

EditState Viewer::edit_state() const { return {state_.document, state_.fit_film, scene_}; }

void Viewer::submit() {
  if (!state_.edited) return;
  const std::uint64_t generation = session_->submit(state_.document);
  if (std::exchange(scene_is_new_, false)) scene_generation_ = generation;
  if (session_->status().restarting == generation)
    meter_.submitted(generation, input_since_.value_or(began_));
  state_.edited = false;
}

void Viewer::keep_history() {
  const bool in_gesture =
      gesture_ != Gesture::none || fly_command().any() || now_ < wheel_until_ || ImGui::IsAnyItemActive();
  const bool steps = state_.undo_requested || state_.redo_requested;
  if (state_.edited || history_.pending())
    history_.observe(edit_state(), state_.edited, in_gesture && !steps);
  if (state_.undo_requested && history_.can_undo()) {
    notify(fmt::format("Undone: {}", history_.undo_name()));
    show_state(history_.undo());
  } else if (state_.redo_requested && history_.can_redo()) {
    notify(fmt::format("Redone: {}", history_.redo_name()));
    show_state(history_.redo());
  } else if (steps) {
    notify(state_.undo_requested ? "There is nothing to undo" : "There is nothing to redo");
  }
  if (steps) fit_film(); // the window's size may have changed
  state_.undo_requested = state_.redo_requested = false;
  if (!in_gesture && (state_.edited || state_.undo_name != history_.undo_name())) update_modified();
  state_.undo_name = history_.undo_name();
  state_.redo_name = history_.redo_name();
}

/// Labels a picture that is not of the current document: that of the previous scene until the first picture
/// of the new one, or that of before an edit that takes long or failed.
void Viewer::describe_picture() {
  constexpr double kQuietSeconds = 0.5; // shorter delays are not reported
  state_.picture_of.clear();
  if (!state_.picture) return;
  const std::uint64_t generation = state_.picture->frame->generation;
  const bool of_this_scene = !scene_is_new_ && generation >= scene_generation_;
  if (of_this_scene) shown_title_ = scene_title(state_);
  const bool behind = !of_this_scene || generation < state_.status.restarting;
  if (!behind || generation != shown_generation_) behind_since_ = now_; // also while pictures follow a drag
  shown_generation_ = generation;
  const bool failed = state_.status.phase == SessionPhase::failed;
  if (!behind || (!failed && now_ - behind_since_ < kQuietSeconds)) return;
  state_.picture_of = !of_this_scene ? fmt::format("still the picture of {}", shown_title_)
                                     : "still the picture from before the edit";
}

void Viewer::notify(std::string text) {
  state_.notice = std::move(text);
  notice_until_ = now_ + kNoticeSeconds;
  redraws_ = kFramesToSettle;
}

} // namespace candela
