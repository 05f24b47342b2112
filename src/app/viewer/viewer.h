#pragma once
// The user interface (panels, navigation, picture) in any OpenGL 3.3 context. GLFW drives it in the program,
// OSMesa in the tests. It runs on the UI thread and never waits for rendering, reading or writing.

#include "app/compare/compare_layout.h"
#include "app/compare/compare_mode.h"
#include "app/lab/panels_lab.h"
#include "app/panels/panels.h"
#include "app/panels/viewer_state.h"
#include "app/platform/event.h"
#include "app/platform/gl.h"
#include "app/platform/imgui_draw.h"
#include "app/platform/task_thread.h"
#include "app/tools/edit_history.h"
#include "app/tools/fly_camera.h"
#include "app/tools/gizmo.h"
#include "app/tools/interaction_meter.h"
#include "app/tools/projection.h"
#include "app/tools/viewport.h"
#include "app/ui/widgets.h"
#include "app/viewer/dropped_files.h"
#include "app/viewer/file_watch.h"
#include "app/viewer/inspector.h"
#include "app/viewer/material_thumbnails.h"
#include "app/viewer/preferences.h"
#include "app/viewer/texture_viewer.h"
#include "io/scene_reader.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <set>

struct ImGuiContext;

namespace candela {

struct ViewerOptions {
  Document document;                             ///< the initial document
  std::string scene_path;                        ///< its path; empty: built in
  std::vector<std::string> warnings;             ///< from reading it
  FileStamps files;                              ///< LoadedScene::files
  ReadOptions reading;                           ///< of scenes that are opened later
  bool fit_film = true;                          ///< the film follows the window; else the document's size
  int threads = 0;                               ///< for rendering; 0: every core
  std::filesystem::path screenshot_folder = "."; ///< where P saves
  ThumbnailOptions thumbnails;
  Preferences preferences;
  std::filesystem::path preferences_path; ///< where they are stored; empty: nowhere
  std::function<void()> wake; ///< called from any thread when there is something new to draw; may be empty
  std::function<void(const Progress&)> on_build; ///< SessionOptions::on_build of the main picture
};

class Viewer {
public:
  /// The context of `gl` must be current here, in frame() and in the destructor; `gl` must outlive it.
  Viewer(const Gl& gl, ViewerOptions options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void handle(Event event);

  /// Handles events and draws into the current framebuffer; `now` is any monotonic clock in seconds. With
  /// `may_wait` it draws nothing and returns false if it has just submitted an edit whose picture will come
  /// soon.
  bool frame(double now, bool may_wait = false);

  /// Reports that the drawn frame is on the screen.
  void shown(WindowFrame frame);

  /// Whether frame() would show something new.
  bool wants_redraw() const;
  /// The time of the next frame(), on its clock, if neither an event nor `wake` comes earlier.
  double next_frame() const;
  /// Seconds until the next frame() if neither an event nor `wake` comes.
  double idle_seconds() const;
  /// Whether events are queued because one frame handles only one change of each button.
  bool has_pending_events() const { return !events_.empty(); }
  InteractionMeter& meter() { return meter_; }
  ivec2 framebuffer() const { return framebuffer_; }
  bool wants_close() const { return wants_close_; }
  /// Waits until everything is saved; called after the window is closed.
  void finish_writing();
  std::string title() const;

  const ViewerState& state() const { return state_; }
  const RenderSession& session() const { return *session_; }
  std::span<const WidgetRecord> widgets() const { return ui_.widgets(); }
  /// The picture's rectangle; parts may be under panels or outside the window.
  PixelRect picture_rect() const;
  const Viewport& viewport() const { return viewport_; }
  const LabPanel& lab() const { return lab_; }
  const MaterialThumbnails& thumbnails() const { return thumbnails_; }
  const TextureViewer& texture_viewer() const { return texture_viewer_; }
  /// The layout of A and B during a comparison.
  ComparePanes compare_panes() const;
  const CompareMode& comparison() const { return compare_; }
  ImGuiContext* imgui() const { return imgui_; }

private:
  // viewer_input.cpp
  static void map_keys();
  void feed_events();
  bool fits_into_frame(const Event& event) const;
  bool takes_keys(bool pressed) const;
  void apply(const Event& event);
  void apply_key(const KeyChanged& change);
  FlyCommand fly_command() const;
  void fly();

  // viewer_shortcuts.cpp
  struct KeyPress {
    Key key;
    bool control, shift, alt; // at the time of the press: they may be released in the same frame
  };
  bool asks() const;
  bool single_keys_act(Key key) const;
  void run_shortcuts();
  void run_control_shortcut(const KeyPress& press);
  void run_plain_shortcut(Key key);
  void escape();

  // viewer_picture.cpp
  enum class Gesture { none, look, orbit, pan, zoom, region, gizmo };
  vec3 pivot(); ///< the centre of orbits and zooms, world space
  std::optional<ScreenProjection> projection() const;
  void set_camera(const Camera& camera);
  void use_mouse_on_picture();
  void begin_gesture(int button, vec2 mouse);
  void drag(vec2 moved, vec2 mouse);
  void zoom(float factor);
  void turn_wheel(float notches);
  void focus_at(vec2 screen_position);
  void frame_selection();
  void end_region(vec2 mouse);
  void send_region();

  // viewer_selection.cpp
  void select_at(vec2 mouse);
  void select(const Selection& selection);
  std::optional<Gizmo> present_gizmo();
  bool begin_gizmo_drag(vec2 mouse); ///< false: no handle there
  void drag_gizmo(vec2 mouse);
  void cancel_gesture();

  // viewer_overlay.cpp
  struct LightIcon {
    int index;
    vec2 position; ///< on the screen
  };
  bool shows_overlays() const;
  void draw_overlay();
  void draw_selection(const ScreenProjection& screen, ImDrawList& list);
  void draw_region(ImDrawList& list) const;
  std::vector<LightIcon> light_icons(const ScreenProjection& screen) const;
  std::optional<int> light_at(vec2 mouse) const;

  // viewer_files.cpp
  /// Reads a scene, or a panorama for the current one, in the background.
  void open_scene(const std::vector<std::string>& paths, bool reload);
  void finish_opening(const Dropped& chosen, LoadedScene& loaded, const Bounds3& bounds, bool reload);
  void take_dropped(const std::vector<std::string>& paths);
  void read_texture(const std::string& path, const TextureTarget& target);
  void cancel_opening();
  void cancel_building();
  void look_for_changes();
  bool is_bundled(const std::string& path) const;
  void save_scene();
  void ask_for_path();
  void save_scene_to(std::string path);
  void serve_file_requests();
  void update_modified();
  void remember_recent(const std::string& path);
  void write_preferences_if_changed();
  void light_with(std::shared_ptr<const Panorama> panorama, const FileStamps& files);
  /// Gives the profile to the selected light, or to the first that may have one.
  void shape_light_with(std::shared_ptr<const IesProfile> profile, const FileStamps& files);
  /// Gives the values to the selected medium, if it takes them, or to a new one that fills the scene.
  void fill_with(std::shared_ptr<const VolumeGrid> grid, const FileStamps& files);
  void install_scene(Document document, std::string path, std::vector<std::string> warnings,
                     const Bounds3& bounds, FileStamps files);
  void watch_files(FileStamps known = {});
  template <class Read, class Install>
  void read_again(const std::string& name, Read read, Install install);
  void read_dropped_again(const std::set<std::string>& changed);
  void save_shown_picture();

  // viewer_compare.cpp
  void update_compare();
  void serve_compare_requests();
  void exchange_sides();
  bool use_mouse_on_comparison();
  void draw_comparison();
  bool comparison_wants_redraw() const;

  // viewer_layout.cpp
  PixelRect single_picture_rect() const;
  void update_scale();
  void learn_letter(char32_t letter);
  void learn_letters(std::string_view text);
  void learn_letters_of_frame();
  void learn_letters_of_scene();
  bool shows_panels() const;
  /// The part of the window without panels, which are to the right and below.
  PixelRect free_region() const;
  void draw_ui();
  void clip_overlays() const;
  void draw_window();
  void scissor(const PixelRect& rect) const;
  void clear(float grey) const;

  // viewer_pace.cpp
  static constexpr double kHintSeconds = 10;
  bool awaited_picture_is_there() const;
  bool user_waits() const;
  bool puts_off_drawing(bool restarted);
  void read_meter();
  /// Seconds between pictures that only add samples.
  double refining_interval() const;

  // viewer.cpp
  void fit_film();
  void serve_requests();
  void serve_view_requests();
  void keep_history();
  void show_state(const EditState& edit, const FileStamps& read = {});
  void submit();
  EditState edit_state() const;
  void notify(std::string text);
  void describe_picture();

  const Gl& gl_;
  ViewerOptions options_;
  ImGuiContext* imgui_ = nullptr;
  ImguiDraw draw_;
  Viewport viewport_;
  Ui ui_;
  ViewerState state_;

  std::deque<Event> events_;
  std::optional<MeterClock::time_point> input_since_; ///< arrival of this frame's oldest event
  InteractionMeter meter_;
  double meter_read_ = -1, meter_cpu_ = 0;
  double drawn_at_ = -1;
  bool owes_drawing_ = false; ///< since owed_since_: an edit was submitted instead of drawing
  double owed_since_ = -1;
  double frame_seconds_ = 0.005; ///< smoothed duration of a frame
  MeterClock::time_point began_; ///< start of the frame
  struct FrameInput {            // events taken by this frame
    bool moved = false;
    bool typed = false;
    bool scrolled = false;
    std::set<MouseButton> buttons;
    std::set<Key> keys;
    std::vector<KeyPress> pressed; // not meant for a text field
    bool ends_keys = false;        // the keyboard focus may change after this frame
  } taken_;
  std::set<Key> held_;    // keys that fly
  bool typing_ = false;   // a text field has the keyboard
  int field_awaited_ = 0; // frames for which keys are delayed until a new field has the focus
  Gesture gesture_ = Gesture::none;
  int gesture_button_ = 0;
  vec3 gesture_pivot_{0};
  vec2 press_position_{0}, drag_position_{0};
  bool dragged_ = false;
  double wheel_until_ = 0; // wheel events before this time are one edit

  SelectionBox selection_box_;
  std::optional<GizmoDrag> gizmo_drag_;
  Document before_drag_;
  CropWindow sent_region_;

  EditHistory history_;
  std::shared_ptr<OpenScene> scene_; // the state has copies of the values that panels show
  bool shown_paused_ = false;
  bool scene_is_new_ = false;          // and not submitted yet
  std::uint64_t scene_generation_ = 0; // generation of its submission
  std::string shown_title_;            // of the picture's scene
  std::uint64_t shown_generation_ = 0; // of the picture
  double behind_since_ = 0;            // time since when the picture is out of date

  std::set<char32_t> glyphs_; // characters in use that not every atlas has
  bool glyphs_are_new_ = false;

  ivec2 framebuffer_{1280, 720};
  float content_scale_ = 1;
  float text_zoom_ = 1; // the user's, by Ctrl + and -
  double now_ = 0, first_frame_ = -1, last_fly_ = -1, notice_until_ = 0;
  int redraws_ = 3; // ImGui needs a few frames for its layout
  SessionPhase drawn_phase_ = SessionPhase::idle;
  bool wants_close_ = false;
  std::uint64_t failed_generation_ = 0; // generation whose error was shown
  std::uint64_t open_requests_ = 0;
  std::shared_ptr<Progress> reading_ = std::make_shared<Progress>();
  Preferences preferences_, written_preferences_;

  Viewport other_viewport_, difference_viewport_; // of a comparison
  std::shared_ptr<OpenScene> compared_scene_;
  bool divider_held_ = false, flip_down_ = false;
  double flip_since_ = 0;

  // Last, so that they are destroyed first: they call `wake`, and their completions use the members above.
  std::unique_ptr<RenderSession> session_;
  CompareMode compare_;
  FileWatch watch_;
  TaskThread reader_;
  TaskThread writer_;
  Inspector inspector_;
  LabPanel lab_;
  TextureViewer texture_viewer_;
  MaterialThumbnails thumbnails_;
};

} // namespace candela
