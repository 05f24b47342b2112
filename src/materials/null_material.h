#pragma once

#include "materials/blend.h"
#include "materials/interior_rows.h"

namespace candela {

/// An invisible surface: light goes straight through, whatever its opacity and emission. It bounds a body
/// that may absorb.
struct NullMaterial {
  vec3 absorption{0}; ///< of the inside: sigma_a, 1/scene unit (Beer-Lambert)
  bool operator==(const NullMaterial&) const = default;

  static constexpr std::string_view kName = "null";
  static constexpr auto rows() {
    return std::array{ModelRow<NullMaterial>{absorption_row(), &NullMaterial::absorption}};
  }
  Blend closure(const auto&) const { return {}; }
};

} // namespace candela
