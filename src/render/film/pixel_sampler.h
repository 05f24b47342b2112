#pragma once
// Evaluates samples: from the indices of a pixel and a sample to what the pixel's film is given.

#include "core/stop_condition.h"
#include "render/camera/camera_view.h"
#include "render/camera/pixel_rays.h"
#include "render/integrators/path_integrator.h"
#include "render/integrators/whitted_integrator.h"

#include <span>

namespace candela {

struct SampleIndex {
  uvec2 pixel; ///< of the frame
  std::uint32_t sample;
};

/// What one sample adds to its pixel.
struct PixelSample {
  vec3 value{0};    ///< of the view
  PathSample parts; ///< of radiance, for the films of components
};

/// Many samples at a time; one per thread. The integrator and the view are chosen once a batch.
class PixelSampler {
public:
  /// Refers to the scene and the document, which must outlive it. `camera`: in place of the document's.
  PixelSampler(const RenderScene& scene, const Document& document, const StopCondition& stop,
               std::shared_ptr<const CameraModel> camera = nullptr);

  /// results[i] becomes what sample indices[i] adds to its pixel. False, and results of no use, where it was
  /// asked to stop.
  bool sample(std::span<const SampleIndex> indices, std::span<PixelSample> results, RayCounts& counts);
  PixelSample sample(const SampleIndex& index);

  /// From now on the samples are kept by the scene's light layers, too.
  void keep_layers() { layer_count_ = scene_.layer_count(); }
  /// Those of the i-th of the newest results; none where they are not kept. The clamp is not applied.
  std::span<const PathSample> layers(std::size_t i) const {
    return {layers_.data() + i * layer_count_, layer_count_};
  }

private:
  void evaluate(std::span<const SampleIndex> indices, std::span<PixelSample> results, RayCounts& counts);
  void start(std::span<const SampleIndex> indices);
  RayCone pixel_cone(const Ray& ray) const;
  bool shows_light() const;
  bool follows_paths() const;
  void view_first_hits(std::span<PixelSample> results, RayCounts& counts);
  void sample_singly(PathStart& start, PixelSample& result, std::span<PathSample> layers, RayCounts& counts);
  void place_layers(std::size_t count);
  void show(const PathSample& parts, PixelSample& result) const;

  StopPoll stop_;
  const RenderScene& scene_;
  const RenderSettings& settings_;
  View view_;
  CameraView camera_view_;
  PixelRays rays_;
  Sampler sampler_; ///< of the document's kind
  PathTracer paths_;
  ScalarDirectLight direct_light_;
  MediaNear camera_media_;
  // Parallel to the samples in flight:
  std::vector<Sampler::Draw> draws_;
  std::vector<vec2> film_, lens_;
  std::vector<float> time_;
  std::size_t layer_count_ = 0;    ///< 0: they are not kept
  std::vector<PathSample> layers_; ///< so many of each
  // Parallel to those of them that have a ray:
  std::vector<PathStart> starts_;
  std::vector<std::size_t> sample_of_; ///< index into the samples
  std::vector<float> weights_;
  std::vector<PathSample> parts_;
  std::vector<const Ray*> camera_rays_;
  std::vector<Hit> hits_;
};

} // namespace candela
