#pragma once
// Lights without a shape, of every model (lights/light.h), and their rows; shapes shine by their material's
// emission.

#include "lights/light.h"

#include <span>
#include <vector>

namespace candela {

inline constexpr int kLightTypeCount = static_cast<int>(std::variant_size_v<LightDescModel>);

struct LightDesc {
  std::string name;
  LightDescModel model;
  vec3 color{1};         ///< in the unit of the model's kColor
  float scale = 1;       ///< multiplies color
  float temperature = 0; ///< kelvin; if not 0, multiplies color by that of a black body whose luminance is 1
  std::string group{};   ///< name of the LightGroup that it belongs to; empty: none
  bool operator==(const LightDesc&) const = default; ///< panoramas and profiles by identity
};

/// A choice over an int, the type by its index in the list: for files and panels.
const FieldInfo& light_type_field();
std::span<const std::string_view> light_type_names();
inline int light_type(const LightDesc& light) { return static_cast<int>(light.model.index()); }
inline std::string_view light_type_name(const LightDesc& light) {
  return light_type_names()[light.model.index()];
}

/// A light of the type with default values.
LightDesc default_light(int type);
/// Changes the type. Values of the same key stay, the others become the new type's defaults.
void change_type(LightDesc& light, int type);

/// The rows of a light's values: those of its type, then those of all. The addresses are those in a LightDesc
/// of this type.
std::span<const Field<LightDesc>> light_fields(int type);
inline std::span<const Field<LightDesc>> light_fields(const LightDesc& light) {
  return light_fields(light_type(light));
}

/// The light's position in world space; null if its model has none.
const vec3* light_position(const LightDesc& light);
vec3* light_position(LightDesc& light);
/// The light's panorama or other picture, if it has one; and whether it may have one.
std::shared_ptr<const Panorama> light_panorama(const LightDesc& light);
bool takes_panorama(const LightDesc& light);
/// Sets it in a light that may have one.
void set_panorama(LightDesc& light, std::shared_ptr<const Panorama> panorama);
/// The same of photometric files.
std::shared_ptr<const IesProfile> light_profile(const LightDesc& light);
bool takes_profile(const LightDesc& light);
void set_profile(LightDesc& light, std::shared_ptr<const IesProfile> profile);

/// What the colour, scale and temperature give, in the unit of the model's kColor.
Spectrum light_color(const LightDesc& light);

/// The lights as transport samples them; a sky is two. They point into the description, which must live as
/// long, and to what the resources have made.
std::vector<Light> make_lights(const LightDesc& light, const LightResources& resources);

/// The first value that does not fit its row or the model: "key: cause; remedy"; empty if all is well. Does
/// not read a panorama's pixels; see panorama_problem().
std::string light_problem(const LightDesc& light);

} // namespace candela
