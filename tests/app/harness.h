#pragma once
// Drives a Viewer without a window: OSMesa draws into memory, and the harness sends input and reads the
// result.

#include "app/platform/offscreen_context.h"
#include "app/viewer/viewer.h"
#include "io/images/image_file.h"
#include "support/scratch_folder.h"
#include "support/screenshots.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace candela::test {

/// A room of five coloured walls, a lamp, a glossy ball and a small point light.
inline Document test_document() {
  Document document;
  SceneDesc& scene = document.scene;
  auto material = [&](const char* name, vec3 diffuse) {
    Material m;
    m.name = name;
    m.model = DiffuseMaterial{diffuse};
    scene.materials.push_back(m);
    return static_cast<int>(scene.materials.size()) - 1;
  };
  auto wall = [&](const char* name, int index, vec3 position, float angle, vec3 axis, float size) {
    const mat4 turned = glm::rotate(glm::translate(mat4(1), position), angle, axis);
    scene.instances.push_back({name, RectangleShape{}, glm::scale(turned, vec3(size)), {index}});
  };
  const int white = material("white", vec3(0.73f));
  const int red = material("red", {0.63f, 0.065f, 0.05f});
  const int green = material("green", {0.14f, 0.45f, 0.091f});
  const int lamp = material("lamp", vec3(0.78f));
  const int ball = material("ball", vec3(0.2f));
  scene.materials[static_cast<std::size_t>(lamp)].emission = vec3{17, 12, 5};
  Material& gloss = scene.materials[static_cast<std::size_t>(ball)];
  gloss.model = PhongMaterial{vec3(0.2f), vec3(0.6f)};
  const vec3 x(1, 0, 0), y(0, 1, 0);
  wall("floor", white, {0, -1, 0}, -kPi / 2, x, 1);
  wall("ceiling", white, {0, 1, 0}, kPi / 2, x, 1);
  wall("back", white, {0, 0, -1}, 0, y, 1);
  wall("left", red, {-1, 0, 0}, kPi / 2, y, 1);
  wall("right", green, {1, 0, 0}, -kPi / 2, y, 1);
  wall("lamp", lamp, {0, 0.999f, 0}, kPi / 2, x, 0.25f);
  scene.instances.push_back(
      {"ball", SphereShape{0.4f}, glm::translate(mat4(1), vec3(0.2f, -0.6f, 0.1f)), {ball}});
  LightDesc point;
  point.name = "spark";
  point.model = PointLightModel{.position = {-0.6f, 0.2f, 0.5f}};
  point.color = vec3(0.2f);
  scene.lights.push_back(point);
  scene.camera.position = {0, 0, 3.6f};
  scene.camera.vertical_fov = radians(40.0f);
  document.settings.film.width = 64;
  document.settings.film.height = 48;
  document.settings.stop.spp = 2;
  return document;
}

struct HarnessOptions {
  ivec2 size{1280, 720};
  float scale = 1;
  bool fit_film = false; ///< a small fixed film keeps the tests fast
  std::filesystem::path screenshot_folder = ".";
  std::filesystem::path preferences = {}; ///< empty: not stored
  std::function<void(const Progress&)> on_build = {};
  std::string scene_path = {};       ///< ViewerOptions::scene_path
  std::filesystem::path studio = {}; ///< ThumbnailOptions::studio
};

/// One at a time: the newest context is the current one.
class ViewerHarness {
public:
  static constexpr double kPatience = 240; ///< seconds

  explicit ViewerHarness(Document document = test_document(), const HarnessOptions& options = {})
      : viewer(context_.gl(), viewer_options(std::move(document), options)) {
    resize(options.size, options.scale);
    frame(3);
  }

  // Time and pictures.

  void frame(int count = 1, double seconds = 1 / 30.0) {
    for (int i = 0; i < count; ++i) {
      viewer.frame(clock_ += seconds);
      viewer.shown({});
    }
    EXPECT_EQ(context_.gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  /// Long enough that the next click is not the second one of a double click.
  void pause() { frame(1, 0.5); }

  // What waits ends the test, by an exception, if it waits in vain: longer than the slowest machine could
  // take.

  /// Waits until the newest Document is rendered and on the screen.
  void wait_for_picture(double seconds = kPatience) {
    if (!viewer.session().wait_finished(seconds)) throw std::runtime_error("the picture did not get ready");
    frame(2);
  }

  /// Draws frames until `done`.
  template <class Condition>
  void wait_until(const char* what, Condition done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience);
    while (!done()) {
      if (std::chrono::steady_clock::now() > end)
        throw std::runtime_error(std::string("waited in vain until ") + what);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      frame();
    }
  }

  std::vector<std::uint8_t> pixels() const { return context_.pixels(); }
  ivec2 size() const { return context_.size(); }

  /// Writes the screen to screenshots/<name>.png in the tests' build folder.
  void screenshot(const std::string& name) const {
    const std::vector<std::uint8_t> rgba = pixels();
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < rgba.size(); i += 4)
      rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    write_srgb8_image(size().x, size().y, rgb, screenshot_path(name + ".png"));
  }

  // Input. Each step is drawn in a frame of its own.

