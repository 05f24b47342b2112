#pragma once

#include "bsdf/sheen.h"
#include "materials/material_model.h"

namespace candela {

/// Velvet and other cloth: a soft gleam at grazing angles over a matte base.
struct SheenMaterial {
  ColorParameter diffuse = vec3(0.5f);
  ColorParameter sheen = vec3(0.5f);
  NumberParameter roughness = 0.3f;
  bool operator==(const SheenMaterial&) const = default;

  static constexpr std::string_view kName = "sheen";
  static constexpr auto rows() {
    using Row = ModelRow<SheenMaterial>;
    return std::array{
        Row{reflectance_row("diffuse", "Lambertian reflectance of the base"), &SheenMaterial::diffuse},
        Row{reflectance_row("sheen", "Colour and strength of the fibres' gleam"), &SheenMaterial::sheen},
        Row{{"roughness", FieldType::real, SheenAlbedo::kMinRoughness, 1, "",
             "Roughness of the fibres: little gleams at the rim alone, much is dusty all over"},
            &SheenMaterial::roughness,
            false},
    };
  }
  Sheen closure(const auto& at) const {
    return {at(diffuse), at(sheen), std::clamp(float(at(roughness)), SheenAlbedo::kMinRoughness, 1.0f)};
  }
};

} // namespace candela
