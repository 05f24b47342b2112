#pragma once
// Inline strands of Candela JSON.

#include "io/candela/json_tree.h"
#include "io/files/warning_list.h"
#include "scene/curves.h"

#include <optional>
#include <string>
#include <string_view>

namespace candela {

/// The members of an instance that strands are made of, as far as they are given.
struct JsonStrands {
  std::optional<JsonValue> basis, strands, width, widths, source;
};

/// Reads "strands" and so on (io/candela/candela_json.h). Throws input_error at the offending value, at
/// `object` where one is missing. Told to stop, it throws Cancelled.
Strands read_json_strands(const JsonStrands& parts, JsonValue object, const std::string& element,
                          const WarningList& warnings);

/// The same members, without braces, indented for their place in a scene.
std::string json_strands_members(const Strands& strands, std::string_view indent);

} // namespace candela
