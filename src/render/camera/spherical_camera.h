#pragma once
// All directions at once.

#include "render/camera/camera_model.h"
#include "render/camera/camera_view.h"

namespace candela {

/// An equirectangular (latitude and longitude) picture of 360 by 180 degrees: forward is in its middle, right
/// of it lies to the right, up is the upper edge. Rays begin at the camera's position; only its basis
/// matters. All weights are 1, so that a pixel is the mean of radiance over itself, which is what an
/// environment map stores. An integral over directions weighs a pixel by pixel_solid_angle().
class SphericalCamera final : public CameraModel {
public:
  SphericalCamera(const Camera& camera, int width, int height)
      : view_(all_around(camera), width, height), width_(width), height_(height) {}

  bool uses_lens_sample() const override { return false; }

  std::optional<float> generate(vec2 film, vec2, Ray& ray) const override {
    ray = {view_.position(), 0, view_.spherical_direction(film), kInfinity};
    return 1.0f;
  }

  /// In steradians, of a pixel in that row: 2 pi / width (cos(theta_above) - cos(theta_below)).
  double pixel_solid_angle(int row) const {
    // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2)
    const double half = 0.5 * std::numbers::pi / height_, middle = (2 * row + 1) * half;
    return 4 * std::numbers::pi / width_ * std::sin(middle) * std::sin(half);
  }

private:
  static Camera all_around(Camera camera) {
    camera.projection = Projection::spherical;
    return camera;
  }

  CameraView view_;
  int width_, height_;
};

} // namespace candela
