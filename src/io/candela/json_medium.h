#pragma once
// Media in Candela JSON.

#include "io/builder/scene_builder.h"
#include "io/candela/json_tree.h"
#include "media/medium_desc.h"

#include <functional>

namespace candela {

/// Reads {"name", "type", the rows of medium_fields(), "file" of a grid, named relative to `folder`, "phase":
/// {"type", the rows of phase_fields()}}. Throws input_error.
MediumDesc read_json_medium(JsonValue object, const std::string& element, SceneBuilder& builder,
                            const std::string& folder);

/// The members of a medium's object. `path_of` is how the scene names a file.
std::vector<std::string> json_medium_members(const MediumDesc& medium,
                                             const std::function<std::string(const std::string&)>& path_of);

} // namespace candela
