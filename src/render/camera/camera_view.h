#pragma once
// How the camera's view lies on the film: what the window, gizmos and picking project with. It knows where
// things are seen, not how rays are generated (render/camera/camera_model.h).

#include "core/ray.h"
#include "render/camera/stereo.h"
#include "render/world/ray_cone.h"
#include "scene/scene_desc.h"

#include <optional>

namespace candela {

/// Radians: Camera::vertical_fov; of a lens of elements what follows from it and from the film. Of a
/// spherical camera without meaning.
float shown_vertical_fov(const Camera& camera, int width, int height);

/// The camera with its basis worked out. Film positions are in pixels, (0, 0) is the top left corner. The
/// view is vertical_fov (orthographic_height) high; it is as wide as square pixels make it or, where
/// Camera::aspect says so, that many times as wide as high. Of a stereo pair each picture is such a view.
/// Spherical views are 360 by 180 degrees, with `forward` in the middle.
class CameraView {
public:
  CameraView(const Camera& camera, int width, int height)
      : orthographic_(camera.projection == Projection::orthographic),
        spherical_(camera.projection == Projection::spherical), position_(camera.position),
        forward_(glm::normalize(camera.target - camera.position)),
        right_(glm::normalize(glm::cross(forward_, camera.up))), up_(glm::cross(right_, forward_)),
        panes_(camera.stereo, width, height), eyes_(eyes(camera)), center_(0.5f * vec2(panes_.size)),
        aperture_radius_(camera.aperture_radius), focus_distance_(camera.effective_focus_distance()) {
    const vec2 size(panes_.size);
    if (spherical_) {
      pixel_ = vec2(2 * kPi, kPi) / size;
      return;
    }
    const float view_height =
        orthographic_ ? camera.orthographic_height
                      : 2 * std::tan(0.5f * shown_vertical_fov(camera, panes_.size.x, panes_.size.y));
    pixel_.y = view_height / size.y;
    pixel_.x = camera.aspect > 0 ? camera.aspect * view_height / size.x : pixel_.y;
  }

  bool has_lens() const { return aperture_radius_ > 0; }
  bool orthographic() const { return orthographic_; }
  bool spherical() const { return spherical_; }
  vec3 position() const { return position_; }
  vec3 forward() const { return forward_; } ///< unit, as right() and up()
  vec3 right() const { return right_; }
  vec3 up() const { return up_; }
  float focus_distance() const { return focus_distance_; }
  float aperture_radius() const { return aperture_radius_; }

  StereoEyes eyes(const Camera& camera) const { return {camera, forward_, right_, up_}; }

  /// From the middle of a flat view to a film position, on the plane at distance 1 (any, if orthographic).
  vec3 shift(vec2 film) const {
    const vec2 p = (film - center_) * pixel_;
    return right_ * p.x - up_ * p.y;
  }

  /// The unit direction that a spherical view shows at the film position. On around the sphere beyond its
  /// sides, and down the other side beyond the poles.
  vec3 spherical_direction(vec2 film) const {
    const float phi = (film.x - center_.x) * pixel_.x, theta = film.y * pixel_.y;
    return glm::normalize(std::sin(theta) * (std::cos(phi) * forward_ + std::sin(phi) * right_) +
                          std::cos(theta) * up_);
  }

  /// World-space ray of unit direction along which a pinhole here sees what it shows at the film position.
  /// Parallel ones begin on the plane through the camera.
  Ray sight(vec2 film) const;

  /// Distance of the point along the view axis, negative behind the camera; in spherical views its distance.
  float view_depth(vec3 point) const {
    return spherical_ ? glm::length(point - position_) : glm::dot(point - position_, forward_);
  }

  /// The film position at which a pinhole here shows the point, of a stereo pair in the left eye's picture
  /// (spherical: about); nothing where it is not in front.
  std::optional<vec2> project(vec3 point) const;

  /// Side of the area that a pixel covers at a view depth, across and upwards, in scene units; of spherical
  /// views at the horizon.
  vec2 pixel_footprint(float view_depth) const { return orthographic_ ? pixel_ : pixel_ * view_depth; }

  /// The cone of a pixel about a ray of that unit direction, from a pinhole or parallel. Off the axis by an
  /// angle a, the pixel's square has cos a and cos^2 a of its sides, by distance along the ray: the mean. In
  /// spherical views it is narrower at higher latitudes.
  RayCone pixel_cone(vec3 direction) const {
    const float cosine = std::max(glm::dot(direction, forward_), 0.0f);
    const float shrunk = orthographic_ ? 1
                         : spherical_  ? std::sqrt(glm::length(glm::cross(direction, up_)))
                                       : cosine * std::sqrt(cosine);
    auto side = [&](float depth) {
      const vec2 sides = pixel_footprint(depth);
      return shrunk * std::sqrt(sides.x * sides.y);
    };
    return RayCone::of_pixel(side(0), side(1));
  }

  /// Diameter of the disc (or of the circle about the polygon) into which a thin lens blurs a point at a view
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
  bool orthographic_, spherical_;
  vec3 position_, forward_, right_, up_;
  StereoPanes panes_;
  StereoEyes eyes_;
  /// pixel_: its sides on the plane at distance 1, or anywhere if orthographic; if spherical, in radians.
  vec2 center_, pixel_;
  float aperture_radius_, focus_distance_;
};

} // namespace candela
