#pragma once
// Flight: how a camera moves and turns with the input. Pure functions of the camera.

#include "core/bounds.h"
#include "scene/scene_desc.h"

#include <string>

namespace candela {

/// What the keys ask for right now; each component in [-1, 1].
struct FlyCommand {
  vec3 move{0}; ///< to the right, along the camera's up vector, forward
  vec2 turn{0}; ///< to the left, upwards
  bool any() const { return move != vec3(0) || turn != vec2(0); }
  bool operator==(const FlyCommand&) const = default;
};

/// The camera carried by `distance` (right, up, forward; scene units). Forward is the view direction, up the
/// camera's up vector; the target comes along, so that the focus stays at its distance. A step forward does
/// not change what parallel rays show: an orthographic view becomes smaller instead, by a factor of e for the
/// distance to the target.
Camera moved_camera(const Camera& camera, vec3 distance);

/// The camera turned about its position: `yaw` radians to the left about the up vector, then `pitch` radians
/// upwards, which stops short of looking along the up vector. The distance to the target is kept.
Camera turned_camera(const Camera& camera, float yaw, float pitch);

/// Radians between two neighbouring pixels in the middle of an image of this height: a drag turns the camera
/// by as much as it moved, whatever the lens. Of an orthographic view: as the target moves under the pointer.
float radians_per_pixel(const Camera& camera, int film_height);

/// What is wrong with the camera as a whole, though each value is in range (no view direction, or one along
/// its up vector), and what to do; empty if it is fine.
std::string camera_problem(const Camera& camera);

/// Scene units a second of flight that suit the scene: a quarter of the diagonal of the
/// scene's world-space bounds, or of the distance to the target where there are none.
float natural_speed(const Bounds3& bounds, const Camera& camera);

} // namespace candela
