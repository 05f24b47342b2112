#pragma once
// What the panels look at and change. They only ask (open this, save that); the Viewer does.

#include "app/compare/compare_state.h"
#include "app/tools/gizmo.h"
#include "app/tools/inspect_state.h"
#include "app/tools/interaction_meter.h"
#include "app/tools/orbit_camera.h"
#include "app/tools/selection.h"
#include "app/tools/transform_parts.h"
#include "core/bounds.h"
#include "session/render_session.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace candela {

/// A part of the picture: its corners in [0, 1]^2 from the top left, so that it outlives the film's size.
struct PictureRegion {
  vec2 lo{0}, hi{1};
  bool operator==(const PictureRegion&) const = default;
};

/// What a strip over the picture asks; nothing waits for the answer.
enum class Question { none, quit, reload, replace };

/// What an error is about: it goes when that succeeds, is tried again or is given up.
enum class ErrorCause { none, open, save, picture, camera, render, preferences };

/// A parameter of a material that is to have a texture.
struct TextureTarget {
  std::size_t material = 0; ///< index into SceneDesc::materials
  std::string key;
};

struct ViewerState {
  Document document;   ///< what the user sees and edits
  Document home;       ///< as it was loaded: what the camera, materials and lights are reset to
  bool edited = false; ///< `document` is to be submitted

  std::string scene_path;  ///< empty: the built-in scene
  Bounds3 bounds;          ///< of the scene, world space
  float natural_speed = 1; ///< scene units a second
  float speed_factor = 1;  ///< the user's, times natural_speed

  bool fit_film = true; ///< the film has the window's size
  bool panels_visible = true;
  bool help_visible = false;
  bool lab_visible = false;
  float scale = 1; ///< of the user interface; 1 is 96 dots an inch

  SessionStatus status;
  std::shared_ptr<const DisplayImage> picture; ///< the one on the screen; null before the first
  std::string picture_of;                      ///< what it shows if not the document; empty: the document
  MeterReadings meter;                         ///< recent input latency
  float frame_ms = 0;                          ///< CPU time that the last frame of the window took
  int loading = 0;                             ///< scenes being read
  std::string loading_path;
  bool reading = false; ///< a scene that will be shown
  double now = 0;       ///< the window's clock, seconds
  double loading_since = 0, building_since = 0;
  double loaded = 0;              ///< 0..1: how far reading is
  bool may_stop_building = false; ///< the history has what is shown

  std::string error; ///< shown in a strip until its cause is gone or it is dismissed; empty: none
  ErrorCause error_cause = ErrorCause::none;
  void fail(ErrorCause cause, std::string text) { error_cause = cause, error = std::move(text); }
  /// What failed of this cause does so no longer.
  void settle(ErrorCause cause) {
    if (error_cause == cause) error.clear();
  }
  float strips_bottom = 0;           ///< where the strips at the top of the picture ended in the last frame
  float told_height = 0;             ///< of those among them that only tell
  std::vector<std::string> warnings; ///< of the scene
  std::string notice;                ///< in the status line for a while

  std::vector<std::filesystem::path> scenes; ///< offered in the Scenes panel
  std::string path_input;
  std::string panorama_input;
  int selected_material = 0;
  int selected_light = 0; ///< lights first, then emissive materials

  Selection selection;
  bool reveal_selection = false; ///< the lists scroll to it once
  Tool tool = Tool::select;
  std::optional<TransformParts> typed_transform; ///< of the selected object, as its fields show it
  vec3 selection_middle{0};                      ///< of the selected object, in its own space
  bool overlays_visible = true;                  ///< the selection's box and the lights, over the picture
  std::optional<PictureRegion> region;           ///< only this accumulates
  bool region_armed = false;                     ///< the next drag over the picture sets it

  bool modified = false; ///< there are edits that the scene's file has not
  Question question = Question::none;
  std::string replace_path; ///< the file that Question::replace is about
  bool save_as_visible = false;
  std::string save_path;          ///< what is typed there
  bool save_field_wanted = false; ///< its field is to take the keyboard
  bool quit_after_save = false;
  void give_up_saving() {
    save_as_visible = quit_after_save = false;
    if (question == Question::replace) question = Question::none;
    replace_path.clear();
    settle(ErrorCause::save);
  }
  std::vector<std::string> recent; ///< recently opened or saved scenes

  bool paused = false;   ///< the user's wish; `status` tells what is
  std::string undo_name; ///< of the edit that would be undone; empty: none
  std::string redo_name;
  InspectState inspect;

  CompareState compare;

  // Requests to the Viewer.
  std::vector<std::string>
      open_paths; ///< a scene, or a picture that is to light this one; or what was dropped
  bool save_requested = false;
  bool reset_view_requested = false;
  bool refresh_scenes_requested = false;
  bool save_scene_requested = false;
  bool save_as_requested = false; ///< and under another name
  bool close_requested = false;
  bool save_and_quit_requested = false;
  bool reload_requested = false;
  bool cancel_requested = false; ///< of the scene that is being read, or built
  std::optional<std::string> save_to;
  bool undo_requested = false;
  bool redo_requested = false;
  bool step_requested = false;
  std::optional<AxisView> axis_view_requested;
  bool projection_requested = false; ///< perspective or orthographic, whichever it is not
  std::optional<Selection> select_requested;
  bool frame_requested = false; ///< the selection, or the scene, into the picture
};

/// "denoised (16 spp, NFOR)".
std::string denoised_text(const DenoisedImage& image);

/// Name of the scene's file without its folder, or "Cornell box" for the built-in one.
std::string scene_title(const ViewerState& state);

} // namespace candela
