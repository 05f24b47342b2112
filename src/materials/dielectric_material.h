#pragma once

#include "bsdf/dielectric.h"
#include "materials/interior_rows.h"

namespace candela {

/// Smooth glass: Fresnel reflection and refraction, and a body that may absorb.
struct DielectricMaterial {
  NumberParameter ior = 1.5f;             ///< inside over outside; with a priority, over vacuum
  ColorParameter transmittance = vec3(1); ///< tint of each crossing of the surface
  vec3 absorption{0};                     ///< of the inside: sigma_a, 1/scene unit (Beer-Lambert)
  int priority = 0;                       ///< as MediumId has it
  bool operator==(const DielectricMaterial&) const = default;

  static constexpr std::string_view kName = "dielectric";
  static constexpr auto rows() {
    using Row = ModelRow<DielectricMaterial>;
    return std::array{
        Row{interior_ior_row(), &DielectricMaterial::ior},
        Row{crossing_row(), &DielectricMaterial::transmittance},
        Row{absorption_row(), &DielectricMaterial::absorption},
        Row{priority_row(), &DielectricMaterial::priority},
    };
  }
  Dielectric closure(const auto& at) const { return {at(ior), at(transmittance)}; }
};

} // namespace candela
