#pragma once

#include "scene/lights/light_model.h"
#include "scene/lights/panorama.h"

#include <memory>

namespace candela {

/// The radiance of a picture from all around. The colour is a factor.
struct EnvironmentLightModel {
  EnvironmentMapping mapping = EnvironmentMapping::latlong;
  float rotation = 0; ///< radians, turns the panorama about `up`, counter-clockwise seen from its tip
  vec3 up{0, 1, 0};   ///< what the panorama's up (its +y) is in the world; any length
  std::shared_ptr<const Panorama> panorama = nullptr;            ///< null: the same from everywhere
  bool operator==(const EnvironmentLightModel&) const = default; ///< the panorama by identity

  static constexpr std::string_view kName = "environment";
  static constexpr std::array<std::string_view, 4> kMappings = {"latlong", "angular", "cross", "faces"};
  static constexpr auto rows() {
    using Row = LightRow<EnvironmentLightModel>;
    return std::array{
        Row{{"mapping", FieldType::choice, 0, 0, "",
             "How the panorama shows the directions: latitude and longitude, Debevec's angular map, the "
             "cross of a "
             "cube, its six faces",
             Invalidates::scene, kMappings},
            &EnvironmentLightModel::mapping},
        Row{{"rotation", FieldType::angle, -360, 360, "degrees",
             "Turns the panorama about its up axis, counter-clockwise seen from above", Invalidates::scene},
            &EnvironmentLightModel::rotation},
        Row{{"up", FieldType::point, -kAnyCoordinate, kAnyCoordinate, "",
             "The direction that is up in the panorama", Invalidates::scene},
            &EnvironmentLightModel::up},
    };
  }
  std::string problem() const;
};

} // namespace candela
