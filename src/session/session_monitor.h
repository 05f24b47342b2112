#pragma once
// How the parts of a session share values between its threads.

#include <condition_variable>
#include <mutex>

namespace candela {

/// One mutex for all parts of a session, so that what a status says of them is of one moment. It guards
/// pointers and small values, and is never held while a thread works.
struct SessionMonitor {
  mutable std::mutex mutex;
  mutable std::condition_variable changed; ///< some guarded value is new

  std::unique_lock<std::mutex> lock() const { return std::unique_lock(mutex); }
};

/// A parameter that shows that the caller holds the session's mutex.
using Locked = const std::unique_lock<std::mutex>&;

} // namespace candela
