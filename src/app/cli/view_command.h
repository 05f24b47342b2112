#pragma once

#include "app/console/scene_options.h"

namespace candela {

/// Opens the window with the scene and returns when it is closed. An Error with ExitCode::display if there is
/// no display.
int run_view(const SceneOptions& options, bool use_preferences);

} // namespace candela
