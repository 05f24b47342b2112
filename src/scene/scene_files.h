#pragma once
// Which files a scene's values came from.

#include "scene/scene_desc.h"

#include <set>
#include <string>

namespace candela {

/// The files of its meshes, textures and panoramas, all faces of a cube included: what a scene file that
/// holds it names. Who has read a scene knows more, see LoadedScene::files.
std::set<std::string> source_files(const SceneDesc& scene);

} // namespace candela
