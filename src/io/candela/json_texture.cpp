#include "io/candela/json_texture.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

namespace candela {

JsonTexture read_json_texture(JsonValue object, std::string_view element, const WarningList& warnings) {
  constexpr std::string_view kKeys[] = {"file", "name", "width", "height", "srgb"};
  constexpr int kMaxSide = 65536;
  JsonTexture out;
  auto picture = std::make_shared<Texture>();
  std::optional<JsonValue> srgb;
  for (auto [key, value] : object.members()) {
    std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "file")
      out.file = value;
    else if (key.string() == "name")
      picture->name = read_string(value, name);
    else if (key.string() == "width")
      picture->width = read_integer(value, name, 1, kMaxSide);
    else if (key.string() == "height")
      picture->height = read_integer(value, name, 1, kMaxSide);
    else if (key.string() == "srgb")
      srgb = value;
    else
      throw unknown_key(key, element, kKeys);
  }
  if (out.file) return out;
  auto bytes = 3 * static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height);
  if (!srgb || srgb->type() != JsonType::array || bytes == 0 || srgb->size() != bytes)
    throw input_error((srgb ? *srgb : object).where(), element, "it is no picture",
                      "give a \"file\", or width, height and 3 width height bytes as \"srgb\"");
  std::string name = fmt::format("{}.srgb", element);
  picture->srgb.reserve(bytes);
  for (JsonValue byte : *srgb) {
    warnings.check_stop();
    picture->srgb.push_back(static_cast<std::uint8_t>(read_integer(byte, name, 0, 255)));
  }
  out.inline_picture = std::move(picture);
  return out;
}

std::string json_texture(const Texture& texture) {
  return fmt::format("{{\"name\": {}, \"width\": {}, \"height\": {}, \"srgb\": [{}]}}",
                     json_quoted(texture.name), texture.width, texture.height, fmt::join(texture.srgb, ","));
}

} // namespace candela
