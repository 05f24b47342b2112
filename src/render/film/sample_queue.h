#pragma once
// Collects samples into batches and adds their values to the films.

#include "render/film/pass_renderer.h"
#include "render/film/pixel_sampler.h"
#include "scene/light_layers.h"

namespace candela {

/// One thread's. A batch that is large enough for coherent traversal is evaluated at once; its values reach
/// the films in the order in which the samples were pushed.
class SampleQueue {
public:
  SampleQueue(PixelSampler& sampler, const PassJob& job, const PassFilms& films);

  /// Samples [begin, end) of the range's lattice in the window, all of them evaluated and added; none of
  /// those that a pixel has. Counts and the log go to `result`.
  void sample_all(const PixelBox& window, SampleRange samples, PassResult& result);

  /// From now on samples are dropped.
  bool stopped() const { return stopped_; }
  Film& image() const { return films_.image; }

private:
  void push(const SampleIndex& index, PassResult& result);
  void flush(PassResult& result);
  void add(const SampleIndex& index, const PixelSample& s, std::span<const PathSample> layers,
           PassResult& result);
  void add_layers(ivec2 at, const PixelSample& s, std::span<const PathSample> layers);

  PixelSampler& sampler_;
  const PassJob& job_;
  const PassFilms& films_;
  std::vector<SampleIndex> indices_;
  std::vector<PixelSample> samples_;
  LightMix mix_; ///< of the components; empty where that is the sum
  std::vector<vec3> layer_values_;
  bool stopped_ = false;
};

} // namespace candela
