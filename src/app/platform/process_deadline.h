#pragma once
// Ends the program even if a part of it cannot be stopped.

#include <condition_variable>
#include <mutex>
#include <thread>

namespace candela {

/// Ends the process with exit code 0 unless it is destroyed within so many seconds. Used when everything is
/// saved and the remaining work (a library that decodes a picture, a disk that does not answer) cannot be
/// interrupted and is no longer needed.
class ProcessDeadline {
public:
  explicit ProcessDeadline(double seconds);
  ~ProcessDeadline();
  ProcessDeadline(const ProcessDeadline&) = delete;
  ProcessDeadline& operator=(const ProcessDeadline&) = delete;

private:
  std::mutex mutex_;
  std::condition_variable kept_;
  bool is_kept_ = false;
  std::thread thread_;
};

} // namespace candela
