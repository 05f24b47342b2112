#pragma once
// Pairs of pictures, one for each eye.

#include "core/ray.h"
#include "scene/scene_desc.h"

namespace candela {

/// Where the pictures of the two eyes lie on the film: the left eye's on the left, or on top. If its width
/// (height) is odd, the right eye's has a pixel more.
struct StereoPanes {
  ivec2 size{0};         ///< of the left eye's picture, in pixels
  ivec2 right_origin{0}; ///< of the right eye's; (0, 0) where there is one picture only

  StereoPanes(Stereo layout, int width, int height) : size(width, height) {
    const int axis = layout == Stereo::side_by_side ? 0 : 1;
    if (layout == Stereo::none) return;
    size[axis] = std::max(size[axis] / 2, 1);
    right_origin[axis] = size[axis];
  }

  bool is_pair() const { return right_origin != ivec2(0); }
  /// Whether a film position belongs to the right eye's picture.
  bool is_right(vec2 film) const {
    return is_pair() && film.x >= static_cast<float>(right_origin.x) &&
           film.y >= static_cast<float>(right_origin.y);
  }
  /// The film position in the picture of that eye.
  vec2 within(bool right, vec2 film) const { return right ? film - vec2(right_origin) : film; }
};

/// Turns what a camera between the eyes sees into what an eye sees, ray by ray.
///
/// Flat pictures are off-axis pairs: the eyes look in parallel, and their windows on the plane at the
/// convergence distance C coincide. The eye at the offset s sees x + s (1 - z / C), with the view depth z of
/// x, where the camera between them sees x. This keeps lines, so it holds for the rays of any lens.
///
/// Pictures of all directions are omnidirectional stereo (Ishiguro et al. 1992, "Omni-Directional Stereo";
/// Peleg, Ben-Ezra and Pritch 2001): each column is seen by eyes that look straight at it, on a circle about
/// the camera. Where one looks far up or down there is no such circle for all: the distance of the eyes goes
/// to 0 between 60 and 75 degrees of elevation.
class StereoEyes {
public:
  StereoEyes(const Camera& camera, vec3 forward, vec3 right, vec3 up)
      : spherical_(camera.projection == Projection::spherical), position_(camera.position), forward_(forward),
        right_(right), up_(up), half_distance_(0.5f * camera.interocular_distance),
        convergence_(camera.convergence_distance > 0 ? 1 / camera.convergence_distance : 0) {}

  /// `ray` of unit direction, before and after.
  void shift(bool right_eye, Ray& ray) const {
    const float signed_half = right_eye ? half_distance_ : -half_distance_;
    if (spherical_) {
      const vec3 s = signed_half * right_of(ray.direction);
      ray.origin += s;
      ray.direction = glm::normalize(ray.direction - convergence_ * s);
      return;
    }
    const vec3 s = signed_half * right_;
    ray.origin += s * (1 - convergence_ * glm::dot(ray.origin - position_, forward_));
    ray.direction = glm::normalize(ray.direction - s * (convergence_ * glm::dot(ray.direction, forward_)));
  }

  /// The point that the camera between the eyes sees where the left eye sees `point`, in flat pictures.
  vec3 seen_between(vec3 point) const {
    const float depth = glm::dot(point - position_, forward_);
    return point + half_distance_ * (1 - convergence_ * depth) * right_;
  }

private:
  /// To the right of who looks along the horizon below `direction`; shorter near the poles.
  vec3 right_of(vec3 direction) const {
    constexpr float kMergeBegins = radians(60.0f), kMergeEnds = radians(75.0f);
    const float elevation = std::asin(std::clamp(glm::dot(direction, up_), -1.0f, 1.0f));
    const float merged = (std::abs(elevation) - kMergeBegins) / (kMergeEnds - kMergeBegins);
    if (merged >= 1) return vec3(0);
    // Half a cosine, so that nothing has an edge.
    const float kept = 0.5f + 0.5f * std::cos(kPi * std::max(merged, 0.0f));
    return kept * glm::normalize(glm::cross(direction, up_));
  }

  bool spherical_;
  vec3 position_, forward_, right_, up_;
  float half_distance_, convergence_; ///< convergence_: one over its distance; 0: parallel
};

} // namespace candela
