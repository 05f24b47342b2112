#pragma once

#include "app/console/scene_options.h"

namespace candela {

/// Prints counts, bounds, lights, warnings and memory of a scene as JSON.
int run_info(const SceneOptions& options);

} // namespace candela
