#include "render/film/cpu_pass_renderer.h"

#include "render/film/adaptive_sampling.h"
#include "render/film/sample_queue.h"

#include <omp.h>

namespace candela {

namespace {

/// Small enough that the last tiles of a pass keep all threads busy, large enough that a tile's rays are
/// neighbours.
constexpr int kTileSize = 16;
static_assert(kTileSize % kAdaptiveBlock == 0, "a block lies in one tile");

/// The pixels of the frame, of which the film may hold a part.
PixelBox clip(const CropWindow& window, const Film& film) {
  const ivec2 lo = film.origin(), hi = lo + ivec2(film.width(), film.height());
  if (window.empty()) return {lo.x, lo.y, hi.x, hi.y};
  return {std::max(window.x, lo.x), std::max(window.y, lo.y), std::min(window.x + window.width, hi.x),
          std::min(window.y + window.height, hi.y)};
}

/// The frame's grid of tiles, as far as it lies in a window: it does not depend on the window.
class RenderTiles {
public:
  explicit RenderTiles(const PixelBox& window)
      : window_(window), column_(window.x0 / kTileSize), row_(window.y0 / kTileSize),
        columns_(std::max((window.x1 + kTileSize - 1) / kTileSize - column_, 0)),
        rows_(std::max((window.y1 + kTileSize - 1) / kTileSize - row_, 0)) {}

  int size() const { return columns_ * rows_; }
  PixelBox operator[](int i) const {
    const int x = (column_ + i % columns_) * kTileSize, y = (row_ + i / columns_) * kTileSize;
    return {std::max(x, window_.x0), std::max(y, window_.y0), std::min(x + kTileSize, window_.x1),
            std::min(y + kTileSize, window_.y1)};
  }

private:
  PixelBox window_;
  int column_, row_, columns_, rows_;
};

void render_tile(SampleQueue& queue, const PixelBox& tile, const PassJob& job, PassResult& result) {
  if (samples_adaptively(job))
    result.converged = sample_blocks(queue, tile, job, result);
  else
    queue.sample_all(tile, job.range, result);
}

} // namespace

PassResult CpuPassRenderer::render(const PassJob& job, const PassFilms& films, const StopCondition& stop) {
  const RenderTiles tiles(clip(job.window, films.image));
  std::vector<PassResult> results(static_cast<std::size_t>(tiles.size()));
  const int threads = threads_ > 0 ? threads_ : omp_get_num_procs();
  bool stopped = false;
#pragma omp parallel num_threads(threads) reduction(|| : stopped)
  {
    PixelSampler sampler(job.scene, job.document, stop, job.camera);
    SampleQueue queue(sampler, job, films);
#pragma omp for schedule(dynamic, 1)
    for (int t = 0; t < tiles.size(); ++t) {
      if (queue.stopped() || stop.asked()) {
        stopped = true;
        continue;
      }
      render_tile(queue, tiles[t], job, results[static_cast<std::size_t>(t)]);
      stopped = stopped || queue.stopped();
    }
  }
  PassResult total;
  total.converged = !stopped;
  for (const PassResult& r : results) { // in tile order, so that the log does not depend on threads
    total.rays += r.rays;
    total.converged &= r.converged;
    total.nonfinite += r.nonfinite;
  }
  total.completed = !stopped;
  return total;
}

} // namespace candela
