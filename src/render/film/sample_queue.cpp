#include "render/film/sample_queue.h"

#include "render/film/replay.h"

namespace candela {

namespace {

/// Enough that the last, short paths of a batch hardly matter, few enough for the second-level cache.
constexpr std::size_t kBatch = 256;

} // namespace

SampleQueue::SampleQueue(PixelSampler& sampler, const PassJob& job, const PassFilms& films)
    : sampler_(sampler), job_(job), films_(films) {
  indices_.reserve(kBatch);
  samples_.resize(kBatch);
  if (films.layers == nullptr) return;
  sampler_.keep_layers();
  layer_values_.resize(films.layers->layers());
  LightMix mix = light_mix(job.document.scene, job.scene.light_layers());
  if (!is_plain(mix)) mix_ = std::move(mix);
}

void SampleQueue::sample_all(const PixelBox& window, SampleRange samples, PassResult& result) {
  const int step = samples.lattice, skip = samples.skip_lattice;
  auto up = [&](int v) { return (v + step - 1) / step * step; };
  for (int y = up(window.y0); y < window.y1; y += step)
    for (int x = up(window.x0); x < window.x1; x += step) {
      if (skip > 0 && x % skip == 0 && y % skip == 0) continue;
      for (std::uint32_t i = samples.begin; i < samples.end && !stopped_; ++i) push({uvec2(x, y), i}, result);
    }
  flush(result);
}

void SampleQueue::push(const SampleIndex& index, PassResult& result) {
  const ivec2 at = ivec2(index.pixel) - films_.image.origin();
  if (films_.image.tried(at.x, at.y) > index.sample) return;
  indices_.push_back(index);
  if (indices_.size() == kBatch) flush(result);
}

void SampleQueue::flush(PassResult& result) {
  if (indices_.empty()) return;
  stopped_ = stopped_ || !sampler_.sample(indices_, {samples_.data(), indices_.size()}, result.rays);
  for (std::size_t i = 0; i < indices_.size() && !stopped_; ++i)
    add(indices_[i], samples_[i], sampler_.layers(i), result);
  indices_.clear();
}

void SampleQueue::add(const SampleIndex& index, const PixelSample& s, std::span<const PathSample> layers,
                      PassResult& result) {
  const ivec2 at = ivec2(index.pixel) - films_.image.origin();
  if (!is_finite(s.value)) {
    films_.image.add_nonfinite(at.x, at.y);
    // Its depth takes tracing it again, so only that of those that the log keeps is found.
    const int depth = result.nonfinite.full() ? 0 : nonfinite_depth(job_, index);
    result.nonfinite.add({index.pixel, index.sample, depth});
    return;
  }
  if (films_.layers != nullptr) add_layers(at, s, layers);
  films_.image.add(at.x, at.y, s.value);
  vec3 parts[3] = {s.parts.emitted, s.parts.direct, s.parts.indirect()};
  if (!mix_.empty()) {
    std::ranges::fill(parts, vec3(0));
    for (std::size_t i = 0; i < layers.size(); ++i) {
      parts[0] += mix_[i] * layers[i].emitted;
      parts[1] += mix_[i] * layers[i].direct;
      parts[2] += mix_[i] * layers[i].indirect();
    }
  }
  for (std::size_t c = 0; c < 3; ++c)
    if (films_.components[c] != nullptr) films_.components[c]->add(at.x, at.y, parts[c]);
}

/// Before the image: the layers count by its samples. Where path.clamp has cut the sample, all layers lose
/// the same share, so that they still add up to it.
void SampleQueue::add_layers(ivec2 at, const PixelSample& s, std::span<const PathSample> layers) {
  vec3 share(1);
  if (job_.document.settings.path.clamp > 0) {
    const vec3 whole = s.parts.radiance();
    for (int c = 0; c < 3; ++c)
      if (s.value[c] < whole[c]) share[c] = s.value[c] / whole[c];
  }
  for (std::size_t i = 0; i < layers.size(); ++i) layer_values_[i] = share * layers[i].radiance();
  films_.layers->add(at.x, at.y, films_.image.count(at.x, at.y), layer_values_);
}

} // namespace candela
