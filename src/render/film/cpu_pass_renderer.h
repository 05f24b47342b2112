#pragma once
// Renders passes on the CPU: tiles over OpenMP threads.

#include "render/film/pass_renderer.h"

namespace candela {

class CpuPassRenderer final : public PassRenderer {
public:
  /// `threads` of them, 0: every core. The OpenMP workers are those of the thread that calls render().
  explicit CpuPassRenderer(int threads = 0) : threads_(threads) {}

  PassResult render(const PassJob& job, const PassFilms& films, const StopCondition& stop) override;

private:
  int threads_;
};

} // namespace candela
