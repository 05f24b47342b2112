#pragma once
// Work that may take long (reading a scene, writing pictures) done beside the UI thread, which never waits
// for it: it posts tasks and, once a frame, runs what the finished ones hand back.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace candela {

class TaskThread {
public:
  /// Run on the UI thread by run_completions().
  using Completion = std::function<void()>;
  /// Run on the task thread; must turn its errors into a completion that shows them.
  using Task = std::function<Completion()>;

  /// `wake` is called from the task thread when a completion waits.
  explicit TaskThread(std::function<void()> wake);
  ~TaskThread(); ///< finishes the tasks that were posted (a picture must get to the disk), and joins
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  void post(Task task);
  /// Tasks that were posted and whose completion did not run yet.
  int pending() const { return pending_; }
  bool has_completions() const;
  void run_completions();
  /// Waits until every task that was posted is done. Not for the UI thread while there is a UI.
  void finish();

private:
  void run();

  std::function<void()> wake_;
  mutable std::mutex mutex_; // held for moves of pointers only
  std::condition_variable posted_, idle_;
  std::deque<Task> tasks_;
  std::vector<Completion> completions_;
  bool stopping_ = false;
  bool working_ = false;
  int pending_ = 0; // of the UI thread
  std::thread thread_;
};

} // namespace candela
