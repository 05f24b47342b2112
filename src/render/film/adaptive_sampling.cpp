#include "render/film/adaptive_sampling.h"

namespace candela {

namespace {

/// Whether the block is as good as the settings ask for.
bool block_converged(const Film& film, const PixelBox& block, float error) {
  const ivec2 origin = film.origin();
  double sum = 0;
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) sum += film.relative_variance(x - origin.x, y - origin.y);
  return sum <= static_cast<double>(error) * static_cast<double>(error) *
                    ((block.x1 - block.x0) * (block.y1 - block.y0));
}

/// Returns whether the block has stopped.
bool sample_block(SampleQueue& queue, const PixelBox& block, const PassJob& job, PassResult& result) {
  const AdaptiveSettings& adaptive = job.document.settings.adaptive;
  Film& film = queue.image();
  const ivec2 corner = ivec2(block.x0, block.y0) - film.origin();
  if (film.stopped(corner.x, corner.y)) return true;
  auto every = static_cast<std::uint32_t>(adaptive.min_spp);
  for (std::uint32_t i = job.range.begin; i < job.range.end;) {
    const std::uint32_t check = (i / every + 1) * every, end = std::min(check, job.range.end);
    queue.sample_all(block, {i, end}, result);
    if (queue.stopped()) return false;
    i = end;
    // Where the block has more samples, an earlier pass that ended early has tested it.
    const bool at_check = i == check && film.tried(corner.x, corner.y) == check;
    if (at_check && block_converged(film, block, adaptive.error)) {
      const ivec2 origin = film.origin();
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) film.stop(x - origin.x, y - origin.y);
      return true;
    }
  }
  return false;
}

} // namespace

bool sample_blocks(SampleQueue& queue, const PixelBox& tile, const PassJob& job, PassResult& result) {
  bool converged = true;
  for (int y = tile.y0; y < tile.y1; y = (y / kAdaptiveBlock + 1) * kAdaptiveBlock)
    for (int x = tile.x0; x < tile.x1; x = (x / kAdaptiveBlock + 1) * kAdaptiveBlock) {
      const PixelBox block{x, y, std::min((x / kAdaptiveBlock + 1) * kAdaptiveBlock, tile.x1),
                           std::min((y / kAdaptiveBlock + 1) * kAdaptiveBlock, tile.y1)};
      converged &= sample_block(queue, block, job, result);
    }
  return converged;
}

} // namespace candela
