#include "render/film/render_pass.h"

#include "render/camera/pixel_rays.h"
#include "render/integrators/ao_integrator.h"
#include "render/integrators/first_hit_view.h"
#include "render/integrators/path_integrator.h"
#include "render/integrators/whitted_integrator.h"

#include <omp.h>
#include <span>

namespace candela {

namespace {

/// Small enough that the last tiles of a pass keep all threads busy, large enough that a tile's rays are
/// neighbours.
constexpr int kTileSize = 16;
/// Pixels that adaptive sampling stops together: one pixel's own variance is too rough a guess (it would stop
/// those that were lucky). Tiles are made of whole blocks.
constexpr int kBlockSize = 8;
static_assert(kTileSize % kBlockSize == 0);

/// What one sample adds to its pixel.
struct PixelSample {
  vec3 value{0};
  PathSample parts; ///< of radiance, for the films of components
};

PathSample ambient_occlusion_sample(const RenderScene& scene, const Ray& ray, Sampler& sampler,
                                    const RenderSettings& settings, RayCounts& counts) {
  PathSample sample;
  sample.direct = vec3(ambient_occlusion(scene, ray, sampler, settings, counts));
  return sample;
}

struct SampleIndex {
  uvec2 pixel;
  std::uint32_t sample;
};

/// Evaluates samples, many at a time; one per thread.
class PixelSampler {
public:
  PixelSampler(const RenderScene& scene, const Document& document, const StopCondition& stop)
      : stop_(stop), scene_(scene), settings_(document.settings), view_(accumulated_view(settings_.view)),
        rays_(document), sampler_(PixelRays::sampler(settings_.sampler)),
        paths_(scene, path_settings(settings_)) {
    if (scene.has_media()) camera_media_ = media_at(scene, rays_.camera().position());
  }

  /// results[i] becomes what sample indices[i] adds to its pixel. False, and results of no use, where it was
  /// asked to stop.
  bool sample(std::span<const SampleIndex> indices, std::span<PixelSample> results, RayCounts& counts) {
    RayCounts made;
    evaluate(indices, results, made);
    if (stop_.asked()) return false;
    made.samples = indices.size();
    counts += made;
    return true;
  }

  PixelSample sample(const SampleIndex& index) {
    PixelSample result;
    RayCounts ignored;
    sample({&index, 1}, {&result, 1}, ignored);
    return result;
  }

private:
  void evaluate(std::span<const SampleIndex> indices, std::span<PixelSample> results, RayCounts& counts) {
    start(indices);
    if (!shows_light()) {
      view_first_hits(results, counts);
    } else if (follows_paths()) {
      parts_.resize(indices.size());
      if (!paths_.trace(starts_, parts_, counts, stop_)) return;
      for (std::size_t i = 0; i < indices.size(); ++i) show(parts_[i], results[i]);
    } else {
      for (std::size_t i = 0; i < indices.size() && !stop_.asked(); ++i)
        alone(starts_[i], results[i], counts);
    }
    for (std::size_t i = 0; i < indices.size(); ++i) { // as the pixel's filter weighs them
      if (weights_[i] == 1) continue;                  // always, for most filters
      results[i].value *= weights_[i];
      results[i].parts *= weights_[i];
    }
  }

  static PathSettings path_settings(const RenderSettings& settings) {
    PathSettings path = settings.path;
    if (settings.integrator == Integrator::direct)
      path.max_depth = path.max_depth < 0 ? 2 : std::min(path.max_depth, 2);
    return path;
  }

  bool shows_light() const {
    return view_ == View::radiance || view_ == View::depth_share || view_ == View::light_share;
  }
  bool follows_paths() const {
    return settings_.integrator == Integrator::path || settings_.integrator == Integrator::direct;
  }

  /// Makes the camera rays.
  void start(std::span<const SampleIndex> indices) {
    starts_.resize(indices.size(), {Ray(), sampler_});
    draws_.clear();
    for (std::size_t i = 0; i < indices.size(); ++i) {
      starts_[i].sampler.start(indices[i].pixel, indices[i].sample);
      draws_.push_back({&starts_[i].sampler, 0});
    }
    film_.resize(indices.size());
    lens_.assign(indices.size(), vec2(0));
    Sampler::get_2d(draws_, Dimension::film, film_);
    if (rays_.camera().has_lens()) Sampler::get_2d(draws_, Dimension::lens, lens_);
    weights_.resize(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
      weights_[i] = rays_.at(indices[i].pixel, film_[i], lens_[i], starts_[i].ray);
      if (!scene_.has_media()) continue;
      starts_[i].media = camera_media_;
      move_between(scene_, rays_.camera().position(), starts_[i].ray.origin, starts_[i].media);
    }
  }

