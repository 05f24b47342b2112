#pragma once
// Long work (reading a scene, writing pictures) on a thread of its own. The UI thread posts tasks and, once a
// frame, runs the completions of finished ones; it never waits.

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
  /// Run on the task thread; must convert its errors to a completion that shows them.
  using Task = std::function<Completion()>;

  /// `wake` is called from the task thread when a completion is ready.
  explicit TaskThread(std::function<void()> wake);
  ~TaskThread(); ///< finishes the posted tasks (pictures must be written), and joins
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  void post(Task task);
  /// The number of posted tasks whose completion has not run yet.
  int pending() const { return pending_; }
  bool has_completions() const;
  void run_completions();
  /// Waits until all posted tasks are done. Not for the UI thread while there is a UI.
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
  int pending_ = 0; // used by the UI thread only
  std::thread thread_;
};

} // namespace candela
