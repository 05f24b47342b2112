#pragma once
// The files of a scene's values.

#include "scene/scene_desc.h"

#include <set>
#include <string>

namespace candela {

/// The files of its meshes, textures, grids of media and panoramas, including all faces of a cube: those that
/// a scene file would name. After reading a scene, LoadedScene::files has more.
std::set<std::string> source_files(const SceneDesc& scene);

} // namespace candela
