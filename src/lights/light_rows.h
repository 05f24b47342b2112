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
// and light_of(model, color, resources), the light as transport samples it (lights/light.h has what that
// offers), or a std::variant or a range of such.
//
// A model with a place has a `position` in world space, which the viewer can move; one that shows a picture a
// `panorama`; one that can be shaped by a photometric file a `profile`. Lights point to these: a description
// must live as long as its lights.

#include "core/fields.h"

#include <array>
#include <functional>
#include <string>
#include <variant>

namespace candela {

/// Where a panorama has which direction; see lights/environment_map.h for the axes.
enum class EnvironmentMapping : int { latlong, angular, cross, faces };

/// What the values of a photometric file or goniometric picture are multiplied by, besides the colour.
enum class ProfileStrength : int { file, peak, power };

/// How a sky is told where its sun stands.
enum class SunPlacement : int { angles, place };

class EnvironmentMap;
struct EnvironmentLightModel;
struct SkyModel;
struct SkyParameters;
/// What takes long to make, and serves several lights and edits. The caller of light_of() keeps it.
struct LightResources {
  /// The map of a model that has a panorama.
  std::function<const EnvironmentMap*(const EnvironmentLightModel&)> environment_map;
  std::function<const SkyModel*(const SkyParameters&)> sky;
};

/// The row of one value of a model.
template <class Model>
struct LightRow : FieldInfo {
  std::variant<vec3 Model::*, float Model::*, int Model::*, EnvironmentMapping Model::*,
               ProfileStrength Model::*, SunPlacement Model::*>
      member;
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
constexpr FieldInfo roll_row(std::string_view help) {
  return {"roll", FieldType::angle, -360, 360, "degrees", help, Invalidates::scene};
}
inline constexpr std::array<std::string_view, 3> kProfileStrengths = {"file", "peak", "power"};
constexpr FieldInfo profile_strength_row() {
  return {
      "strength",
      FieldType::choice,
      0,
      0,
      "",
      "With a file: the colour multiplies its values (candela over 110 lm/W, a picture's as they are), or is "
      "the radiant intensity at its peak, or the power in W of all directions",
      Invalidates::scene,
      kProfileStrengths};
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
