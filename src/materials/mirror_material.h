#pragma once

#include "bsdf/mirror.h"
#include "materials/material_model.h"

namespace candela {

/// Ideal mirror with an optional matte part.
struct MirrorMaterial {
  ColorParameter specular = vec3(1); ///< reflectance
  ColorParameter diffuse = vec3(0);
  bool operator==(const MirrorMaterial&) const = default;

  static constexpr std::string_view kName = "mirror";
  static constexpr auto rows() {
    using Row = ModelRow<MirrorMaterial>;
    return std::array{
        // Not kept when the type changes: here it makes the mirror partly matte.
        Row{reflectance_row("diffuse", "Lambertian reflectance"), &MirrorMaterial::diffuse, false},
        Row{reflectance_row("specular", "Specular reflectance"), &MirrorMaterial::specular},
    };
  }
  /// The diffuse part is reduced if the sum exceeds 1.
  Mirror closure(const auto& at) const {
    const vec3 reflected = at(specular);
    return {reflected, glm::min(at(diffuse), 1.0f - reflected)};
  }
};

} // namespace candela
