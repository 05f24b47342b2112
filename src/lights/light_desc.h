#pragma once
// Lights without a shape, of every model (lights/light.h), and their rows; shapes shine by their material's
// emission.

#include "lights/light.h"

#include <span>

namespace candela {

inline constexpr int kLightTypeCount = static_cast<int>(std::variant_size_v<LightDescModel>);

struct LightDesc {
  std::string name;
  LightDescModel model;
  vec3 color{1};                                     ///< its unit is the model's
  float scale = 1;                                   ///< multiplies color
  bool operator==(const LightDesc&) const = default; ///< panoramas by identity
};

/// A choice over an int, the type by its index in the list: for files and panels.
const FieldInfo& light_type_field();
std::span<const std::string_view> light_type_names();
inline int light_type(const LightDesc& light) { return static_cast<int>(light.model.index()); }
inline std::string_view light_type_name(const LightDesc& light) {
  return light_type_names()[light.model.index()];
}

/// What a light of the type is where nothing else is said.
LightDesc default_light(int type);
/// Another type. Values of the same key stay, the others become the new type's defaults.
void change_type(LightDesc& light, int type);

/// The rows of a light's values: those of its type, then those of all. The addresses are those in a LightDesc
/// of this type.
std::span<const Field<LightDesc>> light_fields(int type);
inline std::span<const Field<LightDesc>> light_fields(const LightDesc& light) {
  return light_fields(light_type(light));
}

/// Where the light is, in world space; null where it is at no place.
const vec3* light_position(const LightDesc& light);
vec3* light_position(LightDesc& light);
/// The picture that it shows, if there is one.
std::shared_ptr<const Panorama> light_panorama(const LightDesc& light);

/// The light as transport samples it; `maps` makes environment maps, or has them.
Light make_light(const LightDesc& light, const EnvironmentMapSource& maps);

/// The first thing that breaks a row, or what the rows cannot say: "key: cause; remedy"; empty where all is
/// well.
std::string light_problem(const LightDesc& light);

} // namespace candela
