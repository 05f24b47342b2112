#pragma once
// The window on the screen: converts GLFW's callbacks to events for the Viewer.

#include "app/viewer/viewer.h"
#include "app/window/frame_loop.h"

namespace candela {

/// Whether there is a display to open a window on. The connection is kept for the window, because a server
/// such as Xvfb restarts, and briefly refuses connections, when its last client leaves.
bool display_available();

/// Opens the window and returns when it is closed, or when `driver` (may be null) is done. An Error with
/// ExitCode::display, cause and remedy if there is no display or no OpenGL 3.3.
void run_window(ViewerOptions options, ViewerDriver* driver = nullptr);

} // namespace candela
