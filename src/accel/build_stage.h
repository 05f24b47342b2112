#pragma once
// What a stage of the build and who waits for it tell each other (core/progress.h).

#include "core/progress.h"

#include <cstddef>

namespace candela::accel_detail {

/// Work units that each stage takes for a primitive, in proportion to its time.
enum class StageWork : std::uint32_t { refs = 1, binary = 12, emit = 2, packs = 2 };
inline constexpr std::uint64_t kWorkPerPrimitive = 17; ///< the sum

/// Tasks of a parallel loop: enough for all threads to end together. A loop of more than 64 tasks a thread is
/// run by one thread alone (GCC's libgomp, GOMP_taskloop).
inline constexpr int kLoopTasks = 64;

/// Stages recurse down to subtrees that one task builds; they ask and report at the top of those, so that it
/// costs nothing, and nothing depends on the answer but whether the tree comes to be. Null: nobody waits.
class BuildStage {
public:
  BuildStage(Progress* progress, StageWork work)
      : progress_(progress), work_(static_cast<std::uint32_t>(work)) {}

  bool cancelled() const { return progress_ && progress_->cancelled(); }
  /// Throws Cancelled; outside of OpenMP regions only.
  void check() const {
    if (progress_) progress_->check();
  }
  void done(std::size_t primitives) const {
    if (progress_) progress_->advance(work_ * std::uint64_t{primitives});
  }

private:
  Progress* progress_;
  std::uint32_t work_;
};

} // namespace candela::accel_detail
