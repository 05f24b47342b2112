#pragma once
// Navigation about a point as in modelling programs: orbit, pan, zoom, axis-aligned views. Pure functions of
// the camera; flight is in fly_camera.h.

#include "core/bounds.h"
#include "scene/scene_desc.h"

namespace candela {

/// The camera moved around the pivot: `yaw` radians to the left about the up vector, then `pitch` radians
/// upwards, limited before the poles. The distance to the pivot and its position in the picture are kept.
Camera orbited_camera(const Camera& camera, vec3 pivot, float yaw, float pitch);

/// The camera moved within its image plane, scene units to the right and upwards.
Camera panned_camera(const Camera& camera, vec2 distance);

/// The view scaled about the pivot, which keeps its position in the picture: a factor of 0.5 is twice as
/// close. The view direction does not change. An orthographic view scales its height and its position across
/// the view direction. If the target distance or the height would fall below `nearest` (scene units), the
/// camera is not changed.
Camera zoomed_camera(const Camera& camera, vec3 pivot, float factor, float nearest);

enum class AxisView { front, back, right, left, top, bottom };

/// The view along a world axis at the pivot, from the same distance. Up is the world axis nearest to the
/// camera's up vector. If y is up, the front view looks along -z and the right view along -x; if z is up, the
/// front view looks along +y.
Camera axis_camera(const Camera& camera, vec3 pivot, AxisView view);

/// Toggles between perspective and orthographic; objects at the pivot's depth keep their size.
Camera other_projection(const Camera& camera, vec3 pivot);

/// The camera moved so that the bounds just fit into the picture, whose width is `aspect` times its height.
/// The view direction is kept. Empty bounds change nothing.
Camera framing_camera(const Camera& camera, const Bounds3& bounds, float aspect);

} // namespace candela
