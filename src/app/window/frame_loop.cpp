#include "app/window/frame_loop.h"

#include "app/viewer/viewer.h"

#include <chrono>
#include <limits>

namespace candela {

namespace {

constexpr double kFullRate = 60; // frames a second that are dropped while one is late

} // namespace

void run_frames(Viewer& viewer, const FrameHost& host, ViewerDriver* driver) {
  double wanted_at = -1; // since when there is something new to draw; < 0: there is nothing
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
    if (now < due) { // an event, a new picture or the driver ends it early, and is looked at again
      host.wait(std::min(due - now, asked_again));
      continue;
    }
    // The delay, less the time without anything to draw.
    const double late = wanted_at < 0 ? 0 : now - std::max(due, wanted_at);
    wanted_at = -1;
    if (!viewer.frame(now, true)) continue;
    host.show();
    viewer.shown({host.now() - now, static_cast<int>(late * kFullRate)});
  }
}

} // namespace candela
