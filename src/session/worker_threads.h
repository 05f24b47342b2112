#pragma once
// The computing threads of a session: those that start OpenMP regions, and their workers.

#include <ctime>
#include <mutex>
#include <vector>

namespace candela {

/// All members may be called from any thread.
class WorkerThreads {
public:
  /// `threads` per region; 0: every core.
  explicit WorkerThreads(int threads) : threads_(threads) {}

  int count() const;

  /// Starts the OpenMP workers of the calling thread, which the runtime keeps while the number of threads
  /// does not change. They inherit its niceness, which `niceness` sets unless it is 0.
  void start(int niceness);

  /// CPU time of the threads that called start() and of their workers, seconds.
  double cpu_seconds() const;

private:
  int threads_;
  mutable std::mutex mutex_;
  std::vector<clockid_t> clocks_;
};

/// The CPU-time clock of the calling thread, which any thread can read.
clockid_t thread_cpu_clock();
/// Its value in seconds; 0 for a thread that has ended.
double cpu_seconds(clockid_t clock);

} // namespace candela
