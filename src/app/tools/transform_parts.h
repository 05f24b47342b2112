#pragma once
// A transform as position, rotation and scale, which the user can type.

#include "core/math.h"

namespace candela {

/// world_from_object = translate(position) rotate_z rotate_y rotate_x scale, as Blender's XYZ Euler angles.
struct TransformParts {
  vec3 position{0};
  vec3 rotation{0}; ///< degrees about x, y, z
  vec3 scale{1};    ///< a negative x mirrors
  bool operator==(const TransformParts&) const = default;
};

/// The parts whose product is nearest to the matrix: exact up to rounding unless it shears.
TransformParts transform_parts(const mat4& matrix);
mat4 transform_of(const TransformParts& parts);

/// Replaces the rotation and scale of `before` such that the point `middle` in object space keeps its world
/// position, as the handles do.
TransformParts about_middle(const mat4& before, TransformParts parts, vec3 middle);

/// Whether the matrix shears, so that it has no exact parts.
bool has_shear(const mat4& matrix);

} // namespace candela
