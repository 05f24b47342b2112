#pragma once

#include "bsdf/diffuse.h"
#include "materials/material_model.h"

namespace candela {

/// Matte: reflects equally in all directions (Lambert).
struct DiffuseMaterial {
  ColorParameter diffuse = vec3(0.5f); ///< reflectance
  bool operator==(const DiffuseMaterial&) const = default;

  static constexpr std::string_view kName = "diffuse";
  static constexpr auto rows() {
    return std::array{ModelRow<DiffuseMaterial>{reflectance_row("diffuse", "Lambertian reflectance"),
                                                &DiffuseMaterial::diffuse}};
  }
  Diffuse closure(const auto& at) const { return {at(diffuse)}; }
};

} // namespace candela
