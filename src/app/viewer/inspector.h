#pragma once
// What the user learns about the picture: what lies under the mouse, the distribution of brightness, what is
// in focus. What takes longer than a ray runs on a thread of its own.

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
  /// The context of `gl` must be current here, in draw() and in the destructor; `wake` as of ViewerOptions.
  Inspector(const Gl& gl, std::function<void()> wake);
  ~Inspector();
  Inspector(const Inspector&) = delete;
  Inspector& operator=(const Inspector&) = delete;

  /// If the key was one of the probe's, the focus plane's or a bookmark's: the message about it, which may be
  /// empty.
  std::optional<std::string> shortcut(Key key, bool control, ViewerState& state);

  /// Starts the work that the state asks for and takes what is done. `mouse` is a framebuffer position, or
  /// nothing while the mouse belongs to a panel.
  void update(ViewerState& state, const RenderSession& session, const PixelRect& picture,
              std::optional<vec2> mouse);

  /// The overlays, within `free`, the part of the window that no panel covers, those at its top from `clear`
  /// on. `now` as of Viewer::frame().
  void draw(Ui& ui, ViewerState& state, const PixelRect& picture, const PixelRect& free, vec2 clear,
            double now);

  /// Puts the mark of a new focus for a while.
  static void mark_focus(ViewerState& state, const Pick& pick, double now);

  bool wants_redraw() const { return worker_.has_completions(); }

private:
  /// What the depths were taken for; focus and lens do not matter.
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
  DepthKey depth_of_, asked_of_; ///< the map that is there, the one that is made
  std::shared_ptr<const DepthMap> depths_;
  Camera painted_camera_;
  std::shared_ptr<const DepthMap> painted_depths_; ///< null: the texture is empty
  bool depths_current_ = false;                    ///< depths_ is of what is shown
  bool counting_ = false, tracing_ = false;
  TaskThread worker_; ///< last, so that it ends first
};

} // namespace candela
