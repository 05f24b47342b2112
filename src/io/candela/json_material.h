#pragma once
// Entries of "materials" in Candela JSON.

#include "io/candela/json_tree.h"
#include "materials/material.h"

#include <functional>
#include <string>
#include <vector>

namespace candela {

/// Resolve references to textures to indices.
struct JsonTextureNames {
  /// A picture file, or the index of an entry of "textures".
  std::function<int(JsonValue, const std::string& element)> file_or_index;
  /// The same, or the name of an entry of "textures".
  std::function<int(JsonValue, const std::string& element)> any;
};

/// A material that another one names, which may come later in the file.
struct JsonMaterialPart {
  const MaterialField* row;
  JsonValue value;
  std::string element;
};

/// Reads {"name", "type", the rows of material_fields()}. A parameter is a value, or {"texture": …, "factor",
/// "offset", the rows of texture_use_fields(), "uv_scale", "uv_offset"}. Values of other types than the
/// material's are checked, then ignored. Materials that it names are appended to `parts`. Throws input_error.
Material read_json_material(JsonValue object, const std::string& element, const JsonTextureNames& textures,
                            std::vector<JsonMaterialPart>& parts);

/// Write references to an index.
struct JsonReferences {
  std::function<std::string(int)> texture, material;
};
/// The members of a material that differ from its type's defaults.
std::vector<std::string> json_material_members(const Material& material, const JsonReferences& references);

} // namespace candela
