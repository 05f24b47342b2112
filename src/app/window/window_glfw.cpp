#include "app/window/window_glfw.h"

#include "app/platform/process_deadline.h"
#include "core/error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <optional>
#include <utility>

namespace candela {

namespace {

std::string glfw_problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown cause";
}

/// Owns glfwInit() and glfwTerminate(); must outlive all GLFW objects.
class Glfw {
public:
  Glfw() {
    if (glfwInit() == GLFW_TRUE) return;
    throw Error(ExitCode::display, fmt::format("window: there is no display ({}): set DISPLAY or "
                                               "WAYLAND_DISPLAY, or use `candela render`",
                                               glfw_problem()));
  }
  ~Glfw() { glfwTerminate(); }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

/// The n-th key after `first`: letters and digits have the same order in both enumerations.
Key key_after(Key first, int n) { return static_cast<Key>(static_cast<int>(first) + n); }

Key key_of(int glfw_key) {
  if (glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z) return key_after(Key::a, glfw_key - GLFW_KEY_A);
  if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return key_after(Key::digit_0, glfw_key - GLFW_KEY_0);
  if (glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_9)
    return key_after(Key::keypad_0, glfw_key - GLFW_KEY_KP_0);
  constexpr std::pair<int, Key> kKeys[] = {
      {GLFW_KEY_PERIOD, Key::period},
      {GLFW_KEY_KP_DECIMAL, Key::keypad_period},
      {GLFW_KEY_PAUSE, Key::pause},
      {GLFW_KEY_MINUS, Key::minus},
      {GLFW_KEY_KP_SUBTRACT, Key::minus},
      {GLFW_KEY_EQUAL, Key::equal},
      {GLFW_KEY_KP_ADD, Key::equal},
      {GLFW_KEY_SPACE, Key::space},
      {GLFW_KEY_TAB, Key::tab},
      {GLFW_KEY_ENTER, Key::enter},
      {GLFW_KEY_KP_ENTER, Key::keypad_enter},
      {GLFW_KEY_ESCAPE, Key::escape},
      {GLFW_KEY_BACKSPACE, Key::backspace},
      {GLFW_KEY_INSERT, Key::insert},
      {GLFW_KEY_DELETE, Key::del},
      {GLFW_KEY_HOME, Key::home},
      {GLFW_KEY_END, Key::end},
      {GLFW_KEY_PAGE_UP, Key::page_up},
      {GLFW_KEY_PAGE_DOWN, Key::page_down},
      {GLFW_KEY_LEFT, Key::left},
      {GLFW_KEY_RIGHT, Key::right},
      {GLFW_KEY_UP, Key::up},
      {GLFW_KEY_DOWN, Key::down},
      {GLFW_KEY_F1, Key::f1},
      {GLFW_KEY_F2, Key::f2},
      {GLFW_KEY_LEFT_SHIFT, Key::left_shift},
      {GLFW_KEY_RIGHT_SHIFT, Key::right_shift},
      {GLFW_KEY_LEFT_CONTROL, Key::left_control},
      {GLFW_KEY_RIGHT_CONTROL, Key::right_control},
      {GLFW_KEY_LEFT_ALT, Key::left_alt},
      {GLFW_KEY_RIGHT_ALT, Key::right_alt},
      {GLFW_KEY_LEFT_SUPER, Key::left_super},
      {GLFW_KEY_RIGHT_SUPER, Key::right_super},
  };
  for (auto [code, key] : kKeys)
    if (code == glfw_key) return key;
  return Key::none;
}

/// Letters are those of the keyboard layout.
Key layout_key(int glfw_key, int scancode) {
  if (glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z) {
    const char* name = glfwGetKeyName(glfw_key, scancode);
    if (name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0')
      return key_of(GLFW_KEY_A + (name[0] - 'a'));
  }
  return key_of(glfw_key);
}

class Window {
public:
  explicit Window(ViewerOptions options) {
    open(options.preferences.window);
    gl_ = load_gl([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
    options.wake = [] { glfwPostEmptyEvent(); }; // may be called from any thread
    viewer_ = std::make_unique<Viewer>(gl_, std::move(options));
    connect();
  }
  ~Window() {
    viewer_.reset(); // its GL objects are destroyed while the context exists
    for (GLFWcursor* cursor : cursors_)
      if (cursor != nullptr) glfwDestroyCursor(cursor);
    glfwDestroyWindow(window_);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void run(ViewerDriver* driver);
  /// Hides the window and waits only for pending saves.
  void leave();

private:
  void open(ivec2 size); ///< at scale 1
  void connect();
  void send_size();
  void show();
  vec2 framebuffer_position(double x, double y) const;
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

  Glfw glfw_;
  GLFWwindow* window_ = nullptr;
  Gl gl_;
  std::unique_ptr<Viewer> viewer_;
  std::array<GLFWcursor*, ImGuiMouseCursor_COUNT> cursors_{};
  int shown_cursor_ = ImGuiMouseCursor_Arrow;
  std::string title_;
};

/// The desktop's scale or, if that is 1, an estimate from the monitor's height: text of 15 pixels is tiny on
/// 2160 lines.
float monitor_scale(GLFWwindow* window) {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  if (x != 1) return x;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  return mode != nullptr ? std::clamp(static_cast<float>(mode->height) / 1080, 1.0f, 4.0f) : 1.0f;
}

void Window::open(ivec2 size) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE); // hidden until it has its size
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "candela");
  window_ = glfwCreateWindow(size.x, size.y, "Candela", nullptr, nullptr);
  if (window_ == nullptr)
    throw Error(
        ExitCode::display,
        fmt::format("window: OpenGL 3.3 is not available ({}): install a driver (libgl1-mesa-dri draws "
                    "without a GPU), or use `candela render`",
                    glfw_problem()));
  int x = 0, y = 0, width = 0, height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    // In the window system's units, which need not be pixels.
    const ivec2 pixels = size_at_scale(size, monitor_scale(window_));
    const vec2 unit = framebuffer_position(1, 1);
    const ivec2 wanted = glm::round(vec2(pixels) / glm::max(unit, vec2(1e-3f)));
    const ivec2 room = width > 0 && height > 0 ? ivec2(width, height) : wanted;
    glfwSetWindowSize(window_, std::min(wanted.x, room.x), std::min(wanted.y, room.y));
  }
  glfwShowWindow(window_);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0); // the loop has its own pacing; vertical sync of a hidden window could block
}

vec2 Window::framebuffer_position(double x, double y) const {
  int window_width = 0, window_height = 0, width = 0, height = 0;
  glfwGetWindowSize(window_, &window_width, &window_height);
  glfwGetFramebufferSize(window_, &width, &height);
  return {x * width / std::max(window_width, 1), y * height / std::max(window_height, 1)};
}

void Window::send_size() {
  Resized event;
  glfwGetFramebufferSize(window_, &event.framebuffer.x, &event.framebuffer.y);
  event.content_scale = monitor_scale(window_);
  viewer_->handle(event);
}

void Window::connect() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    of(w).viewer_->handle(MouseMoved{of(w).framebuffer_position(x, y)});
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
    if (entered == GLFW_FALSE) of(w).viewer_->handle(MouseMoved{vec2(-1e6f)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    of(w).viewer_->handle(MouseButtonChanged{static_cast<MouseButton>(button), action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
    of(w).viewer_->handle(MouseScrolled{{x, y}});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int) {
    if (action == GLFW_REPEAT) return; // text fields repeat keys themselves
    of(w).viewer_->handle(KeyChanged{layout_key(key, scancode), action == GLFW_PRESS});
  });
  glfwSetCharCallback(window_,
                      [](GLFWwindow* w, unsigned codepoint) { of(w).viewer_->handle(TextTyped{codepoint}); });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { of(w).send_size(); });
  glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) { of(w).send_size(); });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE); // the viewer may ask a question first
    of(w).viewer_->handle(CloseRequested{});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    of(w).viewer_->handle(FilesDropped{{paths, paths + count}});
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
    if (focused == GLFW_FALSE) of(w).viewer_->handle(FocusLost{});
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { of(w).send_size(); });

  cursors_[ImGuiMouseCursor_Arrow] = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
  cursors_[ImGuiMouseCursor_TextInput] = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
  cursors_[ImGuiMouseCursor_ResizeEW] = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
  cursors_[ImGuiMouseCursor_ResizeNS] = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
  cursors_[ImGuiMouseCursor_Hand] = glfwCreateStandardCursor(GLFW_HAND_CURSOR);

  ImGui::SetCurrentContext(viewer_->imgui());
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = window_;
  io.GetClipboardTextFn = [](void* w) { return glfwGetClipboardString(static_cast<GLFWwindow*>(w)); };
  io.SetClipboardTextFn = [](void* w, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
  };
  send_size();
}

