#pragma once
// Entries of "textures" in Candela JSON.

#include "imaging/texture.h"
#include "io/candela/json_tree.h"
#include "io/files/warning_list.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace candela {

struct JsonTexture {
  std::optional<JsonValue> file; ///< the name of a picture file, or else:
  std::shared_ptr<const Texture> inline_picture;
};

/// Reads {"file": …} or {"name", "width", "height", "srgb": [bytes]}. Throws input_error.
/// Told to stop, it throws Cancelled.
JsonTexture read_json_texture(JsonValue object, std::string_view element, const WarningList& warnings);

/// The object of a picture that came from no file.
std::string json_texture(const Texture& texture);

} // namespace candela
