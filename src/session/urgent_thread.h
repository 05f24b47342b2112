#pragma once
// A thread for work that the user waits for. The render thread and its OpenMP workers have low priority, and
// a thread may not raise its priority again. So the first picture after an edit is rendered by a thread of
// normal priority with workers of its own.

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

  /// Runs the work on the thread and waits for it; rethrows its exceptions. One caller at a time.
  void run(const std::function<void()>& work);

private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::packaged_task<void()> task_; ///< not valid: none
  bool quit_ = false;
  std::jthread thread_; // last: it uses the other members
};

} // namespace candela
