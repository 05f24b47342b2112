#include "app/tools/gizmo.h"

#include "app/ui/imgui_vec.h"
#include "core/segment.h"

#include <imgui.h>

#include <vector>

namespace candela {

namespace {

// Lengths here are in pixels at scale 1.
constexpr float kLength = 84;      // of an axis, and radius of the rings
constexpr float kViewRing = 102;   // radius of the ring about the view direction
constexpr float kMiddleHandle = 9; // half the side of the middle handle
constexpr float kReach = 7;        // distance from a handle at which the mouse still hits it
constexpr float kThickness = 2.2f;
constexpr int kRingSegments = 48;
constexpr float kAngleStep = radians(15.0f), kScaleStep = 0.1f, kSmallestScale = 1e-3f;

constexpr GizmoHandle kHandles[] = {GizmoHandle::view, GizmoHandle::x, GizmoHandle::y, GizmoHandle::z};

ImU32 color_of(GizmoHandle handle, bool highlighted) {
  if (highlighted) return IM_COL32(255, 222, 130, 255);
  switch (handle) {
  case GizmoHandle::x: return IM_COL32(232, 80, 84, 255);
  case GizmoHandle::y: return IM_COL32(128, 200, 66, 255);
  case GizmoHandle::z: return IM_COL32(78, 146, 240, 255);
  case GizmoHandle::view: break;
  }
  return IM_COL32(225, 225, 225, 235);
}

/// The direction of a handle; that of the middle one points to the viewer.
vec3 axis_of(const Gizmo& gizmo, GizmoHandle handle, const ScreenProjection& screen) {
  return handle == GizmoHandle::view ? -screen.forward() : gizmo.axes[static_cast<int>(handle)];
}

/// The handle's line on the screen: an axis from the middle to its end, a ring, or the square in the middle.
std::vector<vec2> outline(const Gizmo& gizmo, GizmoHandle handle, const ScreenProjection& screen) {
  std::vector<vec2> line;
  auto add = [&](vec3 world) {
    if (const auto at = screen.point(world)) line.push_back(*at);
  };
  const float unit = screen.units_per_pixel(gizmo.pivot) * gizmo.scale;
  if (gizmo.tool == Tool::rotate) {
    const vec3 normal = axis_of(gizmo, handle, screen);
    const vec3 side = std::abs(normal.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 u = glm::normalize(glm::cross(normal, side)), v = glm::cross(normal, u);
    const float radius = unit * (handle == GizmoHandle::view ? kViewRing : kLength);
    for (int i = 0; i <= kRingSegments; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / kRingSegments;
      add(gizmo.pivot + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  } else if (handle == GizmoHandle::view) {
    if (const auto middle = screen.point(gizmo.pivot))
      for (vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1), vec2(-1, -1)})
        line.push_back(*middle + kMiddleHandle * gizmo.scale * corner);
  } else {
    const vec3 axis = axis_of(gizmo, handle, screen);
    add(gizmo.pivot + 1.6f * kMiddleHandle * unit * axis); // leaves room for the middle handle
    add(gizmo.pivot + kLength * unit * axis);
  }
  return line;
}

float snapped(float value, float step) { return std::round(value / step) * step; }

} // namespace

std::optional<GizmoHandle> Gizmo::hit(const ScreenProjection& screen, vec2 mouse) const {
  std::optional<GizmoHandle> found;
  float nearest = kReach * scale;
  if (!screen.point(pivot)) return found;
  for (GizmoHandle handle : kHandles) {
    const std::vector<vec2> line = outline(*this, handle, screen);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const float distance = distance_to_segment(mouse, line[i], line[i + 1]);
      if (distance < nearest) nearest = distance, found = handle;
    }
  }
  const vec2 from_middle = glm::abs(mouse - *screen.point(pivot));
  if (tool != Tool::rotate && std::max(from_middle.x, from_middle.y) <= kMiddleHandle * scale)
    return GizmoHandle::view;
  return found;
}

void Gizmo::draw(const ScreenProjection& screen, ImDrawList& list,
                 std::optional<GizmoHandle> highlighted) const {
  if (!screen.point(pivot)) return;
  for (GizmoHandle handle : kHandles) {
    const std::vector<vec2> line = outline(*this, handle, screen);
    if (line.size() < 2) continue;
    const ImU32 color = color_of(handle, highlighted == handle);
    const ImU32 shadow = IM_COL32(0, 0, 0, 110); // visible on any picture
    for (const auto& [tint, width] : {std::pair(shadow, kThickness + 2), std::pair(color, kThickness)})
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        list.AddLine(im(line[i]), im(line[i + 1]), tint, width * scale);
    if (tool == Tool::rotate || handle == GizmoHandle::view) continue;
    const vec2 end = line.back();
    const vec2 along = end - line.front();
    if (glm::length(along) < 1) continue; // it points at the viewer
    const vec2 d = glm::normalize(along), side(-d.y, d.x);
    if (tool == Tool::move)
      list.AddTriangleFilled(im(end + 13 * scale * d), im(end + 5.5f * scale * side),
                             im(end - 5.5f * scale * side), color);
    else
      list.AddRectFilled(im(end - 5 * scale), im(end + 5 * scale), color);
  }
}

GizmoDrag::GizmoDrag(const Gizmo& gizmo, GizmoHandle handle, vec2 mouse)
    : gizmo_(gizmo), handle_(handle), start_(mouse), last_(mouse) {}

mat4 GizmoDrag::moved_to(const ScreenProjection& screen, vec2 mouse, bool snap) {
  switch (gizmo_.tool) {
  case Tool::select: break;
  case Tool::move: return move(screen, mouse, snap);
  case Tool::rotate: return rotate(screen, mouse, snap);
  case Tool::scale: return scale(screen, mouse, snap);
  }
  return mat4(1);
}

mat4 GizmoDrag::move(const ScreenProjection& screen, vec2 mouse, bool snap) const {
  const float step = snap_step(screen.units_per_pixel(gizmo_.pivot), gizmo_.scale);
  const vec3 axis = axis_of(gizmo_, handle_, screen);
  if (handle_ == GizmoHandle::view) {
    auto on_plane = [&](vec2 at) {
      const Ray ray = screen.ray(at);
      const float t = glm::dot(gizmo_.pivot - ray.origin, axis) / glm::dot(ray.direction, axis);
      return ray.at(t);
    };
    vec3 delta = on_plane(mouse) - on_plane(start_);
    if (snap)
      for (int i = 0; i < 3; ++i) delta[i] = snapped(delta[i], step);
    return glm::translate(mat4(1), delta);
  }
  // The point of the axis nearest to the ray under the mouse, by the lines' common perpendicular.
  auto along_axis = [&](vec2 at) -> std::optional<float> {
    const Ray ray = screen.ray(at);
    const float cosine = glm::dot(axis, ray.direction), sine2 = 1 - cosine * cosine;
    if (sine2 < 1e-4f) return std::nullopt; // it points at the viewer
    const vec3 w = ray.origin - gizmo_.pivot;
    return (glm::dot(w, axis) - cosine * glm::dot(w, ray.direction)) / sine2;
  };
  const auto from = along_axis(start_), to = along_axis(mouse);
  if (!from || !to) return mat4(1);
  const float delta = snap ? snapped(*to - *from, step) : *to - *from;
  return glm::translate(mat4(1), delta * axis);
}

mat4 GizmoDrag::rotate(const ScreenProjection& screen, vec2 mouse, bool snap) {
  const auto center = screen.point(gizmo_.pivot);
  if (!center) return mat4(1);
  const vec2 a = last_ - *center, b = mouse - *center;
  last_ = mouse;
  // Counter-clockwise on the screen, whose y points down.
  angle_ += std::atan2(a.y * b.x - a.x * b.y, glm::dot(a, b));
  const vec3 axis = axis_of(gizmo_, handle_, screen);
  const float seen = glm::dot(axis, screen.forward()) < 0 ? angle_ : -angle_;
  const mat4 turn = glm::rotate(mat4(1), snap ? snapped(seen, kAngleStep) : seen, axis);
  return glm::translate(mat4(1), gizmo_.pivot) * turn * glm::translate(mat4(1), -gizmo_.pivot);
}

mat4 GizmoDrag::scale(const ScreenProjection& screen, vec2 mouse, bool snap) const {
  const auto center = screen.point(gizmo_.pivot);
  if (!center) return mat4(1);
  vec3 factors(1);
  auto factor = [&](float now, float before) {
    const float ratio = std::abs(before) > 1 ? now / before : 1;
    return std::max(snap ? snapped(ratio, kScaleStep) : ratio, snap ? kScaleStep : kSmallestScale);
  };
  if (handle_ == GizmoHandle::view) {
    // The middle handle scales by movement to the right and upwards: it is too small for a ratio of
    // distances.
    const vec2 moved = mouse - start_;
    factors = vec3(factor(kLength * gizmo_.scale + moved.x - moved.y, kLength * gizmo_.scale));
  } else {
    const int i = static_cast<int>(handle_);
    const float unit = screen.units_per_pixel(gizmo_.pivot);
    const auto end = screen.point(gizmo_.pivot + kLength * gizmo_.scale * unit * gizmo_.axes[i]);
    if (!end || glm::length(*end - *center) < 1) return mat4(1);
    const vec2 d = glm::normalize(*end - *center);
    factors[i] = factor(glm::dot(mouse - *center, d), glm::dot(start_ - *center, d));
  }
  const mat4 frame = glm::translate(mat4(1), gizmo_.pivot) * mat4(gizmo_.axes);
  const mat4 back = mat4(glm::transpose(gizmo_.axes)) * glm::translate(mat4(1), -gizmo_.pivot);
  return frame * glm::scale(mat4(1), factors) * back;
}

float snap_step(float units_per_pixel, float ui_scale) {
  const float wanted = 30 * ui_scale * units_per_pixel;
  const float power = std::pow(10.0f, std::floor(std::log10(wanted)));
  for (float digit : {1.0f, 2.0f, 5.0f})
    if (digit * power >= wanted) return digit * power;
  return 10 * power;
}

} // namespace candela
