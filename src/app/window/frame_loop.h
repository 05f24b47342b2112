#pragma once
// The loop that draws the viewer: at once after input, seldom while only numbers and samples change, not at
// all without changes. The window on a screen and the off-screen one share it.

#include <functional>

namespace candela {

class Viewer;

/// A window on a screen or in memory.
struct FrameHost {
  std::function<double()> now; ///< seconds, monotonic
  /// Handles pending events; without any, waits for one or for the viewer's `wake`, at most so many seconds.
  std::function<void(double)> wait;
  std::function<void()> show; ///< presents the drawn frame
};

/// Sends input to a viewer in place of a user, on the UI thread.
class ViewerDriver {
public:
  virtual ~ViewerDriver() = default;
  /// Called after every frame; may send events to the viewer. Returns the seconds until the next call at the
  /// latest. Negative: the driver is done, and the loop ends.
  virtual double next(Viewer& viewer) = 0;
};

/// Runs until the viewer wants to close, or `driver` (may be null) is done.
void run_frames(Viewer& viewer, const FrameHost& host, ViewerDriver* driver);

} // namespace candela
