#pragma once
// The camera ray of a pixel's sample, for all who trace it: the image and what is gathered beside it.

#include "render/camera_rays.h"
#include "sampling/sampler.h"
#include "scene/document.h"

namespace candela {

class PixelRays {
public:
  explicit PixelRays(const Document& document)
      : film_(document.settings.film), camera_(document.scene.camera, film_.width, film_.height),
        gaussian_(film_.filter_radius / 3, film_.filter_radius) {}

  const CameraRays& camera() const { return camera_; }

  /// A sampler of the document's kind and seed.
  static Sampler sampler(const SamplerSettings& settings) {
    return {settings.type, static_cast<std::uint64_t>(settings.seed), settings.strata};
  }

  /// Starts the sampler at the sample and draws its place in the pixel's filter and on the lens.
  Ray start(uvec2 pixel, std::uint32_t sample, Sampler& sampler) const {
    sampler.start(pixel, sample);
    vec2 u = sampler.get_2d(Dimension::film);
    float radius = film_.filter_radius;
    vec2 offset = film_.filter == FilterType::box ? vec2(sample_box(u.x, radius), sample_box(u.y, radius))
                                                  : vec2(gaussian_.sample(u.x), gaussian_.sample(u.y));
    vec2 lens = camera_.has_lens() ? sampler.get_2d(Dimension::lens) : vec2(0);
    return camera_.ray(vec2(pixel) + 0.5f + offset, lens);
  }

private:
  FilmSettings film_;
  CameraRays camera_;
  TruncatedGaussian gaussian_;
};

} // namespace candela
