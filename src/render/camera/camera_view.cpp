#include "render/camera/camera_view.h"

#include "render/camera/realistic_camera.h"

namespace candela {

float shown_vertical_fov(const Camera& camera, int width, int height) {
  return camera.has_elements() ? RealisticCamera(camera, width, height).vertical_fov() : camera.vertical_fov;
}

Ray CameraView::sight(vec2 film) const {
  const bool right_eye = panes_.is_right(film);
  const vec2 at = panes_.within(right_eye, film);
  Ray ray{position_, 0, vec3(0), kInfinity};
  if (spherical_) {
    ray.direction = spherical_direction(at);
  } else {
    const vec3 s = shift(at);
    if (orthographic_) ray.origin += s;
    ray.direction = glm::normalize(orthographic_ ? forward_ : forward_ + s);
  }
  if (panes_.is_pair()) eyes_.shift(right_eye, ray);
  return ray;
}

std::optional<vec2> CameraView::project(vec3 point) const {
  if (!(view_depth(point) > 0)) return std::nullopt;
  if (spherical_) {
    const vec3 v = glm::normalize(point - position_);
    const float phi = std::atan2(glm::dot(v, right_), glm::dot(v, forward_));
    const float theta = std::acos(std::clamp(glm::dot(v, up_), -1.0f, 1.0f));
    return vec2(center_.x + phi / pixel_.x, theta / pixel_.y);
  }
  const vec3 v = (panes_.is_pair() ? eyes_.seen_between(point) : point) - position_;
  const float scale = orthographic_ ? 1 : 1 / glm::dot(v, forward_);
  return center_ + vec2(glm::dot(v, right_), -glm::dot(v, up_)) * scale / pixel_;
}

} // namespace candela
