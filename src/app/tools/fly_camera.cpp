#include "app/tools/fly_camera.h"

#include "scene/document.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// Least angle between view direction and up vector: closer, yaw would only roll the picture.
constexpr float kPolarMargin = radians(1.0f);

vec3 forward_of(const Camera& camera) { return glm::normalize(camera.target - camera.position); }

/// Rodrigues' rotation of v about the unit axis by an angle in radians.
vec3 rotated(vec3 v, vec3 axis, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

} // namespace

Camera moved_camera(const Camera& camera, vec3 distance) {
  const vec3 forward = forward_of(camera);
  const vec3 right = glm::normalize(glm::cross(forward, camera.up));
  Camera result = camera;
  if (camera.projection == Projection::orthographic) {
    const float reach = glm::length(camera.target - camera.position);
    result.orthographic_height = std::clamp(camera.orthographic_height * std::exp(-distance.z / reach), 1e-6f,
                                            Camera::kGreatestHeight);
    distance.z = 0;
  }
  const vec3 step = distance.x * right + distance.y * glm::normalize(camera.up) + distance.z * forward;
  result.position += step;
  result.target += step;
  return result;
}

Camera turned_camera(const Camera& camera, float yaw, float pitch) {
  const vec3 up = glm::normalize(camera.up);
  const float target_distance = glm::length(camera.target - camera.position);
  vec3 forward = rotated(forward_of(camera), up, yaw);
  const float polar = std::acos(std::clamp(glm::dot(forward, up), -1.0f, 1.0f));
  // A scene's camera may be closer to the pole than this margin; then it may only turn away from it.
  const float nearest = std::min(polar, kPolarMargin), farthest = std::max(polar, kPi - kPolarMargin);
  const float wanted = std::clamp(polar - pitch, nearest, farthest);
  const vec3 right = glm::normalize(glm::cross(forward, up));
  forward = glm::normalize(rotated(forward, right, polar - wanted));
  Camera result = camera;
  result.target = camera.position + target_distance * forward;
  return result;
}

float radians_per_pixel(const Camera& camera, int film_height) {
  const int rows = camera.stereo == Stereo::top_bottom ? film_height / 2 : film_height;
  const auto pixels = static_cast<float>(std::max(rows, 1));
  if (camera.projection == Projection::perspective) return 2 * std::tan(0.5f * camera.vertical_fov) / pixels;
  if (camera.projection == Projection::spherical) return kPi / pixels;
  return std::min(camera.orthographic_height / glm::length(camera.target - camera.position), kPi) / pixels;
}

std::string camera_problem(const Camera& camera) {
  const vec3 view = camera.target - camera.position;
  if (!is_finite(view) || !(glm::length(view) > 0))
    return "camera.target: is where the camera is: move one of them";
  if (!(glm::length(camera.up) > 0)) return "camera.up: has no length: give a direction such as 0 1 0";
  const float sine = glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up)));
  if (!(sine > 1e-4f)) return "camera.up: is the view direction: tilt one of them";
  if (const std::string problem = camera_motion_problem(camera); !problem.empty()) {
    const std::size_t remedy = problem.find("; ");
    return fmt::format("camera.{}: {}", problem.substr(0, remedy), problem.substr(remedy + 2));
  }
  return {};
}

float natural_speed(const Bounds3& bounds, const Camera& camera) {
  const float diagonal = bounds.empty() ? 0.0f : glm::length(bounds.diagonal());
  const float size = diagonal > 0 ? diagonal : glm::length(camera.target - camera.position);
  return std::isfinite(size) && size > 0 ? 0.25f * size : 1.0f;
}

} // namespace candela
