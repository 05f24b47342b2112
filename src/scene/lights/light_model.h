#pragma once
// What every model of a light offers. One model is one file of this folder, and an entry of the list in
// scene/lights/light.h.
//
//   kName      what files call it
//   rows()     an std::array of LightRow, one for each of its values
//   problem()  what the rows cannot say: "key: cause; remedy"; empty where all is well
//
// One that is at a place has a `position` in world space, which hands move.

#include "core/fields.h"

#include <array>
#include <string>
#include <variant>

namespace candela {

/// Where a panorama has which direction; see render/lights/environment_map.h for the axes.
enum class EnvironmentMapping : int { latlong, angular, cross, faces };

/// The row of one value of a model.
template <class Model>
struct LightRow : FieldInfo {
  std::variant<vec3 Model::*, float Model::*, EnvironmentMapping Model::*> member;
};

/// Whether a direction or the coefficients of a fall-off say nothing.
inline bool is_zero(vec3 v) { return !(glm::length(v) > 0); }

// The rows that several models have alike.

inline constexpr double kAnyCoordinate = std::numeric_limits<double>::infinity();

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
          "a b c: intensity / (a + b r + c r^2) arrives at the distance r; 0 0 1 is physical",
          Invalidates::scene};
}

} // namespace candela
