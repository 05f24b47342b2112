// The mouse on the picture: looking around, orbiting, panning, zooming, picking. One gesture at a time, from
// the press of its button to the release.

#include "app/tools/orbit_camera.h"
#include "app/tools/projection.h"
#include "app/ui/typed_number.h"
#include "app/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

constexpr float kSpeedStep = 1.2f; // a notch of the wheel
constexpr float kMinSpeed = 0.01f, kMaxSpeed = 100;
constexpr float kWheelZoom = 0.85f;     // a notch of the wheel
constexpr float kZoomPerPixel = 1.005f; // of a drag, at scale 1
constexpr float kClickSlack = 4;        // pixels at scale 1 that a click may move
constexpr double kWheelGesture = 0.5;   // seconds within which turns of the wheel are one edit
constexpr float kNearestZoom = 1e-4f;   // of the distance flown in a second at natural_speed

constexpr int kLeftButton = 0, kMiddleButton = 2; // of ImGui's buttons

} // namespace

vec3 Viewer::pivot() {
  if (const auto corners = selection_box_.corners(state_.document.scene, state_.selection))
    return bounds_of(*corners).center();
  const Camera& camera = state_.document.scene.camera;
  return camera.position +
         camera.effective_focus_distance() * glm::normalize(camera.target - camera.position);
}

std::optional<ScreenProjection> Viewer::projection() const {
  const Camera& camera = state_.document.scene.camera;
  if (!camera_problem(camera).empty()) return std::nullopt;
  const FilmSettings& film = state_.document.settings.film;
  return ScreenProjection(camera, picture_rect(), {film.width, film.height});
}

void Viewer::set_camera(const Camera& camera) {
  if (camera == state_.document.scene.camera || !camera_problem(camera).empty()) return;
  state_.document.scene.camera = camera;
  state_.settle(ErrorCause::camera);
  state_.edited = true;
}

void Viewer::use_mouse_on_picture() {
  if (use_mouse_on_comparison()) return;
  const ImGuiIO& io = ImGui::GetIO();
  if (!io.WantCaptureMouse && io.MouseWheel != 0) turn_wheel(io.MouseWheel);
  const vec2 mouse(io.MousePos.x, io.MousePos.y);
  if (gesture_ == Gesture::none && !io.WantCaptureMouse)
    for (int button : {kLeftButton, kMiddleButton})
      if (io.MouseClicked[button] && gesture_ == Gesture::none) begin_gesture(button, mouse);
  if (gesture_ == Gesture::none) return;
  if (glm::length(mouse - press_position_) > kClickSlack * state_.scale) dragged_ = true;
  if (dragged_ && mouse != drag_position_) {
    drag(mouse - drag_position_, mouse);
    drag_position_ = mouse;
  }
  if (io.MouseDown[gesture_button_]) return;
  const Gesture ended = std::exchange(gesture_, Gesture::none);
  gizmo_drag_.reset();
  if (ended == Gesture::region) end_region(mouse);
  if (dragged_ || ended != Gesture::look) return;
  if (io.KeyCtrl)
    focus_at(mouse);
  else
    select_at(mouse);
}

void Viewer::begin_gesture(int button, vec2 mouse) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool around = button == kMiddleButton || io.KeyAlt; // Alt replaces a missing middle button
  if (button == kLeftButton && state_.region_armed)
    gesture_ = Gesture::region;
  else if (!around && begin_gizmo_drag(mouse))
    gesture_ = Gesture::gizmo;
  else if (!around)
    gesture_ = Gesture::look;
  else
    gesture_ = io.KeyShift ? Gesture::pan : io.KeyCtrl ? Gesture::zoom : Gesture::orbit;
  gesture_button_ = button;
  dragged_ = false;
  press_position_ = drag_position_ = mouse;
  gesture_pivot_ = pivot();
}

void Viewer::drag(vec2 moved, vec2 mouse) {
  const Camera& camera = state_.document.scene.camera;
  const auto view = projection();
  if (!view) return;
  const PixelRect& picture = view->picture();
  switch (gesture_) {
  case Gesture::none:
  case Gesture::region: break;
  case Gesture::gizmo: drag_gizmo(mouse); break;
  case Gesture::look: {
    const vec2 turn = radians_per_pixel(camera, picture.height) * moved;
    set_camera(turned_camera(camera, -turn.x, -turn.y));
    break;
  }
  case Gesture::orbit: { // the picture's height corresponds to half a turn
    const vec2 turn = kPi / static_cast<float>(std::max(picture.height, 1)) * moved;
    set_camera(orbited_camera(camera, gesture_pivot_, -turn.x, -turn.y));
    break;
  }
  case Gesture::pan: {
    const float unit = view->units_per_pixel(gesture_pivot_);
    set_camera(panned_camera(camera, {-unit * moved.x, unit * moved.y}));
    break;
  }
  case Gesture::zoom: // upwards comes closer
    zoom(std::pow(kZoomPerPixel, moved.y / state_.scale));
    break;
  }
}

