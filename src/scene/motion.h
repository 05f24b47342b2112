#pragma once
// How an object moves while the shutter is open.

#include "core/fields.h"
#include "core/moving_transform.h"

#include <span>
#include <string>

namespace candela {

struct Instance;

/// What has happened to an instance by time 1, beside its placement at time 0. It is relative, so that an
/// object that is put elsewhere, or turned, takes its motion along.
struct Motion {
  vec3 translate{0};  ///< world space
  vec3 axis{0, 1, 0}; ///< of rotation: a direction in the object's space, of any length but 0
  float angle = 0;    ///< radians; of several turns, too
  vec3 scale{1};      ///< factors along the object's axes
  vec3 center{0};     ///< in the object's space (of a mesh, its file's): of rotation and scaling
  bool operator==(const Motion&) const = default;

  /// Whether anything moves.
  bool any() const { return translate != vec3(0) || angle != 0 || scale != vec3(1); }
};

std::span<const Field<Motion>> motion_fields();
/// A problem that the rows cannot express: "axis: …"; empty if the motion is valid.
std::string motion_problem(const Motion& motion);

/// The placement of an instance at all times.
MovingTransform placement_of(const Instance& instance);
/// That of one time: Instance::world_from_object where it does not move.
mat4 world_from_object(const Instance& instance, float time);

} // namespace candela
