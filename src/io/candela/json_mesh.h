#pragma once
// Inline meshes of Candela JSON.

#include "io/candela/json_tree.h"
#include "io/files/warning_list.h"
#include "scene/mesh.h"

#include <string>
#include <string_view>

namespace candela {

/// Reads "positions", "triangles" and so on (io/candela/candela_json.h). Throws input_error at the offending
/// number. Told to stop, it throws Cancelled.
Mesh read_json_mesh(JsonValue object, const std::string& name, std::string_view element,
                    const WarningList& warnings);

/// The members of the mesh's JSON object, without the braces, indented for their place in a scene.
std::string json_mesh_members(const Mesh& mesh, std::string_view indent);

} // namespace candela
