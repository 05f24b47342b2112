#pragma once

#include "bsdf/blinn.h"
#include "materials/material_model.h"

namespace candela {

/// Matte with a glossy lobe about the half vector.
struct BlinnMaterial {
  ColorParameter diffuse = vec3(0.5f);
  ColorParameter specular = vec3(0.2f); ///< reflectance of the lobe
  NumberParameter exponent = 160.0f;
  bool operator==(const BlinnMaterial&) const = default;

  static constexpr std::string_view kName = "blinn";
  static constexpr auto rows() {
    using Row = ModelRow<BlinnMaterial>;
    return std::array{
        Row{reflectance_row("diffuse", "Lambertian reflectance"), &BlinnMaterial::diffuse},
        Row{reflectance_row("specular", "Specular reflectance"), &BlinnMaterial::specular},
        Row{{"exponent",
             FieldType::real,
             0,
             1e6,
             "",
             "Exponent of the Blinn lobe: higher is sharper; a Phong lobe as wide has about a quarter",
             Invalidates::image,
             {},
             true},
            &BlinnMaterial::exponent,
            false},
    };
  }
  /// No reflection gives back more than it got: where both lobes ask for more than 1, the diffuse one gives
  /// in.
  Blinn closure(const auto& at) const {
    const vec3 gloss = at(specular);
    return {glm::min(at(diffuse), 1.0f - gloss), gloss, at(exponent)};
  }
};

} // namespace candela
