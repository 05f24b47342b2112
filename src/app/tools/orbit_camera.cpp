#include "app/tools/orbit_camera.h"

#include "app/tools/fly_camera.h"

namespace candela {

namespace {

/// A view from the top deviates from the pole by this angle, so that the up vector stays valid. The edge of a
/// picture moves by less than a pixel.
constexpr float kAxisTilt = 1e-3f;
constexpr float kFrameMargin = 1.05f;

struct ViewAxes {
  vec3 right, up, forward; ///< unit vectors of the image plane and the view direction
};

ViewAxes view_axes(const Camera& camera) {
  const vec3 forward = glm::normalize(camera.target - camera.position);
  const vec3 right = glm::normalize(glm::cross(forward, camera.up));
  return {right, glm::cross(right, forward), forward};
}

/// Depth of the point along the view direction, clamped above 0, where perspective has no scale.
float view_depth(const Camera& camera, vec3 point) {
  const float depth = glm::dot(point - camera.position, view_axes(camera).forward);
  return depth > 0 ? depth : glm::length(camera.target - camera.position);
}

/// The world axis nearest to the direction.
vec3 nearest_axis(vec3 direction) {
  const vec3 size = glm::abs(direction);
  const int axis = size.y >= size.x && size.y >= size.z ? 1 : size.z >= size.x ? 2 : 0;
  vec3 unit(0);
  unit[axis] = direction[axis] < 0 ? -1.0f : 1.0f;
  return unit;
}

} // namespace

Camera orbited_camera(const Camera& camera, vec3 pivot, float yaw, float pitch) {
  // Place the turned camera so that the pivot keeps its position in the picture.
  const ViewAxes before = view_axes(camera);
  Camera result = turned_camera(camera, yaw, pitch);
  const ViewAxes after = view_axes(result);
  const vec3 to_pivot = pivot - camera.position;
  const vec3 turned = after.right * glm::dot(to_pivot, before.right) +
                      after.up * glm::dot(to_pivot, before.up) +
                      after.forward * glm::dot(to_pivot, before.forward);
  const vec3 step = to_pivot - turned;
  result.position += step;
  result.target += step;
  return result;
}

Camera panned_camera(const Camera& camera, vec2 distance) {
  const ViewAxes axes = view_axes(camera);
  const vec3 step = distance.x * axes.right + distance.y * axes.up;
  Camera result = camera;
  result.position += step;
  result.target += step;
  return result;
}

Camera zoomed_camera(const Camera& camera, vec3 pivot, float factor, float nearest) {
  Camera result = camera;
  if (camera.projection == Projection::orthographic) {
    // Scale only across the view direction, so that no point moves from behind the camera to its front.
    const ViewAxes axes = view_axes(camera);
    const vec3 to_pivot = pivot - camera.position;
    const vec3 step = (1 - factor) * (to_pivot - glm::dot(to_pivot, axes.forward) * axes.forward);
    result.orthographic_height = factor * camera.orthographic_height;
    result.position += step;
    result.target += step;
    return factor < 1 && result.orthographic_height < nearest ? camera : result;
  }
  result.position = pivot + factor * (camera.position - pivot);
  result.target = pivot + factor * (camera.target - pivot);
  const bool close = factor < 1 && glm::length(result.target - result.position) < nearest;
  return close || !is_finite(result.position) ? camera : result;
}

Camera axis_camera(const Camera& camera, vec3 pivot, AxisView view) {
  const vec3 up = nearest_axis(camera.up);
  const vec3 right = up.x != 0 ? vec3(0, 1, 0) : vec3(1, 0, 0);
  const vec3 front = glm::cross(right, up);
  vec3 from(0); // from the pivot to the camera
  switch (view) {
  case AxisView::front: from = front; break;
  case AxisView::back: from = -front; break;
  case AxisView::right: from = right; break;
  case AxisView::left: from = -right; break;
  case AxisView::top: from = std::cos(kAxisTilt) * up + std::sin(kAxisTilt) * front; break;
  case AxisView::bottom: from = -std::cos(kAxisTilt) * up + std::sin(kAxisTilt) * front; break;
  }
  const float distance = glm::length(camera.position - pivot);
  Camera result = camera;
  result.up = up;
  result.target = pivot;
  result.position = pivot + (distance > 0 ? distance : 1) * from;
  return result;
}

Camera other_projection(const Camera& camera, vec3 pivot) {
  Camera result = camera;
  const float slope = 2 * std::tan(0.5f * camera.vertical_fov);
  if (camera.projection == Projection::perspective) {
    result.projection = Projection::orthographic;
    result.orthographic_height = slope * view_depth(camera, pivot);
    return result;
  }
  // Zooming changed only the orthographic height: move to the distance at which perspective shows as much.
  result.projection = Projection::perspective;
  const ViewAxes axes = view_axes(camera);
  const float depth = camera.orthographic_height / slope;
  const vec3 step = axes.forward * (view_depth(camera, pivot) - depth);
  result.position += step;
  result.target = result.position + depth * axes.forward;
  return result;
}

Camera framing_camera(const Camera& camera, const Bounds3& bounds, float aspect) {
  if (bounds.empty()) return camera;
  const float radius = std::max(0.5f * glm::length(bounds.diagonal()), 1e-6f);
  const float narrow = std::min(aspect, 1.0f); // smaller side of the picture over its height
  const float half_angle = std::atan(narrow * std::tan(0.5f * camera.vertical_fov));
  Camera result = camera;
  result.target = bounds.center();
  result.position = result.target - kFrameMargin * radius / std::sin(half_angle) * view_axes(camera).forward;
  if (camera.projection == Projection::orthographic)
    result.orthographic_height = std::min(kFrameMargin * 2 * radius / narrow, Camera::kGreatestHeight);
  return result;
}

} // namespace candela
