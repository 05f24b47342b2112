#pragma once
// Entries of "lights" in Candela JSON.

#include "io/builder/scene_builder.h"
#include "io/candela/json_tree.h"

namespace candela {

/// Reads {"name", "type", "group", the rows of that type's light_fields()}; the picture of an environment, a
/// point or a projector: "file", or "image": {"name", "width", "height", "pixels": [3 width height numbers]},
/// or of an environment "files" of six faces; and the "profile" of a point or spot, a file of LM-63 or what
/// io/candela/json_profile.h has. Files are named relative to `folder`. Values that lights of other types
/// have are checked, then ignored with a warning. Throws input_error.
LightDesc read_json_light(JsonValue object, const std::string& element, SceneBuilder& builder,
                          const std::string& folder);

/// Reads {"name", the rows of light_group_fields()}. Throws input_error.
LightGroup read_json_light_group(JsonValue object, const std::string& element);

/// The member "image" of a panorama without a file.
std::string json_panorama_member(const Panorama& panorama);

} // namespace candela
