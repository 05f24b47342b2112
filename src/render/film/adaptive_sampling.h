#pragma once
// Adaptive sampling, which stops in blocks of pixels with a small error (adaptive.error).

#include "render/film/sample_queue.h"

namespace candela {

/// Side of the blocks of pixels that stop together: one pixel's variance is too inaccurate (pixels with a low
/// estimate would stop too early).
inline constexpr int kAdaptiveBlock = 8;

/// Not the levels of a coarse first pass.
inline bool samples_adaptively(const PassJob& job) {
  return job.document.settings.adaptive.error > 0 && job.range.lattice == 1 && job.range.skip_lattice == 0;
}

/// Samples the tile's blocks up to the end of the job's range or to where they converge. That is tested only
/// at sample numbers that are multiples of adaptive.min_spp, so that it does not depend on how passes divide
/// the samples. Returns whether all of the tile's blocks have stopped.
bool sample_blocks(SampleQueue& queue, const PixelBox& tile, const PassJob& job, PassResult& result);

} // namespace candela
