#pragma once
// The camera ray of a pixel's sample, for all who trace it: the image and what is gathered beside it.

#include "render/camera/camera_rays.h"
#include "sampling/filter.h"
#include "sampling/sampler.h"
#include "scene/document.h"

namespace candela {

struct PixelRay {
  Ray ray;
  float weight; ///< of what the ray brings, for the pixel's mean (FilterSample::weight)
};

class PixelRays {
public:
  explicit PixelRays(const Document& document)
      : camera_(document.scene.camera, document.settings.film.width, document.settings.film.height),
        filter_(document.settings.film.filter, document.settings.film.filter_radius) {}

  const CameraRays& camera() const { return camera_; }

  /// A sampler of the document's kind and seed.
  static Sampler sampler(const SamplerSettings& settings) {
    return {settings.type, static_cast<std::uint64_t>(settings.seed), settings.strata};
  }

  /// Starts the sampler at the sample and draws its place in the pixel's filter and on the lens.
  PixelRay start(uvec2 pixel, std::uint32_t sample, Sampler& sampler) const {
    sampler.start(pixel, sample);
    PixelRay result;
    result.weight = at(pixel, sampler.get_2d(Dimension::film),
                       camera_.has_lens() ? sampler.get_2d(Dimension::lens) : vec2(0), result.ray);
    return result;
  }
  /// The same from numbers that were drawn before. Makes the ray in place (a copy of what has just been
  /// written by parts stalls the processor) and returns its weight.
  float at(uvec2 pixel, vec2 film, vec2 lens, Ray& ray) const {
    FilterSample filter = filter_.sample(film);
    ray = camera_.ray(vec2(pixel) + 0.5f + filter.offset, lens);
    return filter.weight;
  }

private:
  CameraRays camera_;
  PixelFilter filter_;
};

} // namespace candela
