#pragma once
// Information about the picture: the surface under the mouse, the histogram, the focus. Work that takes
// longer than tracing a ray runs on a thread of its own.

#include "app/panels/viewer_state.h"
#include "app/platform/event.h"
#include "app/platform/gl.h"
#include "app/platform/task_thread.h"
#include "app/tools/viewport.h"
#include "app/ui/widgets.h"
#include "render/camera/picking.h"

namespace candela {

class Inspector {
public:
  /// The context of `gl` must be current here, in draw() and in the destructor; `wake` is that of
  /// ViewerOptions.
  Inspector(const Gl& gl, std::function<void()> wake);
  ~Inspector();
  Inspector(const Inspector&) = delete;
  Inspector& operator=(const Inspector&) = delete;

  /// Handles keys of the probe, the focus plane and bookmarks: returns a message, which may be empty, or
  /// nothing for other keys.
  std::optional<std::string> shortcut(Key key, bool control, ViewerState& state);

  /// Starts work that the state requests and takes finished results. `mouse` is a framebuffer position, or
  /// nothing while the mouse is over a panel.
  void update(ViewerState& state, const RenderSession& session, const PixelRect& picture,
              std::optional<vec2> mouse);

  /// Draws the overlays within `free`, the part of the window without panels; those at the top begin below
  /// `clear`. `now` is that of Viewer::frame().
  void draw(Ui& ui, ViewerState& state, const PixelRect& picture, const PixelRect& free, vec2 clear,
            double now);

  /// Shows the mark of a new focus for a short time.
  static void mark_focus(ViewerState& state, const Pick& pick, double now);

  bool wants_redraw() const { return worker_.has_completions(); }

private:
  /// The inputs of a depth map; focus and lens do not matter.
  struct DepthKey {
    Camera camera;
    ivec2 film{0};
    std::shared_ptr<const RenderScene> scene;
    bool operator==(const DepthKey&) const = default;
  };
  static DepthKey depth_key(const RenderSession::Built& built);
  void ask_for_depths(const RenderSession& session);
  void draw_focus_plane(const ViewerState& state, const PixelRect& picture);
  void paint_focus_plane(const Camera& camera, ivec2 film);

  const Gl& gl_;
  GLuint texture_ = 0;
  DepthKey depth_of_, asked_of_; ///< of the current map, and of the requested one
  std::shared_ptr<const DepthMap> depths_;
  Camera painted_camera_;
  std::shared_ptr<const DepthMap> painted_depths_; ///< null: the texture is empty
  bool depths_current_ = false;                    ///< depths_ belongs to the shown picture
  bool counting_ = false, tracing_ = false;
  TaskThread worker_; ///< last, so that it is destroyed first
};

} // namespace candela
