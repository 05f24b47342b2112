#pragma once

#include "bsdf/hair.h"
#include "bsdf/turned.h"
#include "materials/material_model.h"

namespace candela {

/// By which values the absorption of hair is given.
enum class HairAbsorption : int { color, melanin, absorption };

namespace detail {
inline constexpr std::array<std::string_view, 3> kHairAbsorptionNames{"color", "melanin", "absorption"};
} // namespace detail

/// Hair or fur, for curves. A surface that is no curve shows the middle of the fibre (Hair::h = 0).
struct HairMaterial {
  int parametrization = static_cast<int>(HairAbsorption::melanin);
  ColorParameter color = vec3(0.4f, 0.22f, 0.1f);
  NumberParameter eumelanin = 1.3f, pheomelanin = 0.2f;
  ColorParameter sigma_a = vec3(0.06f, 0.1f, 0.2f); ///< 1/radius of the fibre
  NumberParameter beta_m = 0.3f, beta_n = 0.3f;
  NumberParameter alpha = 2.0f; ///< degrees
  NumberParameter ior = 1.55f;  ///< inside over outside
  bool operator==(const HairMaterial&) const = default;

  static constexpr std::string_view kName = "hair";
  static constexpr auto rows() {
    using Row = ModelRow<HairMaterial>;
    return std::array{
        Row{{"parametrization", FieldType::choice, 0, 0, "",
             "What gives the absorption: the colour of many hairs, melanin, or sigma_a itself",
             Invalidates::image, detail::kHairAbsorptionNames},
            &HairMaterial::parametrization},
        Row{reflectance_row("color", "Colour of many hairs together"), &HairMaterial::color},
        Row{{"eumelanin", FieldType::real, 0, 100, "",
             "Concentration of the brown pigment: 0.3 blonde, 1.3 brown, 8 black"},
            &HairMaterial::eumelanin},
        Row{{"pheomelanin", FieldType::real, 0, 100, "", "Concentration of the red pigment"},
            &HairMaterial::pheomelanin},
        Row{{"sigma_a",
             FieldType::color,
             0,
             1e6,
             "1/fibre radius",
             "Absorption coefficient of the inside",
             Invalidates::image,
             {},
             true},
            &HairMaterial::sigma_a},
        Row{{"beta_m", FieldType::real, 0, 1, "", "Roughness along the hair: length of the highlight"},
            &HairMaterial::beta_m},
        Row{{"beta_n", FieldType::real, 0, 1, "",
             "Roughness around the hair: low lets light from behind glow, high is matte"},
            &HairMaterial::beta_n},
        Row{{"alpha", FieldType::real, -20, 20, "degrees",
             "Tilt of the scales: moves the white highlight towards the root, the coloured one to the tip"},
            &HairMaterial::alpha},
        Row{{"ior", FieldType::real, 1, 3, "", "Index of refraction, inside over outside"},
            &HairMaterial::ior,
            false},
    };
  }
  Turned<Hair> closure(const auto& at) const {
    const float azimuthal = std::max(at(beta_n), Hair::kMinBeta);
    const auto given_by = static_cast<HairAbsorption>(parametrization);
    const Spectrum absorption =
        given_by == HairAbsorption::color     ? Hair::absorption_of_color(at(color), azimuthal)
        : given_by == HairAbsorption::melanin ? Hair::absorption_of_melanin(at(eumelanin), at(pheomelanin))
                                              : at(sigma_a);
    return {{absorption, std::max(at(beta_m), Hair::kMinBeta), azimuthal, radians(at(alpha)), at(ior)},
            {1, 0}};
  }
};

} // namespace candela
