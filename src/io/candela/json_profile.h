#pragma once
// Photometric profiles inline in Candela JSON.

#include "io/candela/json_tree.h"
#include "lights/ies_profile.h"

#include <memory>
#include <string>

namespace candela {

/// Reads {"name", "type": "a", "b" or "c", "vertical": [degrees], "horizontal": [degrees], "candela": [all
/// vertical angles of a horizontal one, then the next]}, as IesProfile has them. Throws input_error.
std::shared_ptr<const IesProfile> read_json_profile(JsonValue object, const std::string& element);

/// Such an object, which reads back to the same values, but for the last digits of angles.
std::string json_profile(const IesProfile& profile);

} // namespace candela