  void view_first_hits(std::span<PixelSample> results, RayCounts& counts) {
    if (view_ == View::bvh_cost) {
      for (std::size_t i = 0; i < starts_.size() && !stop_.asked(); ++i)
        results[i] = {bvh_cost_value(scene_, starts_[i].ray, counts), {}};
      return;
    }
    camera_rays_.clear();
    for (const PathStart& start : starts_) camera_rays_.push_back(&start.ray);
    hits_.resize(starts_.size());
    scene_.geometry().accel().intersect(camera_rays_, hits_);
    counts.closest += starts_.size();
    for (std::size_t i = 0; i < starts_.size() && !stop_.asked(); ++i)
      results[i] = {first_hit_value(scene_, starts_[i].ray, hits_[i].t < kInfinity, hits_[i],
                                    rays_.camera().forward(), view_, starts_[i].sampler, counts),
                    {}};
  }

  /// Of an integrator that takes one sample after the other.
  void alone(PathStart& start, PixelSample& result, RayCounts& counts) {
    if (settings_.integrator == Integrator::whitted)
      show(whitted_radiance(scene_, start, start.sampler, settings_.path, direct_light_, counts, stop_),
           result);
    else
      show(ambient_occlusion_sample(scene_, start.ray, start.sampler, settings_, counts), result);
  }

  /// What the view makes of the light.
  void show(const PathSample& parts, PixelSample& result) const {
    result.parts = parts;
    switch (view_) {
    case View::depth_share:
      result.value = {luminance(parts.emitted + parts.direct), luminance(parts.one_bounce),
                      luminance(parts.more)};
      break;
    case View::light_share:
      result.value = {luminance(parts.light_sampled),
                      luminance(parts.direct + parts.indirect() - parts.light_sampled), 0};
      break;
    default:
      result.value = parts.radiance();
      if (settings_.path.clamp > 0) result.value = glm::min(result.value, settings_.path.clamp);
    }
  }

  StopPoll stop_;
  const RenderScene& scene_;
  const RenderSettings& settings_;
  View view_;
  PixelRays rays_;
  Sampler sampler_; ///< of the document's kind
  PathTracer paths_;
  ScalarDirectLight direct_light_;
  MediumStack camera_media_; ///< in scenes with absorption
  // Parallel to the samples in flight:
  std::vector<PathStart> starts_;
  std::vector<Sampler::Draw> draws_;
  std::vector<vec2> film_, lens_;
  std::vector<float> weights_;
  std::vector<PathSample> parts_;
  std::vector<const Ray*> camera_rays_;
  std::vector<Hit> hits_;
};

/// The path segment at which a sample stops being finite: that of the shortest path that is not, found by
/// tracing again. Once a sum is not finite it stays so, whatever is added: so the depth is doubled and then
/// halved in between. 0 where there is none.
int nonfinite_depth(const RenderScene& scene, const Document& document, const SampleIndex& index) {
  Document limited = document;
  auto is_finite_up_to = [&](int depth) {
    limited.settings.path.max_depth = depth;
    return is_finite(PixelSampler(scene, limited, {}).sample(index).value);
  };
  int finite = 0, last = 1;
  constexpr int kMost = 1 << 20;
  while (is_finite_up_to(last)) {
    if (last >= kMost) return 0;
    finite = last;
    last *= 2;
  }
  while (last - finite > 1) {
    const int middle = finite + (last - finite) / 2;
    (is_finite_up_to(middle) ? finite : last) = middle;
  }
  return last;
}

struct Window {
  int x0, y0, x1, y1;
};

/// The pixels of the frame, of which the film may hold a part.
Window clip(const CropWindow& crop, const Film& film) {
  const ivec2 lo = film.origin(), hi = lo + ivec2(film.width(), film.height());
  if (crop.width <= 0 || crop.height <= 0) return {lo.x, lo.y, hi.x, hi.y};
  return {std::max(crop.x, lo.x), std::max(crop.y, lo.y), std::min(crop.x + crop.width, hi.x),
          std::min(crop.y + crop.height, hi.y)};
}

/// What a pass needs at every tile.
struct PassJob {
  const RenderScene& scene;
  const Document& document;
  const SampleRange& range;
  Film& film;
  const std::array<Film*, 3>& components;
};

/// Collects samples until there are enough to be worth a batch, and adds what comes of them to the film in
/// the order that they came in.
class SampleQueue {
public:
  /// Enough that the last, short paths of a batch hardly matter, few enough for the second-level cache.
  static constexpr std::size_t kSize = 256;

