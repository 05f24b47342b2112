// Forwards events to Dear ImGui and to flight. Shortcuts and the mouse on the picture have files of their
// own.

#include "app/viewer/viewer.h"

#include <imgui.h>

#include <algorithm>

namespace candela {

namespace {

constexpr float kFastFactor = 4;
/// Seconds in which a turning key turns the camera by the field of view.
constexpr float kTurnSeconds = 1.0f;
constexpr double kFirstFlightStep = 1 / 60.0; // at most this for the first frame of a key
constexpr double kLongestFlightStep = 0.1;    // limits the step after a stall

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

bool flies(Key key) {
  switch (key) {
  case Key::w:
  case Key::s:
  case Key::q:
  case Key::e:
  case Key::a:
  case Key::d:
  case Key::x:
  case Key::space:
  case Key::up:
  case Key::down:
  case Key::left:
  case Key::right:
  case Key::insert:
  case Key::del: return true;
  default: return false;
  }
}

} // namespace

void Viewer::map_keys() {
  constexpr std::pair<ImGuiKey_, Key> kMap[] = {
      {ImGuiKey_Tab, Key::tab},
      {ImGuiKey_LeftArrow, Key::left},
      {ImGuiKey_RightArrow, Key::right},
      {ImGuiKey_UpArrow, Key::up},
      {ImGuiKey_DownArrow, Key::down},
      {ImGuiKey_PageUp, Key::page_up},
      {ImGuiKey_PageDown, Key::page_down},
      {ImGuiKey_Home, Key::home},
      {ImGuiKey_End, Key::end},
      {ImGuiKey_Insert, Key::insert},
      {ImGuiKey_Delete, Key::del},
      {ImGuiKey_Backspace, Key::backspace},
      {ImGuiKey_Space, Key::space},
      {ImGuiKey_Enter, Key::enter},
      {ImGuiKey_KeyPadEnter, Key::keypad_enter},
      {ImGuiKey_Escape, Key::escape},
      {ImGuiKey_A, Key::a},
      {ImGuiKey_C, Key::c},
      {ImGuiKey_V, Key::v},
      {ImGuiKey_X, Key::x},
      {ImGuiKey_Y, Key::y},
      {ImGuiKey_Z, Key::z},
  };
  for (auto [imgui_key, key] : kMap) ImGui::GetIO().KeyMap[imgui_key] = static_cast<int>(key);
}

/// Dear ImGui 1.86 sees only the state at the beginning of a frame. So a frame takes at most one change of
/// each button and key, no button change after a mouse movement (the item below must see the mouse first),
/// and no movement after a button change. Fast clicks and drags are thus handled at the right positions. Keys
/// are delayed until the frame after a click, a command or a new field, which may change the keyboard focus;
/// otherwise the first letters of a name could act as shortcuts.
bool Viewer::fits_into_frame(const Event& event) const {
  return std::visit(
      Overloaded{
          [&](const MouseMoved&) { return taken_.buttons.empty(); },
          [&](const MouseButtonChanged& e) { return !taken_.moved && !taken_.buttons.contains(e.button); },
          [&](const MouseScrolled&) { return !taken_.moved; },
          [&](const KeyChanged& e) {
            return !taken_.typed && !taken_.keys.contains(e.key) && takes_keys(e.down);
          },
          [&](const TextTyped&) { return takes_keys(true); },
          [&](const auto&) { return true; },
      },
      event);
}

bool Viewer::takes_keys(bool pressed) const {
  return !pressed || (taken_.buttons.empty() && !taken_.ends_keys && field_awaited_ == 0);
}

void Viewer::feed_events() {
  taken_ = {};
  field_awaited_ = typing_ ? 0 : std::max(field_awaited_ - 1, 0);
  while (!events_.empty() && fits_into_frame(events_.front())) {
    apply(events_.front());
    events_.pop_front();
  }
}

void Viewer::apply(const Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  std::visit(Overloaded{
                 [&](const MouseMoved& e) {
                   io.MousePos = ImVec2(e.position.x, e.position.y);
                   taken_.moved = true;
                 },
                 [&](const MouseButtonChanged& e) {
                   io.MouseDown[static_cast<int>(e.button)] = e.down;
                   taken_.buttons.insert(e.button);
                 },
                 [&](const MouseScrolled& e) {
                   io.MouseWheelH += e.notches.x;
                   io.MouseWheel += e.notches.y;
                 },
                 [&](const KeyChanged& e) { apply_key(e); },
                 [&](const TextTyped& e) {
                   io.AddInputCharacter(e.character);
                   learn_letter(e.character);
                   taken_.typed = true;
                 },
                 [&](const Resized& e) {
                   framebuffer_ = glm::max(e.framebuffer, ivec2(0));
                   if (e.content_scale > 0) content_scale_ = e.content_scale;
                 },
                 [&](const FilesDropped& e) { take_dropped(e.paths); },
                 [&](const CloseRequested&) { state_.close_requested = true; },
                 [&](const DocumentEdited& e) {
                   e.apply(state_.document);
                   state_.edited = true;
                 },
                 [&](const FocusLost&) {
                   std::ranges::fill(io.KeysDown, false);
                   std::ranges::fill(io.MouseDown, false);
                   io.KeyShift = io.KeyCtrl = io.KeyAlt = io.KeySuper = false;
                   held_.clear();
                 },
             },
             event);
}

void Viewer::apply_key(const KeyChanged& change) {
  if (change.key == Key::none || change.key == Key::count) return;
  ImGuiIO& io = ImGui::GetIO();
  taken_.keys.insert(change.key);
  io.KeysDown[static_cast<int>(change.key)] = change.down;
  auto down = [&](Key key) { return io.KeysDown[static_cast<int>(key)]; };
  io.KeyShift = down(Key::left_shift) || down(Key::right_shift);
  io.KeyCtrl = down(Key::left_control) || down(Key::right_control);
  io.KeyAlt = down(Key::left_alt) || down(Key::right_alt);
  io.KeySuper = down(Key::left_super) || down(Key::right_super);
  if (!change.down) {
    held_.erase(change.key);
    return;
  }
  const bool modifies = change.key >= Key::left_shift && change.key <= Key::right_super;
  const bool ends_typing = change.key == Key::enter || change.key == Key::keypad_enter ||
                           change.key == Key::escape || change.key == Key::tab;
  taken_.ends_keys |= typing_ ? ends_typing : io.KeyCtrl && !modifies;
  if (typing_) return;
  taken_.pressed.push_back({change.key, io.KeyCtrl, io.KeyShift, io.KeyAlt});
  if (flies(change.key) && !io.KeyCtrl && !io.KeyAlt && !io.KeySuper && single_keys_act(change.key))
    held_.insert(change.key);
}

FlyCommand Viewer::fly_command() const {
  auto axis = [&](std::initializer_list<Key> more, std::initializer_list<Key> less) {
    auto any = [&](std::initializer_list<Key> keys) {
      return std::ranges::any_of(keys, [&](Key key) { return held_.contains(key); });
    };
    return static_cast<float>(any(more)) - static_cast<float>(any(less));
  };
  FlyCommand command;
  command.move = {axis({Key::e, Key::right}, {Key::q, Key::left}), axis({Key::space}, {Key::x}),
                  axis({Key::w, Key::up}, {Key::s, Key::down})};
  command.turn = {axis({Key::a}, {Key::d}), axis({Key::insert}, {Key::del})};
  return command;
}

void Viewer::fly() {
  const Camera& camera = state_.document.scene.camera;
  const FlyCommand command = fly_command();
  if (!command.any() || !camera_problem(camera).empty()) {
    last_fly_ = -1;
    return;
  }
  const double dt = last_fly_ < 0 ? kFirstFlightStep : std::clamp(now_ - last_fly_, 0.0, kLongestFlightStep);
  last_fly_ = now_;
  const float fast = ImGui::GetIO().KeyShift ? kFastFactor : 1;
  const float distance = fast * state_.natural_speed * state_.speed_factor * static_cast<float>(dt);
  const float angle = fast * camera.vertical_fov / kTurnSeconds * static_cast<float>(dt);
  Camera moved = moved_camera(camera, distance * command.move);
  if (command.turn != vec2(0)) moved = turned_camera(moved, angle * command.turn.x, angle * command.turn.y);
  set_camera(moved);
}

} // namespace candela
