#include "io/candela/json_material.h"

#include "io/candela/json_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr std::string_view kOldTexture = "diffuse_texture", kOldScale = "diffuse_uv_scale",
                           kOldOffset = "diffuse_uv_offset";

/// The offset of a texture has no range of its own.
FieldInfo offset_row(const FieldInfo& row) {
  constexpr double kMost = 1e9;
  FieldInfo out = row;
  out.key = "offset";
  out.minimum = -kMost, out.maximum = kMost;
  return out;
}

/// By default a texture is not scaled.
void set_plain_factor(const ParameterRef& parameter) {
  if (parameter.number != nullptr)
    *parameter.number = 1.0f;
  else
    *parameter.color = vec3(1);
}

void read_textured(JsonValue object, const MaterialField& row, const ParameterRef& parameter,
                   const std::string& element, const JsonTextureNames& textures) {
  std::vector<std::string_view> known = {"texture", "factor", "offset", "uv_scale", "uv_offset"};
  for (const auto& part : texture_use_fields()) known.push_back(part.key);
  set_plain_factor(parameter);
  TextureUse& use = parameter.use();
  for (auto [key, value] : object.members()) {
    const std::string& name = key.string();
    const std::string place = fmt::format("{}.{}", element, name);
    if (name == "texture")
      use.texture = textures.any(value, place);
    else if (name == "factor")
      read_field(row, parameter.value(), value, place);
    else if (name == "offset")
      read_field(offset_row(row), parameter.offset(), value, place);
    else if (name == "uv_scale")
      use.uv.scale = read_vec2(value, place);
    else if (name == "uv_offset")
      use.uv.offset = read_vec2(value, place);
    else if (!read_row(texture_use_fields(), use, key, value, element))
      throw unknown_key(key, element, known);
  }
  if (use.texture < 0)
    throw input_error(object.where(), element, "it names no texture",
                      "give a \"texture\", or a value instead of the object");
}

/// Reads a value of the material's type; false if the type has no such key.
bool read_value(Material& material, JsonValue key, JsonValue value, const std::string& element,
                const JsonTextureNames& textures, std::vector<JsonMaterialPart>& parts) {
  const MaterialField* row = find_material_field(material_type(material), key.string());
  if (row == nullptr) return false;
  const std::string place = fmt::format("{}.{}", element, key.string());
  if (row->type == FieldType::material)
    parts.push_back({row, value, place});
  else if (row->parameter != nullptr && value.type() == JsonType::object)
    read_textured(value, *row, row->parameter(material), place, textures);
  else
    read_field(*row, row->address(material), value, place);
  return true;
}

/// Older files name the only texture of a material so.
bool read_old_texture(Material& material, JsonValue key, JsonValue value, const std::string& element,
                      const JsonTextureNames& textures) {
  const std::string& name = key.string();
  const std::string place = fmt::format("{}.{}", element, name);
  TextureUse nobody;
  const ParameterRef diffuse = find_parameter(material, "diffuse");
  TextureUse& use = diffuse ? diffuse.use() : nobody;
  if (name == kOldTexture)
    use.texture = textures.file_or_index(value, place);
  else if (name == kOldScale)
    use.uv.scale = read_vec2(value, place);
  else if (name == kOldOffset)
    use.uv.offset = read_vec2(value, place);
  else
    return false;
  return true;
}

std::string json_pair(vec2 v) { return fmt::format("[{}, {}]", v.x, v.y); }

std::string textured_json(const MaterialField& row, const ParameterRef& parameter,
                          const std::function<std::string(int)>& reference) {
  TextureUse& use = parameter.use();
  TextureUse standard = parameter.standard_use();
  std::vector<std::string> members = {fmt::format("\"texture\": {}", reference(use.texture))};
  auto add = [&](std::string_view key, const FieldInfo& info, const void* value, const void* usual) {
    if (!field_equal(info, value, usual))
      members.push_back(fmt::format("\"{}\": {}", key, field_json(info, value)));
  };
  const vec3 ones(1), zeros(0); // a number uses the first component
  add("factor", row, parameter.value(), &ones);
  add("offset", offset_row(row), parameter.offset(), &zeros);
  for (const auto& part : texture_use_fields())
    add(part.key, part, part.address(use), part.address(standard));
  if (use.uv.scale != standard.uv.scale)
    members.push_back(fmt::format("\"uv_scale\": {}", json_pair(use.uv.scale)));
  if (use.uv.offset != standard.uv.offset)
    members.push_back(fmt::format("\"uv_offset\": {}", json_pair(use.uv.offset)));
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

} // namespace

Material read_json_material(JsonValue object, const std::string& element, const JsonTextureNames& textures,
                            std::vector<JsonMaterialPart>& parts) {
  int type = 0;
  for (auto [key, value] : object.members()) // first, because the defaults depend on it
    if (key.string() == "type") read_field(material_type_field(), &type, value, element + ".type");
  Material material = default_material(type);
  for (auto [key, value] : object.members()) {
    if (key.string() == "type") continue;
    if (key.string() == "name")
      material.name = read_string(value, element + ".name");
    else if (key.string() == "group")
      material.group = read_string(value, element + ".group");
    else if (key.string() == "medium")
      material.medium = read_string(value, element + ".medium");
    else if (!read_value(material, key, value, element, textures, parts) &&
             !read_old_texture(material, key, value, element, textures) &&
             !read_for_other_types(kMaterialTypeCount, default_material,
                                   [&, &key = key, &value = value](Material& other) {
                                     std::vector<JsonMaterialPart> ignored;
                                     return read_value(other, key, value, element, textures, ignored);
                                   })) {
      std::vector<std::string_view> known = {"name",      "type",    "group",   "medium",
                                             kOldTexture, kOldScale, kOldOffset};
      for (int t = 0; t < kMaterialTypeCount; ++t)
        for (const MaterialField& row : material_fields(t))
          if (std::ranges::find(known, row.key) == known.end()) known.push_back(row.key);
      throw unknown_key(key, element, known);
    }
  }
  return material;
}

std::vector<std::string> json_material_members(const Material& material, const JsonReferences& references) {
  auto& m = const_cast<Material&>(material);
  const int type = material_type(material);
  Material defaults = default_material(type);
  std::vector<std::string> members;
  if (!material.name.empty()) members.push_back(fmt::format("\"name\": {}", json_quoted(material.name)));
  if (type != 0) members.push_back(fmt::format("\"type\": {}", json_quoted(material_type_name(material))));
  if (!material.group.empty()) members.push_back(fmt::format("\"group\": {}", json_quoted(material.group)));
  if (!material.medium.empty())
    members.push_back(fmt::format("\"medium\": {}", json_quoted(material.medium)));
  for (const MaterialField& row : material_fields(type)) {
    if (row.parameter != nullptr && row.parameter(m).use().texture >= 0)
      members.push_back(
          fmt::format("\"{}\": {}", row.key, textured_json(row, row.parameter(m), references.texture)));
    else if (!field_equal(row, row.address(m), row.address(defaults)))
      members.push_back(fmt::format("\"{}\": {}", row.key,
                                    row.type == FieldType::material
                                        ? references.material(*static_cast<int*>(row.address(m)))
                                        : field_json(row, row.address(m))));
  }
  return members;
}

} // namespace candela
