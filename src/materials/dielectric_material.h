#pragma once

#include "bsdf/dielectric.h"
#include "materials/material_model.h"

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
        Row{{"ior", FieldType::real, 0.1, 10, "",
             "Index of refraction, inside over outside; with a priority, over vacuum"},
            &DielectricMaterial::ior},
        Row{{"transmittance", FieldType::color, 0, 1, "", "Tint of each crossing of the surface"},
            &DielectricMaterial::transmittance},
        Row{{"absorption",
             FieldType::color,
             0,
             1e6,
             "1/scene unit",
             "Absorption coefficient inside (Beer-Lambert): transmittance over d is exp(-absorption d)",
             Invalidates::image,
             {},
             true},
            &DielectricMaterial::absorption},
        Row{{"priority", FieldType::integer, 0, 1000, "",
             "Which body fills the place where several overlap, such as ice in water: the one of highest "
             "priority; surfaces of the others inside it are skipped. With a priority, ior is over vacuum "
             "(of a textured one, its factor). 0: no surface is skipped and ior is inside over outside, as "
             "for emitting surfaces"},
            &DielectricMaterial::priority},
    };
  }
  Dielectric closure(const auto& at) const { return {at(ior), at(transmittance)}; }
};

} // namespace candela
