#pragma once

#include "io/files/path_policy.h"
#include "scene/document.h"

namespace candela {

/// An OBJ file as a scene: its mesh alone, framed by the camera; if nothing in it shines, a constant light is
/// added. Throws the errors of reading the mesh.
Document read_obj_scene(const FoundFile& file, const PathPolicy& policy, WarningList& warnings);

} // namespace candela
