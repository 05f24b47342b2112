#include "io/candela/json_material_list.h"

#include "io/candela/json_texture.h"
#include "materials/material_parts.h"

namespace candela {

void JsonMaterialList::read_textures(JsonValue array) {
  source_.each_object(array, "textures", [&](JsonValue object, const std::string& element) {
    SceneBuilder& builder = source_.builder;
    JsonTexture texture = read_json_texture(object, element, builder.warnings());
    const int index =
        texture.file
            ? builder.append_texture(source_.require_file(*texture.file, element + ".file"), texture.name)
            : builder.append_texture(std::move(texture.texture));
    if (!texture.name.empty()) texture_by_name_.try_emplace(texture.name, index);
  });
}

void JsonMaterialList::read_materials(JsonValue array) {
  const JsonTextureNames textures = {
      [&](JsonValue value, const std::string& element) { return texture_file_or_index(value, element); },
      [&](JsonValue value, const std::string& element) { return texture_of(value, element); }};
  std::vector<std::pair<int, std::vector<JsonMaterialPart>>> combined; // by the index of the material
  source_.each_object(array, "materials", [&](JsonValue object, const std::string& element) {
    std::vector<JsonMaterialPart> parts;
    const Material material = read_json_material(object, element, textures, parts);
    if (const std::string problem = medium_name_problem(source_.builder.scene(), material.medium);
        !problem.empty())
      throw input_error(object.where(), element + ".medium", problem.substr(0, problem.find("; ")),
                        problem.substr(problem.find("; ") + 2));
    int index = source_.builder.add_material(material);
    auto [same_name, is_new] = material_by_name_.try_emplace(material.name, index);
    if (!is_new) same_name->second = kAmbiguous;
    ++material_count_;
    if (!parts.empty()) combined.emplace_back(index, std::move(parts));
  });
  // Now that all names are known.
  for (const auto& [index, parts] : combined) set_parts(index, parts);
  if (!combined.empty()) check_parts(combined);
}

void JsonMaterialList::set_parts(int material, const std::vector<JsonMaterialPart>& parts) {
  for (const JsonMaterialPart& part : parts)
    source_.builder.set_material_part(material, *part.row, material_of(part.value, part.element));
}

void JsonMaterialList::check_parts(
    const std::vector<std::pair<int, std::vector<JsonMaterialPart>>>& combined) const {
  const auto problem = parts_problem(source_.builder.scene().materials);
  if (!problem) return;
  for (const auto& [index, parts] : combined) {
    if (index != static_cast<int>(problem->material)) continue;
    for (const JsonMaterialPart& part : parts)
      if (part.row->key == problem->key)
        throw input_error(part.value.where(), part.element, problem->cause, problem->remedy);
  }
}

int JsonMaterialList::texture_file_or_index(JsonValue value, const std::string& element) const {
  SceneBuilder& builder = source_.builder;
  if (value.type() == JsonType::number)
    return read_integer(value, element, 0, static_cast<int>(builder.scene().textures.size()) - 1);
  return builder.texture(source_.require_file(value, element));
}

int JsonMaterialList::texture_of(JsonValue value, const std::string& element) const {
  if (value.type() == JsonType::string)
    if (auto named = texture_by_name_.find(value.string()); named != texture_by_name_.end())
      return named->second;
  return texture_file_or_index(value, element);
}

int JsonMaterialList::material_of(JsonValue value, const std::string& element) const {
  // By index only those of the file: the order of imported materials is not specified.
  if (value.type() == JsonType::number) return read_integer(value, element, 0, material_count_ - 1);
  std::string name = read_string(value, element);
  auto known = material_by_name_.find(name);
  if (known != material_by_name_.end() && known->second != kAmbiguous) return known->second;
  if (known != material_by_name_.end())
    throw input_error(value.where(), element,
                      fmt::format("several materials are called '{}'", name.substr(0, 60)),
                      "give the index of the one that you mean");
  std::vector<std::string_view> names;
  for (const auto& [key, index] : material_by_name_) names.push_back(key);
  throw missing_name(value, element, "material", "materials", names);
}

} // namespace candela
