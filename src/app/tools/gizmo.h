#pragma once
// Handles over the picture that move, rotate and scale what is selected: where they are, which one the mouse
// is on, and what a drag of it does. Of a constant size on the screen.

#include "app/tools/projection.h"

#include <optional>

struct ImDrawList;

namespace candela {

enum class Tool { select, move, rotate, scale };

/// An axis, or the middle: moves within the image plane, rotates about the view direction, scales evenly.
enum class GizmoHandle { x, y, z, view };

struct Gizmo {
  Tool tool = Tool::select; ///< not select
  vec3 pivot{0};            ///< world space: what it stands at, turns about, scales from
  mat3 axes{1};             ///< orthonormal, world space
  float scale = 1;          ///< of the user interface

  /// The handle under a screen position, the nearest to it where several are.
  std::optional<GizmoHandle> hit(const ScreenProjection& screen, vec2 mouse) const;
  void draw(const ScreenProjection& screen, ImDrawList& list, std::optional<GizmoHandle> highlighted) const;
};

/// One drag of a handle, from the press on.
class GizmoDrag {
public:
  GizmoDrag(const Gizmo& gizmo, GizmoHandle handle, vec2 mouse);

  /// The world-space transform since the press, with the mouse there now. With `snap` in steps: round
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
  float angle_ = 0; ///< radians since the press; a drag may go around more than once
};

/// The snap step of moves: 1, 2 or 5 times a power of ten, some 30 pixels long.
float snap_step(float units_per_pixel, float ui_scale);

} // namespace candela
