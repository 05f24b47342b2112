#include "app/window/frame_loop.h"

#include "app/viewer/viewer.h"

#include <chrono>
#include <limits>

namespace candela {

namespace {

constexpr double kFullRate = 60; // rate at which missed frames are counted

} // namespace

void run_frames(Viewer& viewer, const FrameHost& host, ViewerDriver* driver) {
  double wanted_at = -1; // time since when there is something to draw; < 0: nothing
  while (!viewer.wants_close()) {
    host.wait(0);
    double asked_again = std::numeric_limits<double>::infinity();
    if (driver != nullptr && (asked_again = driver->next(viewer)) < 0) return;
    const double now = host.now();
    if (!viewer.wants_redraw())
      wanted_at = -1;
    else if (wanted_at < 0)
      wanted_at = now;
    const double due = viewer.next_frame();
    if (now < due) { // events, new pictures and the driver end the wait early
      host.wait(std::min(due - now, asked_again));
      continue;
    }
    // The delay without the time in which there was nothing to draw.
    const double late = wanted_at < 0 ? 0 : now - std::max(due, wanted_at);
    wanted_at = -1;
    if (!viewer.frame(now, true)) continue;
    host.show();
    viewer.shown({host.now() - now, static_cast<int>(late * kFullRate)});
  }
}

} // namespace candela
