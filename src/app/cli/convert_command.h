#pragma once

#include "app/console/scene_options.h"

namespace candela {

/// `candela convert`: writes any readable scene as Candela JSON, and lists on stderr the files that were
/// copied next to it; or a volume as .cvol.
int run_convert(const SceneOptions& options, const std::string& output);

} // namespace candela
