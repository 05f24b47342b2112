#pragma once

#include "bsdf/thin_dielectric.h"
#include "materials/material_model.h"

namespace candela {

/// Window pane: reflects at both faces, and lets the rest pass straight.
struct ThinDielectricMaterial {
  NumberParameter ior = 1.5f; ///< of the sheet over both sides
  ColorParameter specular_reflectance = vec3(1);
  ColorParameter specular_transmittance = vec3(1);
  bool operator==(const ThinDielectricMaterial&) const = default;

  static constexpr std::string_view kName = "thin_dielectric";
  static constexpr auto rows() {
    using Row = ModelRow<ThinDielectricMaterial>;
    return std::array{
        Row{{"ior", FieldType::real, 0.1, 10, "", "Index of refraction, of the sheet over both sides"},
            &ThinDielectricMaterial::ior},
        Row{reflectance_row("specular_reflectance", "Tint of what is reflected; 1 for real glass"),
            &ThinDielectricMaterial::specular_reflectance},
        Row{reflectance_row("specular_transmittance", "Tint of what passes straight through"),
            &ThinDielectricMaterial::specular_transmittance},
    };
  }
  ThinDielectric closure(const auto& at) const {
    return {at(ior), at(specular_reflectance), at(specular_transmittance)};
  }
};

} // namespace candela
