#pragma once
// The window without a display: the same viewer and loop, drawn into memory.

#include "app/viewer/viewer.h"
#include "app/window/frame_loop.h"

namespace candela {

/// Returns when the driver is done. An Error with ExitCode::display if OSMesa is missing.
void run_offscreen(ViewerOptions options, ivec2 size, ViewerDriver& driver);

} // namespace candela
