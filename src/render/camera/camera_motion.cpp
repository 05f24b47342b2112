#include "render/camera/camera_motion.h"

#include "render/camera/camera_view.h"

namespace candela {

namespace {

/// World from camera.
glm::dmat3 orientation(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
  return {right, glm::cross(right, forward), -forward};
}

} // namespace

CameraMotion::CameraMotion(const Camera& camera, int width, int height)
    : moves_(camera.moves()), panes_(camera.stereo, width, height),
      zooms_(camera.motion_fov != 0 && camera.projection == Projection::perspective &&
             !camera.has_elements()),
      tangent_(std::tan(0.5f * camera.vertical_fov)), fov_(camera.vertical_fov),
      fov_change_(camera_at_end(camera).vertical_fov - camera.vertical_fov) {
  if (!moves_) return;
  const AxisAngle turn = axis_angle(orientation(camera_at_end(camera)) * glm::transpose(orientation(camera)));
  pose_.pivot = glm::dvec3(camera.position);
  pose_.translation = glm::dvec3(camera.motion_position);
  pose_.axis = turn.axis;
  pose_.angle = turn.angle;
}

vec2 CameraMotion::film_at(bool right_eye, vec2 film, float time) const {
  if (!zooms_) return film;
  const vec2 center = 0.5f * vec2(panes_.size) + (right_eye ? vec2(panes_.right_origin) : vec2(0));
  return center + (film - center) * (std::tan(0.5f * (fov_ + time * fov_change_)) / tangent_);
}

void CameraMotion::move(Ray& ray) const {
  const auto time = static_cast<double>(ray.time);
  const glm::dmat3 rotation = rotation_about(pose_.axis, time * pose_.angle);
  ray.origin =
      vec3(pose_.pivot + time * pose_.translation + rotation * (glm::dvec3(ray.origin) - pose_.pivot));
  ray.direction = vec3(glm::normalize(rotation * glm::dvec3(ray.direction)));
}

vec3 CameraMotion::direction_at_start(vec3 direction, float time) const {
  if (!moves_) return direction;
  return vec3(rotation_about(pose_.axis, -static_cast<double>(time) * pose_.angle) * glm::dvec3(direction));
}

vec3 CameraMotion::direction_at(vec3 direction, float time) const {
  if (!moves_) return direction;
  return vec3(rotation_about(pose_.axis, static_cast<double>(time) * pose_.angle) * glm::dvec3(direction));
}

} // namespace candela
