#pragma once
// A camera that moves while the shutter is open: what becomes of the rays of one that stands still, of
// whatever model.

#include "core/moving_transform.h"
#include "core/ray.h"
#include "render/camera/stereo.h"
#include "scene/scene_desc.h"

namespace candela {

/// From the pose of time 0 to that of another time: the rotation about the camera's position and its way, as
/// MovingTransform has them. Lens and focus stay as they are.
class CameraMotion {
public:
  /// Of a camera that is valid at the times 0 and 1.
  CameraMotion(const Camera& camera, int width, int height);

  bool moves() const { return moves_; }

  /// Where the camera of time 0 has the ray that this one has at a film position: another field of view shows
  /// more or less, about the middle of the film, or of that eye's picture.
  vec2 film_at(bool right_eye, vec2 film, float time) const;
  /// Brings a ray of the camera of time 0 to the time of the ray.
  void move(Ray& ray) const;
  /// The direction at time 0 of one that moves with the camera.
  vec3 direction_at_start(vec3 direction, float time) const;
  vec3 direction_at(vec3 direction_at_start, float time) const;

private:
  bool moves_ = false;
  MovingTransform pose_;
  StereoPanes panes_;
  bool zooms_ = false;
  float tangent_ = 1; ///< of half the field of view, at time 0
  float fov_ = 1, fov_change_ = 0;
};

} // namespace candela
