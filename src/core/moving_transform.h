#pragma once
// A placement that changes in time.

#include "core/bounds.h"

namespace candela {

/// From an object to the world at every time in [0, 1]: a scaling along the object's axes, the placement at
/// time 0, a rotation and a translation. Those of time 1 are given, and each is interpolated by itself, the
/// rotation at constant speed about its axis, as by slerp of quaternions (Shoemake and Duff 1992, "Matrix
/// Animation and Polar Decomposition"; pbrt-v4, section 3.10). The angle may be of several turns, which two
/// key frames could not tell.
struct MovingTransform {
  glm::dmat4 world_from_object{1}; ///< at time 0; affine and invertible
  glm::dvec3 pivot{0};             ///< in the object's space: rotation and scaling keep it where it is
  glm::dvec3 translation{0};       ///< world space, by time 1
  glm::dvec3 axis{0, 0, 1};        ///< world space, unit
  double angle = 0;                ///< radians, by time 1
  glm::dvec3 scale{1};             ///< factors by time 1, above 0

  /// World from object.
  glm::dmat4 at(double time) const;

  /// A box that holds the box `object` (in the object's space) at all times: the extremes of the paths of its
  /// corners, which are those of all its points, since these are linear in them. A path is c + v t + R(t)
  /// y(t) with a linear y. Between two times its distance from their chord along an axis is at most h^2 / 8
  /// times the greatest second derivative there, by which the box of sampled points is grown.
  Bounds3 bounds(const Bounds3& object) const;
};

/// About a unit axis, by radians (Rodrigues' formula).
glm::dmat3 rotation_about(const glm::dvec3& axis, double angle);

/// The unit axis and the angle in [0, pi] of a rotation matrix.
struct AxisAngle {
  glm::dvec3 axis{0, 0, 1};
  double angle = 0;
};
AxisAngle axis_angle(const glm::dmat3& rotation);

} // namespace candela