  void send(Event event) {
    viewer.handle(std::move(event));
    frame();
    while (viewer.has_pending_events()) frame();
  }
  void resize(ivec2 size, float scale = 1) {
    context_.resize(glm::max(size, ivec2(1)));
    send(Resized{size, scale});
  }
  void move(vec2 to) { send(MouseMoved{to}); }
  void press(MouseButton button = MouseButton::left) { send(MouseButtonChanged{button, true}); }
  void release(MouseButton button = MouseButton::left) { send(MouseButtonChanged{button, false}); }
  void click(vec2 at) {
    pause();
    move(at);
    press();
    release();
  }
  void double_click(vec2 at) {
    click(at);
    press();
    release();
  }
  void drag(vec2 from, vec2 to) {
    pause();
    move(from);
    press();
    move(0.5f * (from + to));
    move(to);
    release();
  }
  void scroll(vec2 at, float notches) {
    move(at);
    send(MouseScrolled{{0, notches}});
  }
  void key_down(Key key) { send(KeyChanged{key, true}); }
  void key_up(Key key) { send(KeyChanged{key, false}); }
  void key(Key key) {
    key_down(key);
    key_up(key);
  }
  /// A key with Ctrl, perhaps with Shift, then `frames` more frames.
  void control(Key k, bool shift = false, int frames = 0) {
    key_down(Key::left_control);
    if (shift) key_down(Key::left_shift);
    key(k);
    if (shift) key_up(Key::left_shift);
    key_up(Key::left_control);
    frame(frames);
  }
  void type(const std::string& text) {
    for (char c : text) send(TextTyped{static_cast<char32_t>(c)});
  }

  // Widgets by name.

  std::optional<WidgetRecord> find(const std::string& name) const {
    for (const WidgetRecord& widget : viewer.widgets())
      if (widget.name == name) return widget;
    return std::nullopt;
  }
  static bool is_visible(const WidgetRecord& w) {
    return w.lo.x >= w.clip_lo.x - 1 && w.lo.y >= w.clip_lo.y - 1 && w.hi.x <= w.clip_hi.x + 1 &&
           w.hi.y <= w.clip_hi.y + 1 && w.hi.y > w.lo.y;
  }
  /// Scrolls the panels until the widget is visible, and returns its centre.
  vec2 reveal(const std::string& name) {
    // Lists out of sight have no items.
    if (const auto slash = name.find('/'); slash != std::string::npos && !find(name)) {
      const std::string items = name.starts_with("emitters/") ? "lights" : name.substr(0, slash);
      if (find("list." + items)) reveal("list." + items), frame(2);
    }
    for (int i = 0; i < 300; ++i) {
      const auto widget = find(name);
      if (!widget) break;
      if (is_visible(*widget)) return 0.5f * (widget->lo + widget->hi);
      const auto column = find("panel.statistics"); // its left margin belongs to no list
      const float x = column->lo.x - 1;
      scroll({x, 300}, widget->lo.y < widget->clip_lo.y + 1 ? 1.0f : -1.0f);
      frame();
    }
    ADD_FAILURE() << name << " is not visible";
    return vec2(-1);
  }
  void click(const std::string& name) { click(reveal(name)); }
  void double_click(const std::string& name) { double_click(reveal(name)); }
  /// Opens a section unless it shows `inside` already.
  void unfold(const std::string& section, const std::string& inside) {
    if (!find(inside)) click(section);
    frame(2);
    ASSERT_TRUE(find(inside)) << section << " has no " << inside;
  }
  /// Unfolds every section and group.
  void unfold_all() {
    unfold("panel.statistics", "statistics.progress");
    unfold("panel.display", "display.exposure");
    unfold("panel.inspect", "inspect.probe");
    unfold("panel.camera", "camera.vertical_fov");
    unfold("panel.bookmarks", "bookmark.add");
    unfold("panel.render", "group.path");
    unfold("group.path", "path.max_depth");
    unfold("group.sampler", "sampler.type");
    unfold("group.stop", "stop.spp");
    unfold("group.film", "film.width");
    unfold("group.override", "override.brdf");
    unfold("group.ao", "ao.distance");
    unfold("group.adaptive", "adaptive.error");
    unfold("panel.objects", "list.objects");
    unfold("panel.materials", "material.type");
    if (!find("texture.view") && !find("textures.none")) click("panel.textures");
    if (!find("light.type") && !find("emitter.emission.r")) click("panel.lights");
    unfold("panel.scenes", "scene.path");
  }
  /// Ctrl+click, type, Enter.
  void type_into(const std::string& name, const std::string& text) {
    begin_typing(name);
    type(text);
    key(Key::enter);
    frame();
  }
  void begin_typing(const std::string& name) {
    const vec2 at = reveal(name);
    key_down(Key::left_control);
    click(at);
    key_up(Key::left_control);
  }
  /// Opens a choice and clicks one of its items.
  void choose(const std::string& name, const std::string& item) {
    click(name);
    frame(2);
    click(name + "/" + item);
    frame(2);
  }

  const ViewerState& state() const { return viewer.state(); }
  const Document& document() const { return viewer.state().document; }

private:
  static ViewerOptions viewer_options(Document document, const HarnessOptions& options) {
    ViewerOptions out;
    out.document = std::move(document);
    out.fit_film = options.fit_film;
    out.screenshot_folder = options.screenshot_folder;
    out.threads = 2;
    out.on_build = options.on_build;
    out.thumbnails = {1, 2, 10, 0, options.studio}; // few samples: the tests are not to wait
    out.scene_path = options.scene_path;
    std::string warning;
    out.preferences_path = options.preferences;
    if (!options.preferences.empty()) out.preferences = read_preferences(options.preferences, warning);
    return out;
  }

  OffscreenContext context_;
  double clock_ = 100;

public:
  Viewer viewer; // after the context that it draws in
};

} // namespace candela::test
