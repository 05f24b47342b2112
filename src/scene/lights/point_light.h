#pragma once

#include "scene/lights/light_model.h"

namespace candela {

/// A point that sends the same to everywhere. The colour is its intensity, W/sr.
struct PointLightModel {
  vec3 position{0};
  /// Coefficients a, b, c: at the distance r the irradiance on a facing surface is intensity / (a + b r + c
  /// r^2). Anything but (0, 0, 1) is not physical.
  vec3 attenuation{0, 0, 1};
  bool operator==(const PointLightModel&) const = default;

  static constexpr std::string_view kName = "point";
  static constexpr auto rows() {
    using Row = LightRow<PointLightModel>;
    return std::array{Row{position_row(), &PointLightModel::position},
                      Row{attenuation_row(), &PointLightModel::attenuation}};
  }
  std::string problem() const {
    return is_zero(attenuation) ? "attenuation: is zero; give 0 0 1 for 1 / r^2" : "";
  }
};

} // namespace candela
