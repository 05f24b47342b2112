#pragma once
// The camera ray of a pixel's sample, for all who trace it: the image and what is gathered beside it.

#include "render/camera/camera_motion.h"
#include "render/camera/stereo_camera.h"
#include "render/camera/thin_lens_camera.h"
#include "sampling/filter.h"
#include "sampling/sampler.h"
#include "scene/document.h"

#include <utility>

namespace candela {

class PixelRays {
public:
  /// Of the document's camera, or of another in its place.
  explicit PixelRays(const Document& document, std::shared_ptr<const CameraModel> camera = nullptr)
      : camera_(camera ? std::move(camera)
                       : make_camera(document.scene.camera, document.settings.film.width,
                                     document.settings.film.height)),
        thin_lens_(dynamic_cast<const ThinLensCamera*>(camera_.get())),
        stereo_(dynamic_cast<const StereoCamera*>(camera_.get())),
        uses_lens_sample_(camera_->uses_lens_sample()), shutter_open_(document.scene.camera.shutter_open),
        shutter_close_(document.scene.camera.shutter_close),
        motion_(document.scene.camera, document.settings.film.width, document.settings.film.height),
        filter_(document.settings.film.filter, document.settings.film.filter_radius) {}

  bool uses_lens_sample() const { return uses_lens_sample_; }
  /// Whether samples have times of their own, so that those have to be drawn.
  bool uses_time_sample() const { return shutter_close_ != shutter_open_; }
  const CameraMotion& motion() const { return motion_; }

  /// A sampler of the document's kind and seed.
  static Sampler sampler(const SamplerSettings& settings) {
    return {settings.type, static_cast<std::uint64_t>(settings.seed), settings.strata};
  }

  /// Starts the sampler at the sample and draws its place in the pixel's filter and on the lens, and
  /// its time. The weight is for the pixel's mean (FilterSample::weight). Nothing where the camera has no
  /// ray: the sample is black.
  std::optional<CameraRay> start(uvec2 pixel, std::uint32_t sample, Sampler& sampler) const {
    sampler.start(pixel, sample);
    const vec2 film = sampler.get_2d(Dimension::film);
    const vec2 lens = uses_lens_sample_ ? sampler.get_2d(Dimension::lens) : vec2(0);
    const float time = uses_time_sample() ? sampler.get_1d(Dimension::time) : 0;
    CameraRay result;
    const std::optional<float> weight = at(pixel, film, lens, time, result.ray);
    if (!weight) return std::nullopt;
    result.weight = *weight;
    return result;
  }
  /// The same from numbers that were drawn before; see CameraModel::generate.
  /// `u_time` in [0, 1) is where the time lies between the opening and the closing of the shutter.
  std::optional<float> at(uvec2 pixel, vec2 film, vec2 lens, float u_time, Ray& ray) const {
    const FilterSample filter = filter_.sample(film);
    vec2 position = vec2(pixel) + 0.5f + filter.offset;
    const float time = shutter_open_ + u_time * (shutter_close_ - shutter_open_);
    const bool right_eye = stereo_ != nullptr && stereo_->panes().is_right(vec2(pixel));
    if (motion_.moves()) position = motion_.film_at(right_eye, position, time);
    if (thin_lens_ != nullptr) { // of weight 1
      thin_lens_->make_ray(position, lens, ray);
      set_time(ray, time);
      return filter.weight;
    }
    const std::optional<float> weight = stereo_ != nullptr ? stereo_->generate(right_eye, position, lens, ray)
                                                           : camera_->generate(position, lens, ray);
    if (!weight) return std::nullopt;
    set_time(ray, time);
    return filter.weight * *weight;
  }

private:
  void set_time(Ray& ray, float time) const {
    ray.time = time;
    if (motion_.moves()) motion_.move(ray);
  }

  std::shared_ptr<const CameraModel> camera_;
  /// The camera, if it is one.
  const ThinLensCamera* thin_lens_;
  const StereoCamera* stereo_; ///< likewise
  bool uses_lens_sample_;
  float shutter_open_, shutter_close_;
  CameraMotion motion_;
  PixelFilter filter_;
};

} // namespace candela