  SampleQueue(PixelSampler& sampler, const PassJob& job) : sampler_(sampler), job_(job) {
    indices_.reserve(kSize);
    samples_.resize(kSize);
  }

  /// Unless the pixel has this sample.
  void push(const SampleIndex& index, PassResult& result) {
    const ivec2 at = ivec2(index.pixel) - job_.film.origin();
    if (job_.film.tried(at.x, at.y) > index.sample) return;
    indices_.push_back(index);
    if (indices_.size() == kSize) flush(result);
  }

  void flush(PassResult& result) {
    if (indices_.empty()) return;
    stopped_ = stopped_ || !sampler_.sample(indices_, {samples_.data(), indices_.size()}, result.rays);
    for (std::size_t i = 0; i < indices_.size() && !stopped_; ++i) add(indices_[i], samples_[i], result);
    indices_.clear();
  }

  /// What is pushed is not sampled any more.
  bool stopped() const { return stopped_; }

private:
  void add(const SampleIndex& index, const PixelSample& s, PassResult& result) {
    const ivec2 at = ivec2(index.pixel) - job_.film.origin();
    const int x = at.x, y = at.y;
    if (is_finite(s.value)) {
      job_.film.add(x, y, s.value);
      const vec3 parts[3] = {s.parts.emitted, s.parts.direct, s.parts.indirect()};
      for (std::size_t c = 0; c < 3; ++c)
        if (job_.components[c] != nullptr) job_.components[c]->add(x, y, parts[c]);
      return;
    }
    job_.film.add_nonfinite(x, y);
    ++result.nonfinite.count;
    if (result.nonfinite.records.size() < NonFiniteLog::kMaxRecords)
      result.nonfinite.records.push_back(
          {index.pixel, index.sample, nonfinite_depth(job_.scene, job_.document, index)});
  }

  PixelSampler& sampler_;
  const PassJob& job_;
  std::vector<SampleIndex> indices_;
  std::vector<PixelSample> samples_;
  bool stopped_ = false;
};

void sample_window(SampleQueue& queue, const Window& window, std::uint32_t begin, std::uint32_t end,
                   const PassJob& job, PassResult& result) {
  const int step = job.range.lattice, skip = job.range.skip_lattice;
  auto up = [&](int v) { return (v + step - 1) / step * step; };
  for (int y = up(window.y0); y < window.y1; y += step)
    for (int x = up(window.x0); x < window.x1; x += step) {
      if (skip > 0 && x % skip == 0 && y % skip == 0) continue;
      for (std::uint32_t i = begin; i < end && !queue.stopped(); ++i) queue.push({uvec2(x, y), i}, result);
    }
  queue.flush(result);
}

/// Whether the block is as good as the settings ask for.
bool block_converged(const Film& film, const Window& block, float error) {
  const ivec2 origin = film.origin();
  double sum = 0;
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) sum += film.relative_variance(x - origin.x, y - origin.y);
  return sum <= static_cast<double>(error) * static_cast<double>(error) *
                    ((block.x1 - block.x0) * (block.y1 - block.y0));
}

/// Samples the block up to the end of the range or to where it converges. That is asked only at sample
/// numbers that are multiples of min_spp, so the answer does not depend on how passes divide the samples.
/// Returns whether the block has stopped.
bool sample_adaptively(SampleQueue& queue, const Window& block, const PassJob& job, PassResult& result) {
  const AdaptiveSettings& adaptive = job.document.settings.adaptive;
  const ivec2 origin = job.film.origin();
  if (job.film.stopped(block.x0 - origin.x, block.y0 - origin.y)) return true;
  auto every = static_cast<std::uint32_t>(adaptive.min_spp);
  for (std::uint32_t i = job.range.begin; i < job.range.end;) {
    std::uint32_t check = (i / every + 1) * every, end = std::min(check, job.range.end);
    sample_window(queue, block, i, end, job, result);
    if (queue.stopped()) return false;
    i = end;
    // Where the block has more, an earlier pass that ended early has asked.
    const bool asks = i == check && job.film.tried(block.x0 - origin.x, block.y0 - origin.y) == check;
    if (asks && block_converged(job.film, block, adaptive.error)) {
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) job.film.stop(x - origin.x, y - origin.y);
      return true;
    }
  }
  return false;
}

