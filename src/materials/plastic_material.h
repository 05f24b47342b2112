#pragma once

#include "bsdf/plastic.h"
#include "materials/facet_rows.h"

namespace candela {

/// Coloured matter under a clear coat, smooth or rough: plastic, lacquer, glazed china.
struct PlasticMaterial {
  ColorParameter diffuse = vec3(0.5f);
  ColorParameter specular = vec3(1);
  NumberParameter ior = 1.5f;
  NumberParameter roughness = 0.0f;
  int distribution = static_cast<int>(MicrofacetDistribution::ggx);
  bool nonlinear = false;
  bool operator==(const PlasticMaterial&) const = default;

  static constexpr std::string_view kName = "plastic";
  static constexpr auto rows() {
    using Row = ModelRow<PlasticMaterial>;
    return std::array{
        Row{reflectance_row("diffuse", "Reflectance of the base below the coat"), &PlasticMaterial::diffuse},
        Row{reflectance_row("specular", "Factor of the coat's reflection; 1 for a real coat"),
            &PlasticMaterial::specular, false},
        Row{{"ior", FieldType::real, 1, 3, "", "Index of refraction of the coat, inside over outside"},
            &PlasticMaterial::ior,
            false},
        Row{roughness_row(), &PlasticMaterial::roughness},
        Row{distribution_row(), &PlasticMaterial::distribution},
        Row{{"nonlinear", FieldType::boolean, 0, 0, "",
             "Light that the coat throws back takes the base's colour again: more saturated, and darker"},
            &PlasticMaterial::nonlinear},
    };
  }
  Plastic closure(const auto& at) const {
    const auto type = static_cast<MicrofacetDistribution>(distribution);
    const float rough = at(roughness), index = std::clamp(float(at(ior)), 1.0f, CoatAlbedo::kMaxEta);
    return {at(diffuse),
            at(specular),
            index,
            nonlinear,
            Microfacets::of_roughness(rough, 0, type),
            rough == 0 ? nullptr : &CoatAlbedo::of(type)};
  }
};

} // namespace candela
