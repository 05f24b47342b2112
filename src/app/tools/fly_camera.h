#pragma once
// Flight: how a camera moves and turns with input. Pure functions of the camera.

#include "core/bounds.h"
#include "scene/scene_desc.h"

#include <string>

namespace candela {

/// The current input of the keys; each component in [-1, 1].
struct FlyCommand {
  vec3 move{0}; ///< to the right, along the camera's up vector, forward
  vec2 turn{0}; ///< to the left, upwards
  bool any() const { return move != vec3(0) || turn != vec2(0); }
  bool operator==(const FlyCommand&) const = default;
};

/// The camera moved by `distance` (right, up, forward; scene units). Forward is the view direction, up the
/// camera's up vector; the target moves along, so that the focus distance stays. Moving forward would not
/// change an orthographic view: its height shrinks instead, by a factor of e for the distance to the target.
Camera moved_camera(const Camera& camera, vec3 distance);

/// The camera turned about its position: `yaw` radians to the left about the up vector, then `pitch` radians
/// upwards, limited before the up vector. The distance to the target is kept.
Camera turned_camera(const Camera& camera, float yaw, float pitch);

/// Radians between neighbouring pixels in the centre of an image of this height, so that a drag turns the
/// camera by the dragged angle for every field of view. For an orthographic view, the angle by which the
/// target follows the pointer.
float radians_per_pixel(const Camera& camera, int film_height);

/// An inconsistency of the camera's values (no view direction, or one along the up vector), with its remedy;
/// empty if there is none.
std::string camera_problem(const Camera& camera);

/// The default speed of flight, scene units per second: a quarter of the diagonal of the scene's world-space
/// bounds, or of the distance to the target without bounds.
float natural_speed(const Bounds3& bounds, const Camera& camera);

} // namespace candela
