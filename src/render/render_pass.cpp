#include "render/render_pass.h"

#include "render/ao_integrator.h"
#include "render/first_hit_view.h"
#include "render/path_integrator.h"
#include "render/pixel_rays.h"
#include "render/whitted_integrator.h"

#include <omp.h>

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

/// Samples one pixel after another; one per tile.
class PixelSampler {
public:
  PixelSampler(const RenderScene& scene, const Document& document)
      : scene_(scene), settings_(document.settings), view_(accumulated_view(settings_.view)), rays_(document),
        sampler_(PixelRays::sampler(settings_.sampler)) {}

  PixelSample sample(uvec2 pixel, std::uint32_t index, RayCounts& counts) {
    return sample(pixel, index, counts, settings_);
  }

  /// The path segment at which a sample stops being finite: the shortest path that is not (found by tracing
  /// again).
  int nonfinite_depth(uvec2 pixel, std::uint32_t index) {
    RayCounts ignored;
    RenderSettings limited = settings_;
    for (int depth = 1; depth < 1000; ++depth) {
      limited.path.max_depth = depth;
      if (!is_finite(sample(pixel, index, ignored, limited).value)) return depth;
    }
    return 0;
  }

private:
  PixelSample sample(uvec2 pixel, std::uint32_t index, RayCounts& counts, const RenderSettings& settings) {
    PixelRay start = rays_.start(pixel, index, sampler_);
    ++counts.samples;
    PixelSample result = along(start.ray, settings, counts);
    result.value *= start.weight;
    result.parts *= start.weight;
    return result;
  }

  /// What the ray sees, before the filter weighs it.
  PixelSample along(const Ray& ray, const RenderSettings& settings, RayCounts& counts) {
    PixelSample result;
    if (view_ != View::radiance && view_ != View::depth_share && view_ != View::light_share) {
      result.value = first_hit_value(scene_, ray, rays_.camera().forward(), view_, sampler_, counts);
      return result;
    }
    PathSample& parts = result.parts = estimate(ray, settings, counts);
    switch (view_) {
    case View::depth_share:
      result.value = {luminance(parts.emitted + parts.direct), luminance(parts.one_bounce),
                      luminance(parts.more)};
      break;
    case View::light_share:
      result.value = {luminance(parts.aimed), luminance(parts.direct + parts.indirect() - parts.aimed), 0};
      break;
    default:
      result.value = parts.radiance();
      if (settings.path.clamp > 0) result.value = glm::min(result.value, settings.path.clamp);
    }
    return result;
  }

  PathSample estimate(const Ray& ray, const RenderSettings& settings, RayCounts& counts) {
    switch (settings.integrator) {
    case Integrator::path: return path_radiance(scene_, ray, sampler_, settings.path, counts);
    case Integrator::direct: {
      PathSettings direct = settings.path;
      direct.max_depth = direct.max_depth < 0 ? 2 : std::min(direct.max_depth, 2);
      return path_radiance(scene_, ray, sampler_, direct, counts);
    }
    case Integrator::whitted: return whitted_radiance(scene_, ray, sampler_, settings.path, counts);
    case Integrator::ao: return ambient_occlusion_sample(scene_, ray, sampler_, settings, counts);
    }
    return {};
  }

  const RenderScene& scene_;
  const RenderSettings& settings_;
  View view_;
  PixelRays rays_;
  Sampler sampler_;
};

struct Window {
  int x0, y0, x1, y1;
};

Window clip(const CropWindow& crop, const Film& film) {
  if (crop.width <= 0 || crop.height <= 0) return {0, 0, film.width(), film.height()};
  return {std::max(crop.x, 0), std::max(crop.y, 0), std::min(crop.x + crop.width, film.width()),
          std::min(crop.y + crop.height, film.height())};
}

/// What a pass needs at every tile.
struct PassJob {
  const SampleRange& range;
  const AdaptiveSettings& adaptive;
  Film& film;
  const std::array<Film*, 3>& components;
};

void sample_pixel(PixelSampler& sampler, uvec2 pixel, std::uint32_t begin, std::uint32_t end,
                  const PassJob& job, PassResult& result) {
  int x = static_cast<int>(pixel.x), y = static_cast<int>(pixel.y);
  for (std::uint32_t i = begin; i < end; ++i) {
    PixelSample s = sampler.sample(pixel, i, result.rays);
    if (is_finite(s.value)) {
      job.film.add(x, y, s.value);
      const vec3 parts[3] = {s.parts.emitted, s.parts.direct, s.parts.indirect()};
      for (std::size_t c = 0; c < 3; ++c)
        if (job.components[c] != nullptr) job.components[c]->add(x, y, parts[c]);
      continue;
    }
    job.film.add_nonfinite(x, y);
    ++result.nonfinite.count;
    if (result.nonfinite.records.size() < NonFiniteLog::kMaxRecords)
      result.nonfinite.records.push_back({pixel, i, sampler.nonfinite_depth(pixel, i)});
  }
}

