// Keyboard shortcuts, except flight.

#include "app/viewer/viewer.h"

#include <imgui.h>
#include <imgui_internal.h> // the open popups

namespace candela {

namespace {

constexpr float kTextZoomStep = 1.125f;
constexpr float kMinTextZoom = 0.6f, kMaxTextZoom = 2.5f;

/// The views of the number pad, as in Blender; Ctrl looks from the other side.
std::optional<AxisView> axis_view(Key key, bool control) {
  switch (key) {
  case Key::keypad_1: return control ? AxisView::back : AxisView::front;
  case Key::keypad_3: return control ? AxisView::left : AxisView::right;
  case Key::keypad_7: return control ? AxisView::bottom : AxisView::top;
  default: return std::nullopt;
  }
}

} // namespace

/// Whether an answer is expected: a question, a path field, an open list or picker.
bool Viewer::asks() const {
  return state_.question != Question::none || state_.save_as_visible || !imgui_->OpenPopupStack.empty();
}

/// Keys without modifiers belong to a question, or to the lab or a texture while it covers the view.
bool Viewer::single_keys_act(Key key) const {
  if (key == Key::escape) return true;
  if (asks()) return false;
  const bool covered = state_.lab_visible || state_.texture_view.visible;
  return !covered || key == Key::f1 || key == Key::f2 || key == Key::tab;
}

void Viewer::run_shortcuts() {
  for (const KeyPress& press : taken_.pressed) {
    if (!press.control && !single_keys_act(press.key)) continue;
    if (const auto said = inspector_.shortcut(press.key, press.control, state_)) {
      if (!said->empty()) notify(*said);
      continue;
    }
    if (const auto view = axis_view(press.key, press.control))
      state_.axis_view_requested = view;
    else if (press.control)
      run_control_shortcut(press);
    else
      run_plain_shortcut(press.key);
  }
}

void Viewer::run_control_shortcut(const KeyPress& press) {
  switch (press.key) {
  case Key::q: state_.close_requested = true; break;
  case Key::s:
    state_.save_scene_requested = true;
    state_.save_as_requested |= press.shift;
    break;
  case Key::z: (press.shift ? state_.redo_requested : state_.undo_requested) = true; break;
  case Key::y: state_.redo_requested = true; break;
  case Key::b:
    state_.region_armed = !press.alt;
    if (press.alt) state_.region.reset();
    break;
  case Key::equal: text_zoom_ = std::min(text_zoom_ * kTextZoomStep, kMaxTextZoom); break;
  case Key::minus: text_zoom_ = std::max(text_zoom_ / kTextZoomStep, kMinTextZoom); break;
  case Key::digit_0:
  case Key::keypad_0: text_zoom_ = 1; break;
  default: break;
  }
}

void Viewer::run_plain_shortcut(Key key) {
  switch (key) {
  case Key::c: state_.compare.toggle_requested = true; break;
  case Key::n:
    if (state_.compare.active) state_.compare.layout = next_layout(state_.compare.layout);
    break;
  case Key::tab: state_.panels_visible = !state_.panels_visible; break;
  case Key::f1: state_.help_visible = !state_.help_visible; break;
  case Key::f2: state_.toggle_lab(); break;
  case Key::p: state_.save_requested = true; break;
  case Key::home: state_.reset_view_requested = true; break;
  case Key::keypad_5: state_.projection_requested = true; break;
  case Key::period:
  case Key::keypad_period: state_.frame_requested = true; break;
  case Key::k:
  case Key::pause: state_.paused = !state_.paused; break;
  case Key::l: state_.step_requested = true; break;
  case Key::f: focus_at({ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y}); break;
  case Key::v: state_.tool = Tool::select; break;
  case Key::g: state_.tool = Tool::move; break;
  case Key::r: state_.tool = Tool::rotate; break;
  case Key::t: state_.tool = Tool::scale; break;
  case Key::m: state_.overlays_visible = !state_.overlays_visible; break;
  case Key::escape: escape(); break;
  default: break;
  }
}

/// Cancels the innermost activity.
void Viewer::escape() {
  if (gesture_ != Gesture::none)
    cancel_gesture();
  else if (!imgui_->OpenPopupStack.empty())
    ImGui::ClosePopupToLevel(0, true);
  else if (state_.reading || (state_.may_stop_building && state_.now - state_.building_since > 1))
    state_.cancel_requested = true; // cancels reading or building, and returns to the state before
  else if (state_.question != Question::none)
    state_.question = Question::none;
  else if (state_.save_as_visible)
    state_.give_up_saving();
  else if (state_.region_armed)
    state_.region_armed = false;
  else if (state_.help_visible)
    state_.help_visible = false;
  else if (!state_.error.empty())
    state_.error.clear();
  else if (state_.texture_view.visible)
    state_.texture_view.visible = false;
  else if (state_.lab_visible)
    state_.lab_visible = false;
  else
    state_.selection = {};
}

} // namespace candela
