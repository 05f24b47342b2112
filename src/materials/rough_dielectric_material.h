#pragma once

#include "bsdf/rough_dielectric.h"
#include "materials/facet_rows.h"
#include "materials/interior_rows.h"

namespace candela {

/// Frosted glass: a rough interface between dielectrics, and a body that may absorb.
struct RoughDielectricMaterial {
  NumberParameter ior = 1.5f;             ///< inside over outside; with a priority, over vacuum
  ColorParameter transmittance = vec3(1); ///< tint of each crossing of the surface
  NumberParameter roughness = 0.3f;       ///< alpha = roughness^2; 0: smooth
  int distribution = static_cast<int>(MicrofacetDistribution::ggx);
  bool energy_compensation = true;
  vec3 absorption{0}; ///< of the inside: sigma_a, 1/scene unit (Beer-Lambert)
  int priority = 0;   ///< as MediumId has it
  bool operator==(const RoughDielectricMaterial&) const = default;

  static constexpr std::string_view kName = "rough_dielectric";
  static constexpr auto rows() {
    using Row = ModelRow<RoughDielectricMaterial>;
    return std::array{
        Row{interior_ior_row(), &RoughDielectricMaterial::ior},
        Row{crossing_row(), &RoughDielectricMaterial::transmittance},
        Row{roughness_row(), &RoughDielectricMaterial::roughness},
        Row{distribution_row(), &RoughDielectricMaterial::distribution},
        Row{compensation_row(), &RoughDielectricMaterial::energy_compensation},
        Row{absorption_row(), &RoughDielectricMaterial::absorption},
        Row{priority_row(), &RoughDielectricMaterial::priority},
    };
  }
  RoughDielectric closure(const auto& at) const {
    const auto type = static_cast<MicrofacetDistribution>(distribution);
    const float rough = at(roughness), index = at(ior);
    return {index, at(transmittance), Microfacets::of_roughness(rough, 0, type),
            rough == 0 || RoughDielectric::is_invisible(index),
            energy_compensation && rough > 0 ? &InterfaceAlbedo::of(type) : nullptr};
  }
};

} // namespace candela
