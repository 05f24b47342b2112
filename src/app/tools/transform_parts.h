#pragma once
// A transform as the user types it: position, rotation, scale.

#include "core/math.h"

namespace candela {

/// world_from_object = translate(position) rotate_z rotate_y rotate_x scale, as Blender's XYZ Euler angles.
struct TransformParts {
  vec3 position{0};
  vec3 rotation{0}; ///< degrees about x, y, z
  vec3 scale{1};    ///< a negative x mirrors
  bool operator==(const TransformParts&) const = default;
};

/// The parts whose product is nearest: exact but for rounding unless the matrix shears.
TransformParts transform_parts(const mat4& matrix);
mat4 transform_of(const TransformParts& parts);

/// Another rotation and scale for what `before` places, such that the point `middle` of the object's own
/// space stays where it is: what handles turn and scale about, too.
TransformParts about_middle(const mat4& before, TransformParts parts, vec3 middle);

/// Whether the matrix shears, so that no parts make it.
bool has_shear(const mat4& matrix);

} // namespace candela
