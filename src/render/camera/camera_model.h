#pragma once
// How a camera generates rays. A new model is a file that implements CameraModel, and a line in
// make_camera().

#include "core/ray.h"
#include "scene/scene_desc.h"

#include <memory>
#include <optional>

namespace candela {

struct CameraRay {
  Ray ray;
  float weight = 1; ///< of the radiance that the ray brings
};

/// A pixel is the mean of weight times radiance over film positions and lens samples; those without a ray
/// count as black.
class CameraModel {
public:
  CameraModel() = default;
  virtual ~CameraModel() = default;
  CameraModel(const CameraModel&) = delete;
  CameraModel& operator=(const CameraModel&) = delete;

  /// Whether rays depend on u_lens, so that it has to be drawn.
  virtual bool uses_lens_sample() const = 0;

  /// Makes a world-space ray of unit direction through a film position (in pixels, (0, 0) is the top left
  /// corner) and the point of the lens that u_lens in [0, 1)^2 maps to, and returns its weight. Nothing where
  /// no light comes this way, as where a lens system stops the ray; `ray` then has no meaning. In place, for
  /// a copy of what has just been written by parts stalls the processor.
  virtual std::optional<float> generate(vec2 film, vec2 u_lens, Ray& ray) const = 0;

  /// The same as a value.
  std::optional<CameraRay> ray(vec2 film, vec2 u_lens) const {
    CameraRay result;
    const std::optional<float> weight = generate(film, u_lens, result.ray);
    if (!weight) return std::nullopt;
    result.weight = *weight;
    return result;
  }
};

/// The model that the scene's camera asks for, with a film of width x height pixels.
std::shared_ptr<const CameraModel> make_camera(const Camera& camera, int width, int height);

} // namespace candela