void sample_window(PixelSampler& sampler, const Window& window, std::uint32_t begin, std::uint32_t end,
                   const PassJob& job, PassResult& result) {
  const int step = job.range.lattice, skip = job.range.skip_lattice;
  auto up = [&](int v) { return (v + step - 1) / step * step; };
  for (int y = up(window.y0); y < window.y1; y += step)
    for (int x = up(window.x0); x < window.x1; x += step) {
      if (skip > 0 && x % skip == 0 && y % skip == 0) continue;
      sample_pixel(sampler, uvec2(x, y), begin, end, job, result);
    }
}

/// Whether the block is as good as the settings ask for.
bool block_converged(const Film& film, const Window& block, float error) {
  double sum = 0;
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) sum += film.relative_variance(x, y);
  return sum <= static_cast<double>(error) * static_cast<double>(error) *
                    ((block.x1 - block.x0) * (block.y1 - block.y0));
}

/// Samples the block up to the end of the range or to where it converges. That is asked only at sample
/// numbers that are multiples of min_spp, so the answer does not depend on how passes divide the samples.
/// Returns whether the block has stopped.
bool sample_adaptively(PixelSampler& sampler, const Window& block, const PassJob& job, PassResult& result) {
  if (job.film.stopped(block.x0, block.y0)) return true;
  auto every = static_cast<std::uint32_t>(job.adaptive.min_spp);
  for (std::uint32_t i = job.range.begin; i < job.range.end;) {
    std::uint32_t check = (i / every + 1) * every, end = std::min(check, job.range.end);
    sample_window(sampler, block, i, end, job, result);
    i = end;
    if (i == check && block_converged(job.film, block, job.adaptive.error)) {
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) job.film.stop(x, y);
      return true;
    }
  }
  return false;
}

void render_tile(PixelSampler& sampler, const Window& tile, const PassJob& job, PassResult& result) {
  if (job.adaptive.error <= 0 || job.range.lattice > 1 || job.range.skip_lattice > 0) {
    sample_window(sampler, tile, job.range.begin, job.range.end, job, result);
    return;
  }
  result.converged = true;
  for (int y = tile.y0; y < tile.y1; y = (y / kBlockSize + 1) * kBlockSize)
    for (int x = tile.x0; x < tile.x1; x = (x / kBlockSize + 1) * kBlockSize) {
      Window block{x, y, std::min((x / kBlockSize + 1) * kBlockSize, tile.x1),
                   std::min((y / kBlockSize + 1) * kBlockSize, tile.y1)};
      result.converged &= sample_adaptively(sampler, block, job, result);
    }
}

} // namespace

PassResult render_pass(const RenderScene& scene, const Document& document, const SampleRange& range,
                       Film& film, const std::atomic<bool>& stop, const PassOptions& options) {
  Window window = clip(options.crop, film);
  // The grid of tiles is the film's, whatever window of it is rendered.
  int first_column = window.x0 / kTileSize, first_row = window.y0 / kTileSize;
  int columns = (window.x1 + kTileSize - 1) / kTileSize - first_column;
  int rows = (window.y1 + kTileSize - 1) / kTileSize - first_row;
  int tiles = std::max(columns, 0) * std::max(rows, 0);
  std::vector<PassResult> results(static_cast<std::size_t>(tiles));
  int threads = options.threads > 0 ? options.threads : omp_get_num_procs();
  const PassJob job{range, document.settings.adaptive, film, options.components};
  bool stopped = false;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(|| : stopped)
  for (int t = 0; t < tiles; ++t) {
    if (stop.load(std::memory_order_relaxed)) {
      stopped = true;
      continue;
    }
    int x = (first_column + t % columns) * kTileSize, y = (first_row + t / columns) * kTileSize;
    Window tile{std::max(x, window.x0), std::max(y, window.y0), std::min(x + kTileSize, window.x1),
                std::min(y + kTileSize, window.y1)};
    PixelSampler sampler(scene, document);
    render_tile(sampler, tile, job, results[static_cast<std::size_t>(t)]);
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
  RayCounts ignored;
  return PixelSampler(scene, document).sample(pixel, sample, ignored).value;
}

float display_scale(const RenderScene& scene, const RenderSettings& settings) {
  if (settings.view != View::depth) return 1;
  Bounds3 bounds = scene.geometry().finite_bounds();
  float diagonal = bounds.empty() ? 0 : glm::length(bounds.diagonal());
  return diagonal > 0 ? 1 / diagonal : 1;
}

} // namespace candela
