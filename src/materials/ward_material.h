#pragma once

#include "bsdf/turned.h"
#include "bsdf/ward.h"
#include "materials/material_model.h"

namespace candela {

/// Matte with a highlight that may be longer one way than the other: brushed metal, satin.
struct WardMaterial {
  ColorParameter diffuse = vec3(0.5f);
  ColorParameter specular = vec3(0.2f); ///< reflectance of the lobe
  NumberParameter alpha_u = 0.1f, alpha_v = 0.1f;
  bool operator==(const WardMaterial&) const = default;

  static constexpr std::string_view kName = "ward";
  static constexpr auto rows() {
    using Row = ModelRow<WardMaterial>;
    constexpr auto alpha_row = [](std::string_view key, std::string_view help) {
      return FieldInfo{key, FieldType::real, 1e-3, 1, "", help};
    };
    return std::array{
        Row{reflectance_row("diffuse", "Lambertian reflectance"), &WardMaterial::diffuse},
        Row{reflectance_row("specular", "Specular reflectance"), &WardMaterial::specular},
        Row{alpha_row("alpha_u", "Roughness along dp/du: root mean square slope times sqrt(2)"),
            &WardMaterial::alpha_u},
        Row{alpha_row("alpha_v", "Roughness along dp/dv: root mean square slope times sqrt(2)"),
            &WardMaterial::alpha_v},
    };
  }
  /// No reflection gives back more than it got: where both lobes ask for more than 1, the diffuse one gives
  /// in.
  Turned<Ward> closure(const auto& at) const {
    const vec3 gloss = at(specular);
    constexpr float least = Microfacets::kMinAlpha;
    return {{glm::min(at(diffuse), 1.0f - gloss), gloss, std::max(float(at(alpha_u)), least),
             std::max(float(at(alpha_v)), least)},
            {1, 0}};
  }
};

} // namespace candela
