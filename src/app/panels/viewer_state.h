#pragma once
// The state that the panels show and edit. They only make requests (open, save); the Viewer acts on them.

#include "app/compare/compare_state.h"
#include "app/tools/gizmo.h"
#include "app/tools/inspect_state.h"
#include "app/tools/interaction_meter.h"
#include "app/tools/orbit_camera.h"
#include "app/tools/selection.h"
#include "app/tools/texture_view_state.h"
#include "app/tools/thumbnail_state.h"
#include "app/tools/transform_parts.h"
#include "core/bounds.h"
#include "session/render_session.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace candela {

/// A part of the picture: its corners in [0, 1]^2 from the top left, independent of the film's size.
struct PictureRegion {
  vec2 lo{0}, hi{1};
  bool operator==(const PictureRegion&) const = default;
};

/// The question of a strip over the picture; it is not modal.
enum class Question { none, quit, reload, replace };

/// The subject of an error, which is cleared when the action succeeds, is retried or is cancelled.
enum class ErrorCause { none, open, save, picture, camera, material, render, preferences };

struct ViewerState {
  Document document;   ///< the edited document
  Document home;       ///< as loaded: camera, materials and lights are reset to it
  bool edited = false; ///< `document` is to be submitted

  std::string scene_path;  ///< empty: the built-in scene
  Bounds3 bounds;          ///< of the scene, world space
  float natural_speed = 1; ///< scene units a second
  float speed_factor = 1;  ///< set by the user; multiplies natural_speed

  bool fit_film = true; ///< the film has the window's size
  bool panels_visible = true;
  bool help_visible = false;
  bool lab_visible = false;
  TextureViewState texture_view; ///< over the picture
  ThumbnailState thumbnails;
  /// The lab comes to the front of a texture.
  void toggle_lab() {
    lab_visible = texture_view.visible || !lab_visible;
    texture_view.visible = false;
  }
  float scale = 1; ///< of the user interface; 1 is 96 dots an inch

  SessionStatus status;
  std::shared_ptr<const DisplayImage> picture; ///< the one on the screen; null before the first
  std::string picture_of;                      ///< what it shows, if not the current document
  MeterReadings meter;                         ///< recent input latency
  float frame_ms = 0;                          ///< CPU time that the last frame of the window took
  int loading = 0;                             ///< scenes being read
  std::string loading_path;
  bool reading = false; ///< a scene is being read
  double now = 0;       ///< the window's clock, seconds
  double loading_since = 0, building_since = 0;
  double loaded = 0;              ///< 0..1: how far reading is
  bool may_stop_building = false; ///< the history has the displayed state

  std::string error; ///< shown in a strip until resolved or dismissed; empty: none
  ErrorCause error_cause = ErrorCause::none;
  void fail(ErrorCause cause, std::string text) { error_cause = cause, error = std::move(text); }
  /// Clears the error if it has this cause.
  void settle(ErrorCause cause) {
    if (error_cause == cause) error.clear();
  }
  float strips_bottom = 0;           ///< bottom of the strips in the last frame
  float told_height = 0;             ///< height of those without a question
  std::vector<std::string> warnings; ///< of the scene
  std::string notice;                ///< shown in the status line for a short time

  std::vector<std::filesystem::path> scenes; ///< offered in the Scenes panel
  std::string path_input;
  std::string panorama_input;
  std::string volume_input; ///< typed path of a medium's file
  int selected_material = 0;
  int selected_texture = 0;
  int selected_medium = 0;
  int selected_light = 0; ///< lights first, then emissive materials

  Selection selection;
  bool reveal_selection = false; ///< the lists scroll to it once
  Tool tool = Tool::select;
  std::optional<TransformParts> typed_transform; ///< of the selected object, as its fields show it
  vec3 selection_middle{0};                      ///< of the selected object, in its own space
  bool overlays_visible = true;                  ///< the selection's box and the lights, over the picture
  std::optional<PictureRegion> region;           ///< only this part accumulates
  bool region_armed = false;                     ///< the next drag over the picture sets the region

  bool modified = false; ///< there are unsaved edits
  Question question = Question::none;
  std::string replace_path; ///< the file that Question::replace is about
  bool save_as_visible = false;
  std::string save_path;          ///< the typed path
  bool save_field_wanted = false; ///< its field is to get the keyboard focus
  bool quit_after_save = false;
  void give_up_saving() {
    save_as_visible = quit_after_save = false;
    if (question == Question::replace) question = Question::none;
    replace_path.clear();
    settle(ErrorCause::save);
  }
  std::vector<std::string> recent; ///< recently opened or saved scenes

  bool paused = false;   ///< requested by the user; `status` has the actual state
  std::string undo_name; ///< name of the edit that undo would revert; empty: none
  std::string redo_name;
  InspectState inspect;

  CompareState compare;

  // Requests to the Viewer.
  std::vector<std::string> open_paths; ///< a scene, or a file for a part of it
  bool save_requested = false;
  bool reset_view_requested = false;
  bool refresh_scenes_requested = false;
  bool save_scene_requested = false;
  bool save_as_requested = false; ///< save under another name
  bool close_requested = false;
  bool save_and_quit_requested = false;
  bool reload_requested = false;
  bool cancel_requested = false; ///< cancel reading or building
  std::optional<std::string> save_to;
  bool undo_requested = false;
  bool redo_requested = false;
  bool step_requested = false;
  std::optional<AxisView> axis_view_requested;
  bool projection_requested = false; ///< toggle between perspective and orthographic
  std::optional<Selection> select_requested;
  bool frame_requested = false; ///< frame the selection, or the scene
};

/// "denoised (16 spp, NFOR)".
std::string denoised_text(const DenoisedImage& image);

/// Name of the scene's file without its folder, or "Cornell box" for the built-in one.
std::string scene_title(const ViewerState& state);

} // namespace candela
