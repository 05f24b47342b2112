#pragma once
// Events for the viewer, independent of the window system: GLFW's callbacks and the tests create them.
// Positions are framebuffer pixels from the top left.

#include "core/math.h"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace candela {

struct Document;

/// Keys by their labels on a US keyboard; only those that the window or a text field uses.
enum class Key : int {
  none,
  // clang-format off
  a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
  digit_0, digit_1, digit_2, digit_3, digit_4, digit_5, digit_6, digit_7, digit_8, digit_9,
  keypad_0, keypad_1, keypad_2, keypad_3, keypad_4, keypad_5, keypad_6, keypad_7, keypad_8, keypad_9,
  keypad_period, minus, equal, period,
  // clang-format on
  space,
  tab,
  enter,
  keypad_enter,
  escape,
  backspace,
  insert,
  del,
  home,
  end,
  page_up,
  page_down,
  left,
  right,
  up,
  down,
  f1,
  f2,
  pause,
  left_shift,
  right_shift,
  left_control,
  right_control,
  left_alt,
  right_alt,
  left_super,
  right_super,
  count, ///< not a key
};

enum class MouseButton : int { left, right, middle };

struct MouseMoved {
  vec2 position{0};
};
struct MouseButtonChanged {
  MouseButton button = MouseButton::left;
  bool down = false;
};
struct MouseScrolled {
  vec2 notches{0}; ///< y > 0: away from the user
};
struct KeyChanged {
  Key key = Key::none;
  bool down = false; ///< repeats of a held key are not reported
};
struct TextTyped {
  char32_t character = 0;
};
/// Size of the framebuffer, and the scale of its monitor (1: 96 dots per inch).
struct Resized {
  ivec2 framebuffer{0};
  float content_scale = 1;
};
struct FilesDropped {
  std::vector<std::string> paths;
};
/// The window's close button, or the window manager.
struct CloseRequested {};
/// All keys and buttons count as released, so that flight ends when the window loses the keyboard focus.
struct FocusLost {};

/// An edit that no widget makes but that is processed like a widget's; for benchmarks.
struct DocumentEdited {
  std::function<void(Document&)> apply;
};

using Event = std::variant<MouseMoved, MouseButtonChanged, MouseScrolled, KeyChanged, TextTyped, Resized,
                           FilesDropped, CloseRequested, FocusLost, DocumentEdited>;

} // namespace candela
