#pragma once
// A camera for each eye.

#include "render/camera/camera_model.h"
#include "render/camera/camera_view.h"
#include "render/camera/stereo.h"

namespace candela {

/// Any camera, seen from the places of two eyes. A pixel of one eye's picture never sees what the other's
/// does, even where a filter reaches over the seam.
class StereoCamera final : public CameraModel {
public:
  /// `between` has a film of StereoPanes::size.
  StereoCamera(const Camera& camera, int width, int height, std::shared_ptr<const CameraModel> between)
      : panes_(camera.stereo, width, height), eyes_(CameraView(camera, width, height).eyes(camera)),
        between_(std::move(between)) {}

  bool uses_lens_sample() const override { return between_->uses_lens_sample(); }

  std::optional<float> generate(vec2 film, vec2 u_lens, Ray& ray) const override {
    return generate(panes_.is_right(film), film, u_lens, ray);
  }
  /// The same of that eye, beyond the edges of its picture too.
  std::optional<float> generate(bool right_eye, vec2 film, vec2 u_lens, Ray& ray) const {
    const std::optional<float> weight = between_->generate(panes_.within(right_eye, film), u_lens, ray);
    if (weight) eyes_.shift(right_eye, ray);
    return weight;
  }
  const StereoPanes& panes() const { return panes_; }

private:
  StereoPanes panes_;
  StereoEyes eyes_;
  std::shared_ptr<const CameraModel> between_;
};

} // namespace candela
