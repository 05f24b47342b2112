#pragma once
// Work that the user waits for. The render thread and its OpenMP workers yield to everything else on the
// machine, and a thread that has given up its priority may not take it back; so the first picture of an edit
// is made by a thread, with workers of its own, that never gave it up.

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

namespace candela {

class UrgentThread {
public:
  /// `prepare` runs first, on the thread.
  explicit UrgentThread(std::function<void()> prepare);
  ~UrgentThread();

  /// Runs the work on the thread and waits for it; what it throws is thrown here. One caller at a time.
  void run(const std::function<void()>& work);

private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::packaged_task<void()> task_; ///< not valid: there is none
  bool quit_ = false;
  std::jthread thread_; // last: it uses the rest
};

} // namespace candela
