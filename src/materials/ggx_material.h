#pragma once

#include "bsdf/ggx.h"
#include "materials/material_model.h"

namespace candela {

/// Rough metal: GGX microfacets with Schlick's Fresnel term.
struct GgxMaterial {
  ColorParameter specular = vec3(0); ///< F0, the reflectance at normal incidence
  NumberParameter roughness = 0.3f;  ///< alpha = roughness^2
  bool operator==(const GgxMaterial&) const = default;

  static constexpr std::string_view kName = "ggx";
  static constexpr auto rows() {
    using Row = ModelRow<GgxMaterial>;
    return std::array{
        Row{reflectance_row("specular", "Reflectance at normal incidence"), &GgxMaterial::specular},
        Row{{"roughness", FieldType::real, 0, 1, "", "Roughness of ggx; the microfacet alpha is its square"},
            &GgxMaterial::roughness},
    };
  }
  Ggx closure(const auto& at) const { return {at(specular), at(roughness)}; }
};

} // namespace candela
