#pragma once

#include "lights/constant_light.h"

namespace candela {

/// An opening through which the light of the surroundings comes into a room: no light of its own, but where
/// to sample that of others.
struct PortalLightModel {
  vec3 position{0};
  vec3 direction{0, 0, -1};    ///< into the room, any length
  float roll = 0;              ///< radians, clockwise as seen from outside
  float width = 1, height = 1; ///< scene units
  bool operator==(const PortalLightModel&) const = default;

  static constexpr std::string_view kName = "portal";
  static constexpr std::string_view kHelp =
      "a window or another opening, through which environments, skies and constant lights are sampled";
  static constexpr FieldInfo kColor =
      color_row("", "Black closes the portal; otherwise without effect: a portal does not change the light");
  static constexpr auto rows() {
    using Row = LightRow<PortalLightModel>;
    constexpr double kLeast = 1e-6, kMost = 1e6;
    return std::array{
        Row{{"position", FieldType::point, -kAnyCoordinate, kAnyCoordinate, "", "The middle of the opening",
             Invalidates::scene},
            &PortalLightModel::position},
        Row{direction_row("Into the room, perpendicular to the opening"), &PortalLightModel::direction},
        Row{roll_row("Turns the opening clockwise, as seen from outside; at 0 its height is upright, and of "
                     "one in a floor or ceiling it lies along z"),
            &PortalLightModel::roll},
        Row{{"width", FieldType::real, kLeast, kMost, "scene units", "Of the opening", Invalidates::scene},
            &PortalLightModel::width},
        Row{{"height", FieldType::real, kLeast, kMost, "scene units", "Of the opening", Invalidates::scene},
            &PortalLightModel::height},
    };
  }
  std::string problem() const {
    return is_zero(direction) ? "direction: has no length; give a direction" : "";
  }
};

/// The opening as lights are sampled through it.
inline PortalRectangle portal_rectangle(const PortalLightModel& m) {
  const glm::dvec3 inwards = glm::normalize(glm::dvec3(m.direction));
  glm::dvec3 x = glm::cross(inwards, glm::dvec3(0, 1, 0));
  x = glm::length(x) > 1e-6 ? glm::normalize(x) : glm::dvec3(1, 0, 0);
  const glm::dvec3 y = glm::cross(x, inwards);
  const auto roll = static_cast<double>(m.roll);
  PortalRectangle p;
  p.center = m.position;
  p.axes.x = vec3(std::cos(roll) * x - std::sin(roll) * y);
  p.axes.y = vec3(std::cos(roll) * y + std::sin(roll) * x);
  p.axes.outwards = vec3(-inwards);
  p.half_size = 0.5f * vec2(m.width, m.height);
  return p;
}

/// None: the portals of a scene are given to the lights that come through them.
inline std::array<ConstantLight, 0> light_of(const PortalLightModel&, Spectrum, const LightResources&) {
  return {};
}

} // namespace candela
