#pragma once

#include "bsdf/oren_nayar.h"
#include "materials/material_model.h"

namespace candela {

namespace detail {

inline constexpr std::array<std::string_view, 3> kOrenNayarModelNames{"eon", "fujii", "oren_nayar"};

} // namespace detail

/// Rough matte surfaces, as clay or the moon: flatter than Lambert's.
struct OrenNayarMaterial {
  ColorParameter diffuse = vec3(0.5f);
  NumberParameter roughness = 0.5f;
  int model = static_cast<int>(OrenNayarModel::eon);
  bool operator==(const OrenNayarMaterial&) const = default;

  static constexpr std::string_view kName = "oren_nayar";
  static constexpr auto rows() {
    using Row = ModelRow<OrenNayarMaterial>;
    return std::array{
        Row{reflectance_row("diffuse", "Reflectance"), &OrenNayarMaterial::diffuse},
        Row{{"roughness", FieldType::real, 0, 1, "",
             "Standard deviation of the facets' slope angle in radians; 0 is Lambertian, more looks flatter"},
            &OrenNayarMaterial::roughness,
            false},
        Row{{"model", FieldType::choice, 0, 0, "",
             "eon keeps all energy (Portsmouth et al. 2025), fujii loses what is scattered more than once, "
             "oren_nayar is the qualitative model of 1994",
             Invalidates::image, detail::kOrenNayarModelNames},
            &OrenNayarMaterial::model},
    };
  }
  OrenNayar closure(const auto& at) const {
    return {at(diffuse), at(roughness), static_cast<OrenNayarModel>(model)};
  }
};

} // namespace candela
