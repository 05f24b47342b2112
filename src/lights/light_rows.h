#pragma once
// What the description of a light in a scene offers, its model. One model is one file of this folder, and an
// entry of the list in lights/light.h.
//
//   kName      what files call it
//   kHelp      where its light comes from, in a few words
//   kColor     the row of LightDesc::color (see color_row()), in the unit of the model
//   rows()     a std::array of LightRow, one for each of its values
//   problem()  what the rows cannot check: "key: cause; remedy"; empty if all is well
//
// and light_of(model, color, maps), the light as transport samples it (lights/light.h has what that offers).
//
// A model with a place has a `position` in world space, which the viewer can move.

#include "core/fields.h"

#include <array>
#include <functional>
#include <string>
#include <variant>

namespace candela {

/// Where a panorama has which direction; see lights/environment_map.h for the axes.
enum class EnvironmentMapping : int { latlong, angular, cross, faces };

class EnvironmentMap;
struct EnvironmentLightModel;
/// Makes the map of a model that has a panorama; the caller does not own it.
using EnvironmentMapSource = std::function<const EnvironmentMap*(const EnvironmentLightModel&)>;

/// The row of one value of a model.
template <class Model>
struct LightRow : FieldInfo {
  std::variant<vec3 Model::*, float Model::*, EnvironmentMapping Model::*> member;
};

/// Whether a direction has no length, or the coefficients of a fall-off are all zero.
inline bool is_zero(vec3 v) { return !(glm::length(v) > 0); }

// The rows that several models share.

inline constexpr double kAnyCoordinate = std::numeric_limits<double>::infinity();

constexpr FieldInfo color_row(std::string_view unit, std::string_view help) {
  return {"color", FieldType::color, 0, 1e9, unit, help, Invalidates::scene, {}, true};
}
constexpr FieldInfo position_row() {
  return {"position", FieldType::point,     -kAnyCoordinate,   kAnyCoordinate,
          "",         "Where the light is", Invalidates::scene};
}
constexpr FieldInfo direction_row(std::string_view help) {
  return {"direction", FieldType::point, -kAnyCoordinate, kAnyCoordinate, "", help, Invalidates::scene};
}
constexpr FieldInfo attenuation_row() {
  return {"attenuation",
          FieldType::point,
          0,
          1e9,
          "",
          "a b c: the intensity is divided by a + b r + c r^2 at the distance r; 0 0 1 is physical",
          Invalidates::scene};
}

} // namespace candela
