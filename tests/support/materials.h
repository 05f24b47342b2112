#pragma once
// Values of materials by key, for tests.

#include "materials/material.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace candela::test {

inline Material material_of_type(std::string_view name) {
  const auto names = material_type_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::out_of_range(std::string(name));
  return default_material(static_cast<int>(found - names.begin()));
}

inline bool has(const Material& material, std::string_view key) {
  return find_material_field(material_type(material), key) != nullptr;
}

/// Throws if the material's type has no such key.
inline void* value_of(const Material& material, std::string_view key) {
  const MaterialField* row = find_material_field(material_type(material), key);
  if (row == nullptr) throw std::out_of_range(std::string(key));
  return row->address(const_cast<Material&>(material));
}
inline vec3& color(Material& material, std::string_view key) {
  return *static_cast<vec3*>(value_of(material, key));
}
inline const vec3& color(const Material& material, std::string_view key) {
  return *static_cast<const vec3*>(value_of(material, key));
}
inline float& number(Material& material, std::string_view key) {
  return *static_cast<float*>(value_of(material, key));
}
inline const float& number(const Material& material, std::string_view key) {
  return *static_cast<const float*>(value_of(material, key));
}

/// The texture use of a parameter; an unused one if the type has no such key.
inline TextureUse& use_of(Material& material, std::string_view key = "diffuse") {
  static TextureUse none;
  none = {};
  const ParameterRef parameter = find_parameter(material, key);
  return parameter ? parameter.use() : none;
}
inline const TextureUse& use_of(const Material& material, std::string_view key = "diffuse") {
  return use_of(const_cast<Material&>(material), key);
}

/// For values that only some types have.
inline void set_if_there(Material& material, std::string_view key, vec3 value) {
  if (has(material, key)) color(material, key) = value;
}
inline void set_if_there(Material& material, std::string_view key, float value) {
  if (has(material, key)) number(material, key) = value;
}

} // namespace candela::test
