#pragma once
// Drawing for the lab's pages: framed canvases on ImGui's draw lists, a view that the mouse rotates, maps of
// numbers.

#include "app/ui/widgets.h"
#include "core/math.h"

#include <imgui.h>

#include <functional>
#include <span>

namespace candela {

/// A framed rectangle of the current window that data is drawn into.
struct LabCanvas {
  ImDrawList* list = nullptr;
  vec2 lo{0}, hi{0};           ///< pixels
  vec2 data_lo{0}, data_hi{1}; ///< data coordinates at the bottom left and the top right

  ImVec2 at(vec2 data) const {
    const vec2 t = (data - data_lo) / (data_hi - data_lo);
    return {lo.x + t.x * (hi.x - lo.x), hi.y - t.y * (hi.y - lo.y)};
  }
  void line(vec2 a, vec2 b, ImU32 color, float width = 1) const { list->AddLine(at(a), at(b), color, width); }
  void curve(std::span<const vec2> points, ImU32 color, float width = 1) const;
  void circle(vec2 center, float radius, ImU32 color, float width = 1) const;
  void dot(vec2 p, float pixels, ImU32 color) const;
};

/// Reserves `size` pixels of the window that react to the mouse, and records them under `name`. Drawing is
/// clipped to them until end_canvas().
LabCanvas begin_canvas(Ui& ui, const char* name, vec2 size, vec2 data_lo, vec2 data_hi);
void end_canvas(const LabCanvas& canvas);

/// A view of the origin that dragging with the left button rotates; z is up.
class OrbitView {
public:
  /// Called after begin_canvas().
  void drag();
  /// x to the right, y up, z towards the viewer.
  vec3 to_view(vec3 world) const;
  vec2 project(vec3 world) const { return vec2(to_view(world)); }

private:
  float azimuth_ = radians(-60.0f), elevation_ = radians(25.0f);
};

/// A circle of radius 1 about the origin and a cross, in the plane z = 0.
void draw_ground(const LabCanvas& canvas, const OrbitView& view);
/// The unit sphere's outline with meridians and parallels, or those of its upper half.
void draw_globe(const LabCanvas& canvas, const OrbitView& view, bool upper_half);
void draw_arrow(const LabCanvas& canvas, const OrbitView& view, vec3 from, vec3 to, ImU32 color, float width);

/// A map of columns x rows numbers, row 0 at the top. The colours of viridis show square roots from 0 to that
/// of `most`, so that small values are visible.
void number_map(Ui& ui, const char* name, const char* title, std::span<const double> values, int columns,
                int rows, double most, vec2 size);

inline constexpr ImU32 kLabHit = IM_COL32(86, 180, 233, 255);  // Okabe and Ito's sky blue
inline constexpr ImU32 kLabMiss = IM_COL32(230, 159, 0, 255);  // and orange
inline constexpr ImU32 kLabInk = IM_COL32(235, 235, 235, 255); // outlines
inline constexpr ImU32 kLabGrid = IM_COL32(255, 255, 255, 45);

} // namespace candela
