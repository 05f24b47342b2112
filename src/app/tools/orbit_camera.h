#pragma once
// Navigation about a point, as in modelling programs: orbit, pan, zoom, views along the axes. Pure functions
// of the camera; flight is in fly_camera.h.

#include "core/bounds.h"
#include "scene/scene_desc.h"

namespace candela {

/// The camera carried around the pivot: `yaw` radians to the left about the up vector, then `pitch` radians
/// upwards; it keeps its distance from the pivot and stops short of the poles. The pivot stays where it is in
/// the picture.
Camera orbited_camera(const Camera& camera, vec3 pivot, float yaw, float pitch);

/// The camera moved within its image plane; scene units to the right and upwards in the picture.
Camera panned_camera(const Camera& camera, vec2 distance);

/// The whole view scaled about the pivot, which stays where it is in the picture: a factor of 0.5 comes twice
/// as close. The view direction does not change; of an orthographic view only the height and what lies across
/// it scale. What would bring the target closer, or make the height smaller, than `nearest` (scene units)
/// leaves the camera as it is.
Camera zoomed_camera(const Camera& camera, vec3 pivot, float factor, float nearest);

enum class AxisView { front, back, right, left, top, bottom };

/// The view along an axis of the world at the pivot, from the same distance. Up is the axis that is nearest
/// to the camera's up vector: where y is up, the front looks along -z and the right along -x; where z is up,
/// the front looks along +y.
Camera axis_camera(const Camera& camera, vec3 pivot, AxisView view);

/// From perspective to orthographic or back; what is as far away as the pivot keeps its size.
Camera other_projection(const Camera& camera, vec3 pivot);

/// The same view direction, with all of the bounds just in the picture, whose width is `aspect` times its
/// height. Empty bounds change nothing.
Camera framing_camera(const Camera& camera, const Bounds3& bounds, float aspect);

} // namespace candela
