#pragma once
// Materials of every model (materials/material_list.h) and their rows.

#include "materials/material_list.h"
#include "media/homogeneous_medium.h"

#include <optional>
#include <string>

namespace candela {

inline constexpr int kMaterialTypeCount = static_cast<int>(std::variant_size_v<MaterialModel>);

/// The flat normal, and texels that are not encoded.
inline ColorParameter standard_normal_map() {
  ColorParameter flat = vec3(0.5f, 0.5f, 1);
  flat.use.color_space = ColorSpace::linear;
  return flat;
}

struct Material {
  std::string name;
  MaterialModel model;
  NumberParameter opacity = 1.0f;                    ///< share of the light that interacts with the surface
  ColorParameter emission = vec3(0);                 ///< radiance, W/(m^2 sr)
  ColorParameter normal_map = standard_normal_map(); ///< tangent space, (n + 1) / 2; a constant is no map
  NumberParameter bump = 0.0f;                       ///< height, scene units; a constant is no map
  bool two_sided_emission = false;                   ///< otherwise only from the side of the geometric normal
  std::string group{};                               ///< of lights that its emission belongs to; empty: none
  std::string medium{};                              ///< of the scene, that fills the body; empty: none
  bool operator==(const Material&) const = default;
};

/// A row of a material of one type.
struct MaterialField : Field<Material> {
  /// The parameter whose constant `address` is; null where it is a plain value.
  ParameterRef (*parameter)(Material&) = nullptr;
  bool kept = true; ///< as ModelRow has it
};

/// A choice over an int, the type by its index in the list: for files and panels.
const FieldInfo& material_type_field();
std::span<const std::string_view> material_type_names();
/// The first of them, those of ScatteringModel.
std::span<const std::string_view> scattering_type_names();
inline int material_type(const Material& material) { return static_cast<int>(material.model.index()); }
inline std::string_view material_type_name(const Material& material) {
  return material_type_names()[material.model.index()];
}

/// Whether surfaces of it are not there, but for the body that they bound.
inline bool is_null(const Material& material) { return std::holds_alternative<NullMaterial>(material.model); }

/// A material of the type with default values.
Material default_material(int type);
/// Changes the type. Values that both types have (ModelRow::kept) stay, the others become the new type's
/// defaults.
void change_type(Material& material, int type);

/// The rows of a material's values: those of its type, then those of all. The addresses are those in a
/// Material of this type.
std::span<const MaterialField> material_fields(int type);
inline std::span<const MaterialField> material_fields(const Material& material) {
  return material_fields(material_type(material));
}
/// The rows that all types have.
std::span<const MaterialField> common_material_fields();
/// Null where the type has no such key.
const MaterialField* find_material_field(int type, std::string_view key);
/// The parameter of that key; empty where the type has none, or a plain value.
ParameterRef find_parameter(Material& material, std::string_view key);

/// Whether any parameter is a texture.
bool is_textured(const Material& material);
/// Calls visit(row, parameter) for each parameter.
template <class M, class Visit>
void each_parameter(M& material, Visit visit) {
  for (const MaterialField& row : material_fields(material))
    if (row.parameter != nullptr) visit(row, row.parameter(const_cast<Material&>(material)));
}

/// The body that a surface bounds.
struct Interior {
  vec3 absorption{0}; ///< absorption coefficient sigma_a, 1/scene unit
  float ior = 1;      ///< index of refraction over vacuum or over the outside; of a textured one, its factor
  int priority = 0;   ///< as MediumId has it
  std::string medium{}; ///< Material::medium
  /// What the model fills it with, with the absorption in it; nothing where `medium` names something.
  std::optional<HomogeneousMedium> matter{};
};
/// Of the model alone; nothing if no light enters the surface.
std::optional<Interior> interior(const MaterialModel& model);

/// Calls use(closure) with the closure (bsdf/) of the model, at(parameter) being a parameter's value.
template <class At, class Use>
decltype(auto) with_closure(const MaterialModel& model, const At& at, Use use) {
  return std::visit([&](const auto& m) -> decltype(auto) { return use(m.closure(at)); }, model);
}

/// The first value that does not fit its row, or a missing texture: "roughness: …"; empty if all is well.
std::string material_problem(const Material& material, std::size_t texture_count);

} // namespace candela