void Window::run(ViewerDriver* driver) {
  const FrameHost host{[] { return glfwGetTime(); },
                       [](double seconds) {
                         if (seconds > 0)
                           glfwWaitEventsTimeout(seconds);
                         else
                           glfwPollEvents();
                       },
                       [this] { show(); }};
  run_frames(*viewer_, host, driver);
}

void Window::leave() {
  glfwHideWindow(window_);
  glfwPollEvents();
  viewer_->finish_writing();
}

void Window::show() {
  glfwSwapBuffers(window_);
  const int cursor = ImGui::GetMouseCursor();
  if (cursor != shown_cursor_ && cursor >= 0) {
    glfwSetCursor(window_, cursors_[static_cast<std::size_t>(cursor)]);
    shown_cursor_ = cursor;
  }
  if (std::string title = viewer_->title(); title != title_) {
    title_ = std::move(title);
    glfwSetWindowTitle(window_, title_.c_str());
  }
}

} // namespace

bool display_available() { return glfwInit() == GLFW_TRUE; }

void run_window(ViewerOptions options, ViewerDriver* driver) {
  constexpr double kSecondsToEnd = 1; // passes, reading and building check for cancellation often
  std::optional<ProcessDeadline> deadline;
  Window window(std::move(options));
  window.run(driver);
  window.leave();
  if (driver == nullptr) deadline.emplace(kSecondsToEnd); // a driver still has to report results
}

} // namespace candela
