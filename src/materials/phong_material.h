#pragma once

#include "bsdf/phong.h"
#include "materials/material_model.h"

namespace candela {

/// Matte with a glossy lobe about the mirror direction.
struct PhongMaterial {
  ColorParameter diffuse = vec3(0.5f);
  ColorParameter specular = vec3(0); ///< reflectance of the lobe
  NumberParameter exponent = 40.0f;
  bool operator==(const PhongMaterial&) const = default;

  static constexpr std::string_view kName = "phong";
  static constexpr auto rows() {
    using Row = ModelRow<PhongMaterial>;
    return std::array{
        Row{reflectance_row("diffuse", "Lambertian reflectance"), &PhongMaterial::diffuse},
        Row{reflectance_row("specular", "Specular reflectance"), &PhongMaterial::specular},
        Row{{"exponent",
             FieldType::real,
             0,
             1e6,
             "",
             "Exponent of the Phong lobe: higher is sharper",
             Invalidates::image,
             {},
             true},
            &PhongMaterial::exponent},
    };
  }
  /// Conserves energy: the diffuse lobe is reduced if the sum exceeds 1.
  Phong closure(const auto& at) const {
    const vec3 gloss = at(specular);
    return {glm::min(at(diffuse), 1.0f - gloss), gloss, at(exponent)};
  }
};

} // namespace candela
