#pragma once
// The threads that compute: those of a session that start OpenMP regions, and the workers of each.

#include <ctime>
#include <mutex>
#include <vector>

namespace candela {

/// All members may be called from any thread.
class WorkerThreads {
public:
  /// `threads` a region, 0: every core.
  explicit WorkerThreads(int threads) : threads_(threads) {}

  int count() const;

  /// Starts the OpenMP workers of the calling thread, which the runtime keeps for it as long as the number of
  /// threads stays. They inherit its niceness: 0 leaves it as it is.
  void start(int niceness);

  /// CPU time of the threads that called start() and of their workers, seconds.
  double cpu_seconds() const;

private:
  int threads_;
  mutable std::mutex mutex_;
  std::vector<clockid_t> clocks_;
};

/// The CPU-time clock of the calling thread, for any thread to read.
clockid_t thread_cpu_clock();
/// What it says, seconds; 0 for a thread that has ended.
double cpu_seconds(clockid_t clock);

} // namespace candela
