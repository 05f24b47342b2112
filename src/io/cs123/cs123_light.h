#pragma once
// The lights of CS123 scenes.

#include "io/builder/scene_builder.h"
#include "io/cs123/cs123_material.h"

namespace candela {

/// The contents of `<lightdata>`; an area light becomes a rectangle.
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

/// Reads `<lightdata>`. Where the format's description is ambiguous:
///
/// - A light without a type is a point light. Its colour is its intensity on its axis (point, spot), its
///   irradiance (directional) or its radiance (area).
/// - `function` a b c divides the intensity of point and spot lights by a + b r + c r^2; without it the light
///   falls off with the square of the distance. An unphysical function is a warning.
/// - `angle` is half the opening angle of a spot in degrees (default 20). The intensity falls off linearly in
///   the angle over the outer `penumbra` degrees of it (default 0).
/// - An area light is a rectangle about its position that faces its direction, `width` wide in the horizontal
///   and `height` in the other direction (along x and z if it faces straight up or down); default 1. It
///   becomes an emitting rectangle, so it is visible in the picture.
///
/// Errors are located at the element or attribute.
Cs123Light read_cs123_light(pugi::xml_node data, const Cs123Values& values);

/// Adds it to the scene's lights, or as an instance with a material of its own.
void add_cs123_light(SceneDesc& scene, SceneBuilder& builder, Cs123Light light);

} // namespace candela
