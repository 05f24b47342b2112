#include "io/candela/json_texture.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

/// Keys of the lists of texels, by the index of Texels::Data.
constexpr std::string_view kData[] = {"srgb", "uint16", "float"};
static_assert(std::size(kData) == std::variant_size_v<Texels::Data>);

template <class T>
T read_texel(JsonValue value, const std::string& element) {
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(read_integer(value, element, 0, std::numeric_limits<T>::max()));
  else
    return read_real(value, element);
}

std::shared_ptr<const Texels> read_picture(JsonValue object, const std::string& element,
                                           const WarningList& warnings) {
  constexpr int kMaxSide = 65536;
  std::vector<std::string_view> known = {"file", "name", "type", "width", "height", "channels"};
  known.insert(known.end(), std::begin(kData), std::end(kData));
  auto out = std::make_shared<Texels>();
  std::optional<JsonValue> list;
  std::string list_key;
  for (auto [key, value] : object.members()) {
    std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "name" || key.string() == "type")
      continue;
    else if (key.string() == "width")
      out->width = read_integer(value, name, 1, kMaxSide);
    else if (key.string() == "height")
      out->height = read_integer(value, name, 1, kMaxSide);
    else if (key.string() == "channels")
      out->channels = read_integer(value, name, 1, 4);
    else if (std::ranges::find(kData, key.string()) != std::end(kData))
      list = value, list_key = key.string();
    else
      throw unknown_key(key, element, known);
  }
  const std::size_t count = out->texel_count() * static_cast<std::size_t>(out->channels);
  if (!list || list->type() != JsonType::array || count == 0 || list->size() != count || out->channels == 2)
    throw input_error(
        (list ? *list : object).where(), element, "it is no picture",
        "give a \"file\", or width, height and 3 width height bytes as \"srgb\" (\"channels\" may "
        "be 1 or 4, too; 16 bits are \"uint16\", numbers \"float\")");
  const std::string name = fmt::format("{}.{}", element, list_key);
  auto read = [&]<class T>(std::vector<T> values) {
    values.reserve(count);
    for (JsonValue value : *list) {
      warnings.check_stop();
      values.push_back(read_texel<T>(value, name));
    }
    out->data = std::move(values);
  };
  if (list_key == kData[0])
    read(std::vector<std::uint8_t>());
  else if (list_key == kData[1])
    read(std::vector<std::uint16_t>());
  else
    read(std::vector<float>());
  return out;
}

/// Reads a texture of a kind described by rows.
TextureModel read_rows(TextureModel model, JsonValue object, const std::string& element) {
  std::visit(
      [&](auto& kind) {
        const auto rows = std::decay_t<decltype(kind)>::rows();
        for (auto [key, value] : object.members())
          if (key.string() != "name" && key.string() != "type" && !read_row(rows, kind, key, value, element))
            throw unknown_key(key, element, keys_of(rows, {"name", "type"}));
      },
      model);
  return model;
}

} // namespace

JsonTexture read_json_texture(JsonValue object, std::string_view element, const WarningList& warnings) {
  constexpr std::string_view kFileKeys[] = {"file", "name"};
  JsonTexture out;
  const std::string place(element);
  const FieldInfo kinds{"type", FieldType::choice, 0, 0, "", "", Invalidates::image, texture_kind_names()};
  int kind = 0;
  for (auto [key, value] : object.members()) {
    if (key.string() == "file") out.file = value;
    if (key.string() == "name") out.name = read_string(value, place + ".name");
    if (key.string() == "type") read_field(kinds, &kind, value, place + ".type");
  }
  if (out.file) {
    for (auto [key, value] : object.members())
      if (std::ranges::find(kFileKeys, key.string()) == std::end(kFileKeys))
        throw unknown_key(key, element, kFileKeys);
    return out;
  }
  TextureModel model = *texture_of_kind(texture_kind_names()[static_cast<std::size_t>(kind)]);
  if (auto* image = std::get_if<ImageTexture>(&model))
    image->texels = read_picture(object, place, warnings);
  else
    model = read_rows(std::move(model), object, place);
  out.texture = std::make_shared<const Texture>(Texture{out.name, std::move(model)});
  return out;
}

std::string json_texture(const Texture& texture) {
  std::vector<std::string> members = {fmt::format("\"name\": {}", json_quoted(texture.name))};
  if (const ImageTexture* image = texture.image()) {
    const Texels& texels = *image->texels;
    members.push_back(fmt::format("\"width\": {}, \"height\": {}", texels.width, texels.height));
    if (texels.channels != 3) members.push_back(fmt::format("\"channels\": {}", texels.channels));
    std::visit(
        [&](const auto& values) {
          members.push_back(fmt::format("\"{}\": [{}]", kData[texels.data.index()], fmt::join(values, ",")));
        },
        texels.data);
  } else {
    visit_texture(texture, [&](const auto& kind, const auto& rows) {
      auto copy = kind;
      std::decay_t<decltype(kind)> standard;
      members.push_back(fmt::format("\"type\": {}", json_quoted(kind.kName)));
      for (const auto& row : rows)
        if (!field_equal(row, row.address(copy), row.address(standard)))
          members.push_back(fmt::format("\"{}\": {}", row.key, field_json(row, row.address(copy))));
    });
  }
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

} // namespace candela
