#pragma once
// Handles over the picture that move, rotate and scale the selection: their positions, hit tests and the
// effect of drags. Their size on the screen is constant.

#include "app/tools/projection.h"

#include <optional>

struct ImDrawList;

namespace candela {

enum class Tool { select, move, rotate, scale };

/// An axis, or the middle, which moves within the image plane, rotates about the view direction and scales
/// uniformly.
enum class GizmoHandle { x, y, z, view };

struct Gizmo {
  Tool tool = Tool::select; ///< not select
  vec3 pivot{0};            ///< world space; the centre of rotation and scaling
  mat3 axes{1};             ///< orthonormal, world space
  float scale = 1;          ///< of the user interface

  /// The handle nearest to a screen position, if one is close enough.
  std::optional<GizmoHandle> hit(const ScreenProjection& screen, vec2 mouse) const;
  void draw(const ScreenProjection& screen, ImDrawList& list, std::optional<GizmoHandle> highlighted) const;
};

/// One drag of a handle, beginning with the press.
class GizmoDrag {
public:
  GizmoDrag(const Gizmo& gizmo, GizmoHandle handle, vec2 mouse);

  /// The world-space transform since the press for the current mouse position. With `snap`, in steps: round
  /// numbers of scene units, 15 degrees, tenths.
  mat4 moved_to(const ScreenProjection& screen, vec2 mouse, bool snap);
  GizmoHandle handle() const { return handle_; }

private:
  mat4 move(const ScreenProjection& screen, vec2 mouse, bool snap) const;
  mat4 rotate(const ScreenProjection& screen, vec2 mouse, bool snap);
  mat4 scale(const ScreenProjection& screen, vec2 mouse, bool snap) const;

  Gizmo gizmo_;
  GizmoHandle handle_;
  vec2 start_, last_;
  float angle_ = 0; ///< radians since the press; may exceed a full turn
};

/// The snap step of moves: 1, 2 or 5 times a power of ten, about 30 pixels long.
float snap_step(float units_per_pixel, float ui_scale);

} // namespace candela
