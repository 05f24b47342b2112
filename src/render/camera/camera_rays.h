#pragma once
// Camera rays: perspective or parallel ones, through a pinhole or a thin lens.

#include "core/ray.h"
#include "render/camera/aperture.h"
#include "scene/scene_desc.h"

#include <optional>

namespace candela {

/// The camera with its basis worked out. Film positions are in pixels, (0, 0) is the top left corner. The
/// view is vertical_fov (orthographic_height) high; it is as wide as square pixels make it or, where
/// Camera::aspect says so, that many times as wide as high.
class CameraRays {
public:
  CameraRays(const Camera& camera, int width, int height)
      : orthographic_(camera.projection == Projection::orthographic), origin_(camera.position),
        forward_(glm::normalize(camera.target - camera.position)),
        right_(glm::normalize(glm::cross(forward_, camera.up))), up_(glm::cross(right_, forward_)),
        center_(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
        aperture_(camera.blades, camera.blade_rotation), aperture_radius_(camera.aperture_radius),
        focus_distance_(camera.effective_focus_distance()) {
    const float view_height =
        orthographic_ ? camera.orthographic_height : 2 * std::tan(0.5f * camera.vertical_fov);
    pixel_.y = view_height / static_cast<float>(height);
    pixel_.x = camera.aspect > 0 ? camera.aspect * view_height / static_cast<float>(width) : pixel_.y;
  }

  bool has_lens() const { return aperture_radius_ > 0; }
  bool orthographic() const { return orthographic_; }
  vec3 position() const { return origin_; }
  vec3 forward() const { return forward_; }
  float focus_distance() const { return focus_distance_; }

  /// World-space ray of unit direction through the film position and, with a lens, the point of the aperture
  /// that the square u_lens maps to. The importance is 1: a pixel is the mean radiance over film and
  /// aperture. Parallel rays begin on the plane through the camera; with a lens each is the middle of a cone
  /// that meets on the plane of focus (a telecentric lens).
  Ray ray(vec2 film, vec2 u_lens) const {
    vec2 p = (film - center_) * pixel_;
    vec3 shift = right_ * p.x - up_ * p.y;
    vec3 origin = orthographic_ ? origin_ + shift : origin_;
    // Meets the plane of focus at t = focus_distance.
    vec3 direction = orthographic_ ? forward_ : forward_ + shift;
    if (has_lens()) {
      vec2 lens = aperture_.sample(u_lens) * aperture_radius_;
      vec3 offset = right_ * lens.x + up_ * lens.y;
      origin += offset;
      direction = direction * focus_distance_ - offset;
    }
    return {origin, 0, glm::normalize(direction), kInfinity};
  }

  /// Distance of the point along the view axis; negative behind the camera.
  float view_depth(vec3 point) const { return glm::dot(point - origin_, forward_); }

  /// The film position at which a pinhole here shows the point; nothing where it is not in front.
  std::optional<vec2> project(vec3 point) const {
    const vec3 v = point - origin_;
    const float depth = glm::dot(v, forward_);
    if (!(depth > 0)) return std::nullopt;
    const float scale = orthographic_ ? 1 : 1 / depth;
    return center_ + vec2(glm::dot(v, right_), -glm::dot(v, up_)) * scale / pixel_;
  }

  /// Side of the area that a pixel covers at a view depth, across and upwards, in scene units.
  vec2 pixel_footprint(float view_depth) const { return orthographic_ ? pixel_ : pixel_ * view_depth; }

  /// Diameter of the disc (or of the circle about the polygon) into which the lens blurs a point at a view
  /// depth z, in pixel heights: with the aperture's radius a and the plane of focus at f, the rays through a
  /// lens point o reach the plane of focus o (f - z) / z from where the pinhole's does, o (f - z) / f if they
  /// are parallel. 0 for a pinhole.
  float blur_diameter(float view_depth) const {
    const float reach = orthographic_ ? focus_distance_ : view_depth;
    return 2 * aperture_radius_ * std::abs(focus_distance_ - view_depth) /
           (reach * pixel_footprint(focus_distance_).y);
  }

  /// View depths between which the lens blurs by no more than `limit` pixel heights.
  struct Interval {
    float near = 0, far = kInfinity;
  };
  Interval depth_of_field(float limit) const {
    if (!has_lens()) return {};
    const float f = focus_distance_;
    const float k = limit * pixel_footprint(f).y / (2 * aperture_radius_); // |f - z| <= k z, or k f
    if (orthographic_) return {std::max(f * (1 - k), 0.0f), f * (1 + k)};
    return {f / (1 + k), k < 1 ? f / (1 - k) : kInfinity};
  }

private:
  bool orthographic_;
  vec3 origin_, forward_, right_, up_;
  vec2 center_, pixel_; ///< pixel_: its sides on the plane at distance 1, or anywhere if orthographic
  Aperture aperture_;
  float aperture_radius_, focus_distance_;
};

} // namespace candela
