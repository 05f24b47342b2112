#pragma once

#include "materials/blend_material.h"

namespace candela {

/// A material of the scene for each side of a surface, such as a leaf's. Of them it has how they scatter, and
/// their normal maps and bumps, where they have any; opacity and emission are its own, for light goes through
/// both sides alike. The body inside is that of the front, or else of the back.
struct TwoSidedMaterial {
  int front = -1, back = -1; ///< of the scene's materials; none absorbs all light
  bool operator==(const TwoSidedMaterial&) const = default;

  static constexpr std::string_view kName = "two_sided";
  static constexpr auto rows() {
    using Row = ModelRow<TwoSidedMaterial>;
    return std::array{
        Row{material_row("front",
                         "The material of the side of the geometric normal; without one, black. Opacity "
                         "and emission are the two-sided material's own"),
            &TwoSidedMaterial::front},
        Row{material_row("back", "The material of the other side; without one, black"),
            &TwoSidedMaterial::back},
    };
  }
  Blend closure(const auto&) const { return {}; }
};

} // namespace candela
