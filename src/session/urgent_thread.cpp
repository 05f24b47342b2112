#include "session/urgent_thread.h"

#include <utility>

namespace candela {

UrgentThread::UrgentThread(std::function<void()> prepare)
    : thread_([this, prepare = std::move(prepare)] {
        prepare();
        loop();
      }) {}

UrgentThread::~UrgentThread() {
  {
    std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_one();
}

void UrgentThread::run(const std::function<void()>& work) {
  std::packaged_task<void()> task(std::cref(work));
  std::future<void> done = task.get_future();
  {
    std::lock_guard lock(mutex_);
    task_ = std::move(task);
  }
  changed_.notify_one();
  done.get();
}

void UrgentThread::loop() {
  while (true) {
    std::packaged_task<void()> task;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return quit_ || task_.valid(); });
      if (quit_) return;
      task = std::exchange(task_, {});
    }
    task();
  }
}

} // namespace candela
