#include "render/render_pass.h"

#include "render/camera_rays.h"

#include <omp.h>

namespace candela {

namespace {

/// Small enough that the last tiles of a pass keep all threads busy, large enough that a tile's rays are
/// neighbours.
constexpr int kTileSize = 16;

/// Samples one pixel after another; one per tile.
class PixelSampler {
public:
  PixelSampler(const RenderScene& scene, const Document& document)
      : scene_(scene), settings_(document.settings),
        camera_(document.scene.camera, settings_.film.width, settings_.film.height),
        sampler_(settings_.sampler.type, static_cast<std::uint64_t>(settings_.sampler.seed),
                 settings_.sampler.strata),
        gaussian_(settings_.film.filter_radius / 3, settings_.film.filter_radius) {}

  vec3 sample(uvec2 pixel, std::uint32_t index, RayCounts& counts) {
    return sample(pixel, index, counts, settings_.path);
  }

  vec3 sample(uvec2 pixel, std::uint32_t index, RayCounts& counts, const PathSettings& path) {
    sampler_.start(pixel, index);
    vec2 u = sampler_.get_2d(Dimension::film);
    float radius = settings_.film.filter_radius;
    vec2 offset = settings_.film.filter == FilterType::box
                      ? vec2(sample_box(u.x, radius), sample_box(u.y, radius))
                      : vec2(gaussian_.sample(u.x), gaussian_.sample(u.y));
    vec2 lens = camera_.has_lens() ? sampler_.get_2d(Dimension::lens) : vec2(0);
    Ray ray = camera_.ray(vec2(pixel) + 0.5f + offset, lens);
    ++counts.samples;
    if (settings_.view != View::radiance)
      return view_value(scene_, ray, camera_.forward(), settings_.view, sampler_, counts);
    return path_radiance(scene_, ray, sampler_, path, counts);
  }

  /// The path segment at which a sample stops being finite: the shortest path that is not (found by tracing
  /// again).
  int nonfinite_depth(uvec2 pixel, std::uint32_t index) {
    RayCounts ignored;
    PathSettings path = settings_.path;
    for (int depth = 1; depth < 1000; ++depth) {
      path.max_depth = depth;
      if (!is_finite(sample(pixel, index, ignored, path))) return depth;
    }
    return 0;
  }

private:
  const RenderScene& scene_;
  const RenderSettings& settings_;
  CameraRays camera_;
  Sampler sampler_;
  TruncatedGaussian gaussian_;
};

struct Window {
  int x0, y0, x1, y1;
};

Window clip(const CropWindow& crop, const Film& film) {
  if (crop.width <= 0 || crop.height <= 0) return {0, 0, film.width(), film.height()};
  return {std::max(crop.x, 0), std::max(crop.y, 0), std::min(crop.x + crop.width, film.width()),
          std::min(crop.y + crop.height, film.height())};
}

void render_tile(PixelSampler& sampler, const Window& tile, const SampleRange& range, Film& film,
                 PassResult& result) {
  auto up = [&](int v) { return (v + range.lattice - 1) / range.lattice * range.lattice; };
  for (int y = up(tile.y0); y < tile.y1; y += range.lattice)
    for (int x = up(tile.x0); x < tile.x1; x += range.lattice) {
      if (range.skip_lattice > 0 && x % range.skip_lattice == 0 && y % range.skip_lattice == 0) continue;
      uvec2 pixel(x, y);
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        vec3 radiance = sampler.sample(pixel, i, result.rays);
        if (is_finite(radiance)) {
          film.add(x, y, radiance);
          continue;
        }
        ++result.nonfinite.count;
        if (result.nonfinite.records.size() < NonFiniteLog::kMaxRecords)
          result.nonfinite.records.push_back({pixel, i, sampler.nonfinite_depth(pixel, i)});
      }
    }
}

} // namespace

PassResult render_pass(const RenderScene& scene, const Document& document, const SampleRange& range,
                       Film& film, const std::atomic<bool>& stop, const PassOptions& options) {
  Window window = clip(options.crop, film);
  int columns = (window.x1 - window.x0 + kTileSize - 1) / kTileSize;
  int rows = (window.y1 - window.y0 + kTileSize - 1) / kTileSize;
  int tiles = std::max(columns, 0) * std::max(rows, 0);
  std::vector<PassResult> results(static_cast<std::size_t>(tiles));
  int threads = options.threads > 0 ? options.threads : omp_get_num_procs();
  bool stopped = false;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(|| : stopped)
  for (int t = 0; t < tiles; ++t) {
    if (stop.load(std::memory_order_relaxed)) {
      stopped = true;
      continue;
    }
    int x = window.x0 + t % columns * kTileSize, y = window.y0 + t / columns * kTileSize;
    Window tile{x, y, std::min(x + kTileSize, window.x1), std::min(y + kTileSize, window.y1)};
    PixelSampler sampler(scene, document);
    render_tile(sampler, tile, range, film, results[static_cast<std::size_t>(t)]);
  }
  PassResult total;
  for (const PassResult& r : results) { // in tile order, so that the log does not depend on threads
    total.rays += r.rays;
    total.nonfinite.count += r.nonfinite.count;
    for (const NonFiniteSample& s : r.nonfinite.records)
      if (total.nonfinite.records.size() < NonFiniteLog::kMaxRecords) total.nonfinite.records.push_back(s);
  }
  total.completed = !stopped;
  return total;
}

vec3 replay_sample(const RenderScene& scene, const Document& document, uvec2 pixel, std::uint32_t sample) {
  RayCounts ignored;
  return PixelSampler(scene, document).sample(pixel, sample, ignored);
}

float display_scale(const RenderScene& scene, const RenderSettings& settings) {
  if (settings.view != View::depth) return 1;
  Bounds3 bounds = scene.geometry().bounds();
  float diagonal = bounds.empty() ? 0 : glm::length(bounds.diagonal());
  return diagonal > 0 ? 1 / diagonal : 1;
}

} // namespace candela