void Viewer::zoom(float factor) {
  const vec3 about = gesture_ == Gesture::none ? pivot() : gesture_pivot_;
  set_camera(zoomed_camera(state_.document.scene.camera, about, factor, kNearestZoom * state_.natural_speed));
}

/// Zooms; during flight or mouse look it sets the speed of flight instead, as in game editors.
void Viewer::turn_wheel(float notches) {
  if (!fly_command().any() && gesture_ != Gesture::look) {
    if (camera_problem(state_.document.scene.camera).empty()) zoom(std::pow(kWheelZoom, notches));
    wheel_until_ = now_ + kWheelGesture;
    return;
  }
  state_.speed_factor = std::clamp(state_.speed_factor * std::pow(kSpeedStep, notches), kMinSpeed, kMaxSpeed);
  notify(fmt::format("Speed of flight: {:.2f} x", state_.speed_factor));
}

void Viewer::focus_at(vec2 screen_position) {
  const auto screen = projection();
  const auto film = screen ? screen->film_position(screen_position) : std::nullopt;
  if (!film) return; // outside the film
  const std::optional<Pick> found = session_->pick(*film);
  if (!found || !(found->view_depth > 0)) {
    notify("No surface to focus on there");
    return;
  }
  const auto& materials = state_.document.scene.materials;
  std::string on;
  if (found->material >= 0 && static_cast<std::size_t>(found->material) < materials.size()) {
    const std::string& name = materials[static_cast<std::size_t>(found->material)].name;
    if (!name.empty()) on = fmt::format(" on {}", name);
  }
  Inspector::mark_focus(state_, *found, now_);
  Camera& camera = state_.document.scene.camera;
  state_.edited |= camera.focus_distance != found->view_depth;
  camera.focus_distance = found->view_depth;
  notify(fmt::format("Focus at {}{}{}", scene_units(found->view_depth), on,
                     camera.aperture_radius > 0 ? ""
                                                : "; a pinhole has no blur: raise Camera, "
                                                  "aperture radius"));
}

void Viewer::end_region(vec2 mouse) {
  state_.region_armed = false;
  const PixelRect picture = picture_rect();
  const vec2 origin(picture.x, picture.y), size(picture.width, picture.height);
  const vec2 a = glm::clamp((press_position_ - origin) / size, 0.0f, 1.0f);
  const vec2 b = glm::clamp((mouse - origin) / size, 0.0f, 1.0f);
  const PictureRegion region{glm::min(a, b), glm::max(a, b)};
  state_.region.reset(); // a click, or a drag outside the picture, renders the whole picture again
  if (dragged_ && region.lo.x < region.hi.x && region.lo.y < region.hi.y) state_.region = region;
}

void Viewer::send_region() {
  CropWindow window;
  if (state_.region) {
    const FilmSettings& film = state_.document.settings.film;
    const vec2 size(film.width, film.height);
    const ivec2 lo(glm::floor(state_.region->lo * size)), hi(glm::ceil(state_.region->hi * size));
    window = {lo.x, lo.y, hi.x - lo.x, hi.y - lo.y};
  }
  if (window == sent_region_) return;
  session_->set_region(sent_region_ = window);
  compare_.set_region(window);
}

void Viewer::frame_selection() {
  const PixelRect rect = picture_rect();
  Bounds3 bounds = state_.bounds;
  if (const auto corners = selection_box_.corners(state_.document.scene, state_.selection)) {
    bounds = bounds_of(*corners);
    const vec3 room(0.1f * state_.natural_speed); // a light is a point
    if (state_.selection.kind == Selection::Kind::light) bounds = {bounds.lo - room, bounds.hi + room};
  }
  set_camera(framing_camera(state_.document.scene.camera, bounds,
                            static_cast<float>(rect.width) / static_cast<float>(rect.height)));
}

} // namespace candela