void render_tile(SampleQueue& queue, const Window& tile, const PassJob& job, PassResult& result) {
  if (job.document.settings.adaptive.error <= 0 || job.range.lattice > 1 || job.range.skip_lattice > 0) {
    sample_window(queue, tile, job.range.begin, job.range.end, job, result);
    return;
  }
  result.converged = true;
  for (int y = tile.y0; y < tile.y1; y = (y / kBlockSize + 1) * kBlockSize)
    for (int x = tile.x0; x < tile.x1; x = (x / kBlockSize + 1) * kBlockSize) {
      Window block{x, y, std::min((x / kBlockSize + 1) * kBlockSize, tile.x1),
                   std::min((y / kBlockSize + 1) * kBlockSize, tile.y1)};
      result.converged &= sample_adaptively(queue, block, job, result);
    }
}

} // namespace

PassResult render_pass(const RenderScene& scene, const Document& document, const SampleRange& range,
                       Film& film, const StopCondition& stop, const PassOptions& options) {
  Window window = clip(options.crop, film);
  // The grid of tiles is the frame's, whatever window of it is rendered.
  int first_column = window.x0 / kTileSize, first_row = window.y0 / kTileSize;
  int columns = (window.x1 + kTileSize - 1) / kTileSize - first_column;
  int rows = (window.y1 + kTileSize - 1) / kTileSize - first_row;
  int tiles = std::max(columns, 0) * std::max(rows, 0);
  std::vector<PassResult> results(static_cast<std::size_t>(tiles));
  int threads = options.threads > 0 ? options.threads : omp_get_num_procs();
  const PassJob job{scene, document, range, film, options.components};
  bool stopped = false;
#pragma omp parallel num_threads(threads) reduction(|| : stopped)
  {
    PixelSampler sampler(scene, document, stop);
    SampleQueue queue(sampler, job);
#pragma omp for schedule(dynamic, 1)
    for (int t = 0; t < tiles; ++t) {
      if (queue.stopped() || stop.asked()) {
        stopped = true;
        continue;
      }
      int x = (first_column + t % columns) * kTileSize, y = (first_row + t / columns) * kTileSize;
      Window tile{std::max(x, window.x0), std::max(y, window.y0), std::min(x + kTileSize, window.x1),
                  std::min(y + kTileSize, window.y1)};
      render_tile(queue, tile, job, results[static_cast<std::size_t>(t)]);
      stopped = stopped || queue.stopped();
    }
  }
  PassResult total;
  total.converged = !stopped;
  for (const PassResult& r : results) { // in tile order, so that the log does not depend on threads
    total.rays += r.rays;
    total.converged &= r.converged;
    total.nonfinite.count += r.nonfinite.count;
    for (const NonFiniteSample& s : r.nonfinite.records)
      if (total.nonfinite.records.size() < NonFiniteLog::kMaxRecords) total.nonfinite.records.push_back(s);
  }
  total.completed = !stopped;
  return total;
}

vec3 replay_sample(const RenderScene& scene, const Document& document, uvec2 pixel, std::uint32_t sample) {
  return PixelSampler(scene, document, {}).sample({pixel, sample}).value;
}

float display_scale(const RenderScene& scene, const RenderSettings& settings) {
  if (settings.view != View::depth) return 1;
  Bounds3 bounds = scene.geometry().finite_bounds();
  float diagonal = bounds.empty() ? 0 : glm::length(bounds.diagonal());
  return diagonal > 0 ? 1 / diagonal : 1;
}

} // namespace candela
