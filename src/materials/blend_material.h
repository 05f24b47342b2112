#pragma once

#include "materials/blend.h"
#include "materials/material_model.h"

namespace candela {

/// The row of a material that another one refers to.
constexpr FieldInfo material_row(std::string_view key, std::string_view help) {
  return {key, FieldType::material, -1, 2147483647, "", help, Invalidates::scene};
}

/// Two materials of the scene in one surface, such as rust on steel: f = (1 - weight) f_first + weight
/// f_second. Of them it has how they scatter; opacity, emission, normal map and bump are its own, and the
/// body inside is that of the first that has one.
struct BlendMaterial {
  int first = -1, second = -1; ///< of the scene's materials; none absorbs all light
  NumberParameter weight = 0.5f;
  bool operator==(const BlendMaterial&) const = default;

  static constexpr std::string_view kName = "blend";
  static constexpr auto rows() {
    using Row = ModelRow<BlendMaterial>;
    return std::array{
        Row{material_row("first",
                         "The material where the weight is 0; without one, black. The blend has its own "
                         "opacity, emission, normal map and bump"),
            &BlendMaterial::first},
        Row{material_row("second", "The material where the weight is 1; without one, black"),
            &BlendMaterial::second},
        Row{{"weight", FieldType::real, 0, 1, "", "Share of the second material"}, &BlendMaterial::weight},
    };
  }
  /// Its parts are known to the scene alone (render/world/surface_material.h).
  Blend closure(const auto&) const { return {}; }
};

} // namespace candela
