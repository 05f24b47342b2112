#pragma once
// The lights of CS123 scenes.

#include "io/builder/scene_builder.h"
#include "io/cs123/cs123_material.h"

namespace candela {

/// What `<lightdata>` says; an area light becomes a rectangle.
struct Cs123Light {
  enum class Type { point, directional, spot, area };
  std::string name = "light";
  Type type = Type::point;
  vec3 color{1};
  vec3 position{0}, direction{0, -1, 0};
  vec3 attenuation{0, 0, 1};
  float cutoff_angle = radians(20.0f), beam_width = 0; ///< radians, of a spot
  float width = 1, height = 1;                         ///< of an area light
};

/// Reads `<lightdata>`. Where the format's description leaves room:
///
/// - A light without a type is a point light. Its colour is its intensity on its axis (point, spot), its
///   irradiance (directional) or its radiance (area).
/// - `function` a b c divides the intensity of point and spot lights by a + b r + c r^2; without it light
/// falls
///   off with the square of the distance. One that is not physical is a warning.
/// - `angle` is half the opening angle of a spot in degrees (20 if it is missing), and the light falls off
/// over
///   the outer `penumbra` degrees of it (0 if missing), linearly in the angle.
/// - An area light is a rectangle about its position that faces its direction, `width` wide in the horizontal
///   and `height` in the other direction (along x and z if it looks straight up or down); 1 if missing. It
///   becomes an emitting rectangle, so it is seen in the picture, too.
///
/// Errors are located at the element or attribute.
Cs123Light read_cs123_light(pugi::xml_node data, const Cs123Values& values);

/// Adds it to the scene's lights, or as an instance with a material of its own.
void add_cs123_light(SceneDesc& scene, SceneBuilder& builder, Cs123Light light);

} // namespace candela
