#pragma once

#include "scene/lights/light_model.h"

namespace candela {

/// A point that sends light into a cone. The colour is the intensity on its axis, W/sr.
struct SpotLightModel {
  vec3 position{0};
  vec3 direction{0, -1, 0}; ///< the axis, any length
  /// Half the opening angle, radians: no light beyond it. Full intensity within beam_width of the axis,
  /// falling linearly with the angle between the two, as in Mitsuba; a wider beam is cut off sharply.
  float cutoff_angle = radians(20.0f);
  float beam_width = radians(15.0f);
  vec3 attenuation{0, 0, 1}; ///< as PointLightModel has it
  bool operator==(const SpotLightModel&) const = default;

  static constexpr std::string_view kName = "spot";
  static constexpr auto rows() {
    using Row = LightRow<SpotLightModel>;
    return std::array{
        Row{position_row(), &SpotLightModel::position},
        Row{direction_row("The axis: the light travels along it"), &SpotLightModel::direction},
        Row{{"cutoff_angle", FieldType::angle, 0.01, 180, "degrees",
             "Angle from the axis beyond which there is no light", Invalidates::scene},
            &SpotLightModel::cutoff_angle},
        Row{{"beam_width", FieldType::angle, 0, 180, "degrees",
             "Angle from the axis up to which the intensity is full; from there it falls to the cutoff",
             Invalidates::scene},
            &SpotLightModel::beam_width},
        Row{attenuation_row(), &SpotLightModel::attenuation},
    };
  }
  std::string problem() const {
    if (is_zero(direction)) return "direction: has no length; give a direction";
    return is_zero(attenuation) ? "attenuation: is zero; give 0 0 1 for 1 / r^2" : "";
  }
};

} // namespace candela
