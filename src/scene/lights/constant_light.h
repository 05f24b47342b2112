#pragma once

#include "scene/lights/light_model.h"

namespace candela {

/// The same radiance from all around. The colour is the radiance, W/(m^2 sr).
struct ConstantLightModel {
  bool operator==(const ConstantLightModel&) const = default;

  static constexpr std::string_view kName = "constant";
  static constexpr std::array<LightRow<ConstantLightModel>, 0> rows() { return {}; }
  std::string problem() const { return ""; }
};

} // namespace candela
