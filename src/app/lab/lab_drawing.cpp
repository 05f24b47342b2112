#include "app/lab/lab_drawing.h"

#include "imaging/color_map.h"

#include <array>
#include <vector>

namespace candela {

void LabCanvas::curve(std::span<const vec2> points, ImU32 color, float width) const {
  std::vector<ImVec2> line;
  line.reserve(points.size());
  for (vec2 p : points) line.push_back(at(p));
  list->AddPolyline(line.data(), static_cast<int>(line.size()), color, ImDrawFlags_None, width);
}

void LabCanvas::circle(vec2 center, float radius, ImU32 color, float width) const {
  list->AddCircle(at(center), radius * (hi.x - lo.x) / (data_hi.x - data_lo.x), color, 96, width);
}

void LabCanvas::dot(vec2 p, float pixels, ImU32 color) const {
  const ImVec2 c = at(p);
  list->AddRectFilled({c.x - 0.5f * pixels, c.y - 0.5f * pixels}, {c.x + 0.5f * pixels, c.y + 0.5f * pixels},
                      color);
}

LabCanvas begin_canvas(Ui& ui, const char* name, vec2 size, vec2 data_lo, vec2 data_hi) {
  size = glm::max(glm::floor(size), vec2(1));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(name, ImVec2(size.x, size.y));
  ui.record(name);
  LabCanvas canvas{ImGui::GetWindowDrawList(), vec2(at.x, at.y), vec2(at.x, at.y) + size, data_lo, data_hi};
  const ImVec2 end(canvas.hi.x, canvas.hi.y);
  canvas.list->AddRectFilled(at, end, IM_COL32(24, 24, 24, 255));
  canvas.list->PushClipRect(at, end, true);
  return canvas;
}

void end_canvas(const LabCanvas& canvas) { canvas.list->PopClipRect(); }

void OrbitView::drag() {
  if (!ImGui::IsItemActive()) return;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  constexpr float kRadiansPerPixel = 0.008f;
  azimuth_ -= kRadiansPerPixel * moved.x;
  elevation_ = std::clamp(elevation_ + kRadiansPerPixel * moved.y, -0.5f * kPi, 0.5f * kPi);
}

vec3 OrbitView::to_view(vec3 w) const {
  const float ca = std::cos(azimuth_), sa = std::sin(azimuth_);
  const float ce = std::cos(elevation_), se = std::sin(elevation_);
  // The view direction is (ce ca, ce sa, se); right is (-sa, ca, 0).
  return {ca * w.y - sa * w.x, ce * w.z - se * (ca * w.x + sa * w.y), se * w.z + ce * (ca * w.x + sa * w.y)};
}

namespace {

template <class F>
void draw_curve(const LabCanvas& canvas, const OrbitView& view, int steps, ImU32 color, const F& f) {
  std::vector<vec2> points;
  for (int i = 0; i <= steps; ++i)
    points.push_back(view.project(f(static_cast<float>(i) / static_cast<float>(steps))));
  canvas.curve(points, color);
}

vec3 on_circle(float turns, float radius, float z) {
  return {radius * std::cos(2 * kPi * turns), radius * std::sin(2 * kPi * turns), z};
}

} // namespace

void draw_ground(const LabCanvas& canvas, const OrbitView& view) {
  draw_curve(canvas, view, 64, kLabGrid, [](float t) { return on_circle(t, 1, 0); });
  draw_curve(canvas, view, 64, kLabGrid, [](float t) { return on_circle(t, 0.5f, 0); });
  canvas.line(view.project({-1, 0, 0}), view.project({1, 0, 0}), kLabGrid);
  canvas.line(view.project({0, -1, 0}), view.project({0, 1, 0}), kLabGrid);
}

void draw_globe(const LabCanvas& canvas, const OrbitView& view, bool upper_half) {
  for (int parallel = upper_half ? 0 : -2; parallel <= 2; ++parallel) {
    const float latitude = static_cast<float>(parallel) * kPi / 6;
    draw_curve(canvas, view, 64, kLabGrid,
               [&](float t) { return on_circle(t, std::cos(latitude), std::sin(latitude)); });
  }
  for (int meridian = 0; meridian < 6; ++meridian) {
    const float turns = static_cast<float>(meridian) / 12;
    draw_curve(canvas, view, 48, kLabGrid, [&](float t) {
      const float angle = kPi * (upper_half ? t : 2 * t);
      return vec3(on_circle(turns, std::cos(angle), std::sin(angle)));
    });
  }
}

void draw_arrow(const LabCanvas& canvas, const OrbitView& view, vec3 from, vec3 to, ImU32 color,
                float width) {
  const ImVec2 a = canvas.at(view.project(from)), b = canvas.at(view.project(to));
  canvas.list->AddLine(a, b, color, width);
  const vec2 along(b.x - a.x, b.y - a.y);
  const float length = glm::length(along);
  if (length < 1) return;
  const vec2 d = along / length * (4 * width), side(-d.y, d.x);
  canvas.list->AddTriangleFilled(b, {b.x - d.x - 0.5f * side.x, b.y - d.y - 0.5f * side.y},
                                 {b.x - d.x + 0.5f * side.x, b.y - d.y + 0.5f * side.y}, color);
}

void number_map(Ui& ui, const char* name, const char* title, std::span<const double> values, int columns,
                int rows, double most, vec2 size) {
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", title);
  const LabCanvas canvas = begin_canvas(ui, name, size, vec2(0, rows), vec2(columns, 0));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double value = values[static_cast<std::size_t>(row * columns + column)];
      const auto c = map_color(ColorMap::viridis, static_cast<float>(std::sqrt(value / most)));
      canvas.list->AddRectFilled(canvas.at({column, row}), canvas.at({column + 1, row + 1}),
                                 IM_COL32(c[0], c[1], c[2], 255));
    }
  end_canvas(canvas);
  ImGui::EndGroup();
}

} // namespace candela
