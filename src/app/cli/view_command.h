#pragma once

#include "app/console/scene_options.h"

namespace candela {

/// Opens the window on the scene and returns when it is closed. An Error with ExitCode::display where there
/// is none.
int run_view(const SceneOptions& options, bool use_preferences);

} // namespace candela
