#pragma once
// Entries of "lights" in Candela JSON.

#include "io/builder/scene_builder.h"
#include "io/candela/json_tree.h"

namespace candela {

/// Reads {"name", "type", the rows of that type's light_fields()} and the panorama of an environment: "file",
/// or "files" of six faces, or "image": {"name", "width", "height", "pixels": [3 width height numbers]}.
/// Files are named relative to `folder`. Values that lights of other types have are checked, then ignored
/// with a warning. Throws input_error.
LightDesc read_json_light(JsonValue object, const std::string& element, SceneBuilder& builder,
                          const std::string& folder);

/// The member "image" of a panorama without a file.
std::string json_panorama_member(const Panorama& panorama);

} // namespace candela
