#pragma once
// Camera rays of a pinhole or a thin lens.

#include "core/ray.h"
#include "sampling/warp.h"
#include "scene/scene_desc.h"

namespace candela {

/// The camera with its basis worked out. Film positions are in pixels, (0, 0) is the top left corner.
class CameraRays {
public:
  CameraRays(const Camera& camera, int width, int height)
      : origin_(camera.position), forward_(glm::normalize(camera.target - camera.position)),
        right_(glm::normalize(glm::cross(forward_, camera.up))), up_(glm::cross(right_, forward_)),
        pixel_(2 * std::tan(0.5f * camera.vertical_fov) / static_cast<float>(height)),
        center_(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
        aperture_radius_(camera.aperture_radius), focus_distance_(camera.effective_focus_distance()) {}

  bool has_lens() const { return aperture_radius_ > 0; }
  vec3 forward() const { return forward_; }

  /// World-space ray of unit direction through the film position and, with a lens, the point of the aperture
  /// that the square u_lens maps to. The importance is 1: a pixel is the mean radiance over film and
  /// aperture.
  Ray ray(vec2 film, vec2 u_lens) const {
    vec2 p = (film - center_) * pixel_;
    vec3 direction = forward_ + right_ * p.x - up_ * p.y; // meets the plane of focus at t = focus_distance
    vec3 origin = origin_;
    if (has_lens()) {
      vec2 lens = sample_uniform_disc(u_lens) * aperture_radius_;
      vec3 offset = right_ * lens.x + up_ * lens.y;
      origin += offset;
      direction = direction * focus_distance_ - offset;
    }
    return {origin, 0, glm::normalize(direction), kInfinity};
  }

private:
  vec3 origin_, forward_, right_, up_;
  float pixel_; ///< side of a pixel on the plane at distance 1
  vec2 center_;
  float aperture_radius_, focus_distance_;
};

} // namespace candela
