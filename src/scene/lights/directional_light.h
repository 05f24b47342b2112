#pragma once

#include "scene/lights/light_model.h"

namespace candela {

/// Parallel light from afar. The colour is the irradiance on a surface that faces it, W/m^2.
struct DirectionalLightModel {
  vec3 direction{0, -1, 0}; ///< along which the light travels, any length
  bool operator==(const DirectionalLightModel&) const = default;

  static constexpr std::string_view kName = "directional";
  static constexpr auto rows() {
    return std::array{LightRow<DirectionalLightModel>{
        direction_row("The direction in which the light travels"), &DirectionalLightModel::direction}};
  }
  std::string problem() const {
    return is_zero(direction) ? "direction: has no length; give a direction" : "";
  }
};

} // namespace candela
