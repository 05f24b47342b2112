#pragma once
// The values of rough surfaces that several materials have alike.

#include "bsdf/microfacets.h"
#include "materials/material_model.h"

namespace candela {

inline constexpr std::array<std::string_view, 2> kMicrofacetDistributionNames{"ggx", "beckmann"};

constexpr FieldInfo roughness_row() {
  return {
      "roughness", FieldType::real, 0, 1, "", "Roughness; the microfacet alpha is its square, 0 is smooth"};
}
constexpr FieldInfo anisotropy_row() {
  return {"anisotropy",
          FieldType::real,
          -1,
          1,
          "",
          "Stretches highlights along dp/du, as brushing along dp/dv does; negative: the other way round"};
}
constexpr FieldInfo distribution_row() {
  return {
      "distribution",     FieldType::choice,           0, 0, "", "Distribution of the microfacets' normals",
      Invalidates::image, kMicrofacetDistributionNames};
}
constexpr FieldInfo compensation_row() {
  return {"energy_compensation",
          FieldType::boolean,
          0,
          0,
          "",
          "Give back the light that is scattered more than once between microfacets (Turquin 2019)"};
}

} // namespace candela
