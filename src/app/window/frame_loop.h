#pragma once
// When the viewer is drawn: at once where a hand waits for it, seldom where only numbers and samples grow,
// not at all where nothing changes. Every window runs the same loop, whatever it is shown on.

#include <functional>

namespace candela {

class Viewer;

/// What a viewer is shown on.
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
  /// Between frames: may hand events to the viewer. Returns the seconds after which it wants to be asked
  /// again at the latest; it is asked after every frame. Negative: it is done, and the loop ends.
  virtual double next(Viewer& viewer) = 0;
};

/// Runs until the viewer wants to close, or `driver` (null: nobody) is done.
void run_frames(Viewer& viewer, const FrameHost& host, ViewerDriver* driver);

} // namespace candela
