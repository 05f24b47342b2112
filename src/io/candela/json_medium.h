#pragma once
// Media in Candela JSON.

#include "io/candela/json_tree.h"
#include "media/medium_desc.h"

namespace candela {

/// Reads {"name", "type", the rows of medium_fields(), "phase": {"type", the rows of phase_fields()}}. Throws
/// input_error.
MediumDesc read_json_medium(JsonValue object, const std::string& element);

/// The members of a medium's object.
std::vector<std::string> json_medium_members(const MediumDesc& medium);

} // namespace candela
