#pragma once

#include "app/console/scene_options.h"

namespace candela {

/// Writes any scene that can be read as Candela JSON; says on stderr what was copied beside it.
int run_convert(const SceneOptions& options, const std::string& output);

} // namespace candela
