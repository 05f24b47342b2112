#include "app/viewer.h"

#include "app/data_file.h"
#include "app/ui_style.h"
#include "core/error.h"
#include "io/scene_builder.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h> // WantTextInputNextFrame

#include <chrono>

namespace candela {

namespace {

constexpr float kColumnWidth = 352; // at scale 1, like all lengths here
constexpr float kStatusHeight = 24;
constexpr float kToolHeight = 66;
/// Windows smaller than this show the picture alone: no panel would be readable in them.
constexpr float kMinPanelWindowWidth = 420, kMinPanelWindowHeight = 160;
/// A window on a dense monitor may be small all the same: the panels then take no more than they would of a
/// window of this size.
constexpr float kScaleReferenceWidth = 960, kScaleReferenceHeight = 540;
constexpr double kHintSeconds = 10;
constexpr double kNoticeSeconds = 6;
constexpr int kFramesToSettle = 3;
// Without a GPU every drawn frame is taken from the renderer; 30 a second look smooth, input may have 60.
constexpr double kPictureInterval = 1 / 30.0;
constexpr double kInputInterval = 1 / 60.0;
constexpr double kHandInterval = 1 / 240.0;
/// A picture that a hand waits for is drawn as soon as it is there; this much leaves the renderer time for the
/// next one. A flight's picture came after 25 ms with kInputInterval, of which it waited 6 for that.
constexpr double kAwaitedInterval = 1 / 100.0;
/// While a picture is awaited, drawing the old one would only delay it.
constexpr double kWaitingInterval = 1 / 15.0;
/// Of the wall time, to draw a picture that only becomes less noisy.
constexpr double kWindowShare = 0.06;
constexpr double kSlowestRefining = 0.2;
constexpr double kBusyRedrawSeconds = 0.25; // running numbers, blinking text cursors
constexpr double kIdleRedrawSeconds = 5;

bool is_busy(SessionPhase phase) {
  return phase == SessionPhase::building || phase == SessionPhase::rendering;
}

std::unique_ptr<RenderSession> make_session(const ViewerOptions& options) {
  SessionOptions session;
  session.threads = options.threads;
  session.on_publish = options.wake;
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
      reader_(options_.wake), writer_(options_.wake), inspector_(gl, options_.wake), lab_(options_.wake) {
  imgui_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(imgui_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr; // leaves no files behind
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
  install_scene(std::move(options_.document), options_.scene_path, std::move(options_.warnings), bounds);
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
    state_.error = state_.status.error;
  }
  const std::uint64_t restarts_handed_in = meter_.submissions();
  const std::shared_ptr<const DisplayImage> newest = session_->display();
  const bool new_picture = newest != viewport_.shown();
  viewport_.show(newest);
  state_.picture = viewport_.shown();
  update_compare();

  io.DisplaySize = ImVec2(static_cast<float>(framebuffer_.x), static_cast<float>(framebuffer_.y));
  ImGui::NewFrame();
  ui_.begin_frame(state_.scale);
  run_shortcuts();
  inspector_.update(state_, *session_, picture_rect(),
                    io.WantCaptureMouse ? std::nullopt : std::optional(vec2(io.MousePos.x, io.MousePos.y)));
  state_.selection = checked_selection(state_.document.scene, state_.selection);
  draw_ui();
  draw_overlay();
  typing_ = io.WantTextInput || imgui_->WantTextInputNextFrame > 0;
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

  // The picture of an input is only moments away, and drawing would take the cores from it.
  const bool restarted = restarts_handed_in != meter_.submissions();
  if (!owes_drawing_) owed_since_ = now;
  owes_drawing_ =
      may_wait && !new_picture && (restarted || owes_drawing_) && now < owed_since_ + kWaitingInterval;
  if (!owes_drawing_) drawn_at_ = now;
  if (!owes_drawing_ && framebuffer_.x > 0 && framebuffer_.y > 0) {
    gl_.Viewport(0, 0, framebuffer_.x, framebuffer_.y);
    gl_.ClearColor(kBackgroundGrey, kBackgroundGrey, kBackgroundGrey, 1);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    if (state_.compare.active)
      draw_comparison();
    else
      viewport_.draw(picture_rect(), framebuffer_);
    draw_.draw(*ImGui::GetDrawData());
  }
  state_.frame_ms =
      std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began_).count();
  if (events_.empty()) input_since_.reset();
  return !owes_drawing_;
}

void Viewer::shown(WindowFrame frame) {
  frame.rendering = state_.status.phase == SessionPhase::rendering;
  meter_.add(frame);
  frame_seconds_ += 0.2 * (frame.seconds - frame_seconds_);
  session_->publish_every(refining_interval());
  read_meter();
  if (state_.compare.active || state_.status.phase == SessionPhase::failed)
    meter_.give_up();
  else if (state_.picture)
    meter_.shown(*state_.picture->frame, MeterClock::now());
}

bool Viewer::wants_redraw() const {
  return !events_.empty() || redraws_ > 0 || owes_drawing_ || fly_command().any() ||
         reader_.has_completions() || writer_.has_completions() || watch_.has_change() ||
         inspector_.wants_redraw() || lab_.has_news() || session_->display() != viewport_.shown() ||
         session_->status().phase != drawn_phase_ || comparison_wants_redraw();
}

/// Once in a while: sorting costs, and numbers that flicker cannot be read.
void Viewer::read_meter() {
  constexpr double kEvery = 1;
  const double seconds = now_ - meter_read_;
  if (seconds < kEvery) return;
  meter_read_ = now_;
  const double cpu = session_->cpu_time().render, spent = cpu - std::exchange(meter_cpu_, cpu);
  const double share = state_.meter.render_share;
  state_.meter = meter_.readings();
  const bool refines = state_.status.phase == SessionPhase::rendering && seconds < 2 * kEvery;
  state_.meter.render_share = refines ? spent / (seconds * session_->threads()) : share;
}

bool Viewer::awaited_picture_is_there() const {
  if (!meter_.waiting()) return false;
  const auto newest = session_->display();
  return newest && newest->frame->generation >= meter_.awaited();
}

double Viewer::next_frame() const {
  if (!wants_redraw()) return now_ + idle_seconds();
  double due = now_ + refining_interval();
  if (awaited_picture_is_there()) due = drawn_at_ + kAwaitedInterval; // perhaps at once
  if (has_pending_events() || fly_command().any()) {
    // While the hand moves the camera a frame without a new picture only hands in, and costs next to nothing.
    const bool only_hands_in = gesture_ != Gesture::none && !awaited_picture_is_there();
    due = std::min(due, now_ + (only_hands_in ? kHandInterval : kInputInterval));
  }
  const bool coarse = state_.picture && state_.picture->frame->spp < 1;
  if (owes_drawing_)
    due = std::min(due, owed_since_ + kWaitingInterval);
  else if (coarse || redraws_ > 0 || meter_.waiting())
    due = std::min(due, drawn_at_ + (meter_.waiting() ? kWaitingInterval : kPictureInterval));
  return due;
}

double Viewer::refining_interval() const {
  return std::clamp(frame_seconds_ / kWindowShare, kPictureInterval, kSlowestRefining);
}

double Viewer::idle_seconds() const {
  if (fly_command().any()) return 0;
  if (typing_ && std::ranges::any_of(ImGui::GetIO().KeysDown, std::identity())) return 0; // keys repeat
  if (is_busy(drawn_phase_) || compare_.busy() || typing_ || state_.loading > 0 || history_.pending())
    return kBusyRedrawSeconds;
  double idle = kIdleRedrawSeconds;
  if (state_.inspect.focus_mark)
    idle = std::min(idle, std::max(state_.inspect.focus_mark->until - now_, 0.0) + 0.01);
  if (!state_.notice.empty()) idle = std::min(idle, std::max(notice_until_ - now_, 0.0) + 0.01);
  const double hint_end = first_frame_ + kHintSeconds;
  if (now_ < hint_end) idle = std::min(idle, hint_end - now_ + 0.01);
  return idle;
}

void Viewer::update_scale() {
  const float room = std::min(static_cast<float>(framebuffer_.x) / kScaleReferenceWidth,
                              static_cast<float>(framebuffer_.y) / kScaleReferenceHeight);
  const float wanted = std::min(content_scale_, std::max(room, 1.0f)) * text_zoom_;
  const float scale = std::clamp(std::round(wanted * 8) / 8, 0.5f, 4.0f); // few steps: each builds an atlas
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (scale == state_.scale && atlas.IsBuilt()) return;
  state_.scale = scale;
  atlas.Clear();
  load_fonts(atlas, scale);
  draw_.upload_fonts(atlas);
  apply_style(scale);
}

bool Viewer::shows_panels() const {
  return state_.panels_visible && static_cast<float>(framebuffer_.x) >= kMinPanelWindowWidth * state_.scale &&
         static_cast<float>(framebuffer_.y) >= kMinPanelWindowHeight * state_.scale;
}

PixelRect Viewer::free_region() const {
  PixelRect region{0, 0, framebuffer_.x, framebuffer_.y};
  if (shows_panels()) {
    region.width -= static_cast<int>(std::round(kColumnWidth * state_.scale));
    region.height -= static_cast<int>(std::round(kStatusHeight * state_.scale));
  }
  return region;
}

PixelRect Viewer::picture_rect() const {
  if (!state_.compare.active) return single_picture_rect();
  const ComparePanes panes = compare_panes();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return panes.sides[static_cast<std::size_t>(panes.side_at({mouse.x, mouse.y}))].picture;
}

PixelRect Viewer::single_picture_rect() const {
  const ivec2 film = state_.picture ? ivec2(state_.picture->width, state_.picture->height)
                                    : glm::max(framebuffer_, ivec2(1));
  if (!state_.fit_film)
    return letterbox(free_region(), view_shape(film, state_.document.scene.camera.aspect));
  // The film has the window's size, so that no panel's coming and going restarts it; its middle is kept in
  // the middle of what the panels leave free. While the window is being resized the old picture fills in.
  return letterbox(centered(free_region(), glm::max(framebuffer_, ivec2(1))), film);
}

void Viewer::draw_ui() {
  const PixelRect free = free_region();
  const vec2 free_size(free.width, free.height);
  const vec2 window(framebuffer_);
  if (shows_panels()) {
    const float tools = std::round(kToolHeight * state_.scale), width = window.x - free_size.x;
    tool_bar(ui_, state_, vec2(free_size.x, 0), vec2(width, tools));
    panel_column(ui_, state_, vec2(free_size.x, tools), vec2(width, free_size.y - tools));
    status_line(ui_, state_, vec2(0, free_size.y), vec2(window.x, window.y - free_size.y));
  }
  if (state_.compare.active)
    compare_overlay(ui_, state_.compare, compare_panes(), compare_.difference() != nullptr);
  inspector_.draw(ui_, state_, picture_rect(), free, now_);
  if (state_.error.empty()) picture_label(ui_, state_, vec2(0));
  lab_.draw(ui_, state_.lab_visible, vec2(0), free_size);
  message_strips(ui_, state_, vec2(0), free_size.x);
  help_overlay(ui_, state_, 0.5f * free_size, 0.96f * free_size);
  const vec2 bottom_center(0.5f * free_size.x, free_size.y);
  if (!shows_panels() && !state_.notice.empty())
    floating_line(ui_, "notice", state_.notice, bottom_center);
  else if (now_ - first_frame_ < kHintSeconds && !state_.help_visible && !state_.lab_visible)
    floating_line(ui_, "hint",
                  "W A S D to fly, drag to look, middle or Alt+drag to orbit; F1 shows every key",
                  bottom_center);
}

void Viewer::fit_film() {
  if (!state_.fit_film) return;
  FilmSettings& film = state_.document.settings.film;
  const ivec2 size =
      glm::clamp(fitted_film(framebuffer_, state_.document.scene.camera.aspect), ivec2(1), ivec2(16384));
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
    notify("The view is the scene's own again");
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
    notify(fmt::format("Done again: {}", history_.redo_name()));
    show_state(history_.redo());
  } else if (steps) {
    notify(state_.undo_requested ? "There is nothing to undo" : "There is nothing to redo");
  }
  if (steps) fit_film(); // the window may have another size by now
  state_.undo_requested = state_.redo_requested = false;
  if (!in_gesture && (state_.edited || state_.undo_name != history_.undo_name())) update_modified();
  state_.undo_name = history_.undo_name();
  state_.redo_name = history_.redo_name();
}

void Viewer::notify(std::string text) {
  state_.notice = std::move(text);
  notice_until_ = now_ + kNoticeSeconds;
  redraws_ = kFramesToSettle;
}

} // namespace candela
