#pragma once
// When the viewer is drawn: at once after an input, seldom where only numbers and samples grow, not at all
// where nothing changes. The window on a screen and the one in memory run the same loop.

#include <functional>

namespace candela {

class Viewer;

/// A screen, or memory.
struct FrameHost {
  std::function<double()> now; ///< seconds, monotonic
  /// Takes the events that are there; with none it waits for one, or for the viewer's `wake`, at most so
  /// long.
  std::function<void(double)> wait;
  std::function<void()> show; ///< what was drawn comes onto the screen
};

/// Drives a viewer instead of a person, on the UI's thread.
class ViewerDriver {
public:
  virtual ~ViewerDriver() = default;
  /// Between frames: may send events to the viewer. Returns the seconds after which it is to be called again
  /// at the latest; it is called after every frame. Negative: it is done, and the loop ends.
  virtual double next(Viewer& viewer) = 0;
};

/// Runs until the viewer wants to close, or `driver` (may be null) is done.
void run_frames(Viewer& viewer, const FrameHost& host, ViewerDriver* driver);

} // namespace candela
