#pragma once
// Entries of "textures" in Candela JSON.

#include "io/candela/json_tree.h"
#include "io/files/warning_list.h"
#include "textures/texture.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace candela {

struct JsonTexture {
  std::string name;              ///< "" where none is given
  std::optional<JsonValue> file; ///< the name of a picture file, or else:
  std::shared_ptr<const Texture> texture;
};

/// Reads {"file": …, "name"}; a picture {"name", "width", "height", "channels", and "srgb": [bytes],
/// "uint16": [16 bits each] or "float": [numbers]}; or {"name", "type", the rows of that kind of texture}.
/// Throws input_error. Told to stop, it throws Cancelled.
JsonTexture read_json_texture(JsonValue object, std::string_view element, const WarningList& warnings);

/// The JSON object of a texture without a file.
std::string json_texture(const Texture& texture);

} // namespace candela
