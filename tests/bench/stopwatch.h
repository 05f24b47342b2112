#pragma once
// Duration of builds.

#include <chrono>
#include <ctime>

namespace candela::bench {

/// Seconds. On a shared machine, CPU time (of all threads) is more stable than wall time.
struct BuildTime {
  double wall = 1e30, processor = 1e30;

  void keep_least(BuildTime t) {
    wall = t.wall < wall ? t.wall : wall;
    processor = t.processor < processor ? t.processor : processor;
  }
};

class Stopwatch {
public:
  BuildTime elapsed() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(),
            static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC};
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t processor_start_ = std::clock();
};

} // namespace candela::bench
