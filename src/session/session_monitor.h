#pragma once
// Synchronisation between the threads of a session.

#include <condition_variable>
#include <mutex>

namespace candela {

/// One mutex for all parts of a session, so that a status is consistent. It guards pointers and small values,
/// and is never held during long work.
struct SessionMonitor {
  mutable std::mutex mutex;
  mutable std::condition_variable changed; ///< some guarded value has changed

  std::unique_lock<std::mutex> lock() const { return std::unique_lock(mutex); }
};

/// A parameter that documents that the caller holds the session's mutex.
using Locked = const std::unique_lock<std::mutex>&;

} // namespace candela
