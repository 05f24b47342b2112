#pragma once
// Perspective or parallel rays, through a pinhole or a thin lens.

#include "render/camera/aperture.h"
#include "render/camera/camera_model.h"
#include "render/camera/camera_view.h"

namespace candela {

/// All weights are 1. Parallel rays begin on the plane through the camera; with a lens each is the middle of
/// a cone that meets on the plane of focus (a telecentric lens).
class ThinLensCamera final : public CameraModel {
public:
  ThinLensCamera(const Camera& camera, int width, int height)
      : view_(camera, width, height), aperture_(camera.blades, camera.blade_rotation) {}

  bool uses_lens_sample() const override { return view_.has_lens(); }

  std::optional<float> generate(vec2 film, vec2 u_lens, Ray& ray) const override {
    make_ray(film, u_lens, ray);
    return 1.0f;
  }

  /// The same without a call: a fifth of the time of a camera ray.
  [[gnu::always_inline]] inline void make_ray(vec2 film, vec2 u_lens, Ray& ray) const {
    const vec3 shift = view_.shift(film);
    vec3 origin = view_.orthographic() ? view_.position() + shift : view_.position();
    // Meets the plane of focus at t = focus_distance.
    vec3 direction = view_.orthographic() ? view_.forward() : view_.forward() + shift;
    if (view_.has_lens()) {
      const vec2 lens = aperture_.sample(u_lens) * view_.aperture_radius();
      const vec3 offset = view_.right() * lens.x + view_.up() * lens.y;
      origin += offset;
      direction = direction * view_.focus_distance() - offset;
    }
    ray = {origin, 0, glm::normalize(direction), kInfinity};
  }

private:
  CameraView view_;
  Aperture aperture_;
};

} // namespace candela
