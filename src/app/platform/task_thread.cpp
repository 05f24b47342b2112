#include "app/platform/task_thread.h"

namespace candela {

TaskThread::TaskThread(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

TaskThread::~TaskThread() {
  {
    std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  posted_.notify_one();
  thread_.join();
}

void TaskThread::post(Task task) {
  ++pending_;
  {
    std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  posted_.notify_one();
}

bool TaskThread::has_completions() const {
  std::lock_guard lock(mutex_);
  return !completions_.empty();
}

void TaskThread::run_completions() {
  std::vector<Completion> ready;
  {
    std::lock_guard lock(mutex_);
    ready.swap(completions_);
  }
  pending_ -= static_cast<int>(ready.size());
  for (const Completion& completion : ready) completion();
}

void TaskThread::finish() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return tasks_.empty() && !working_; });
}

void TaskThread::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    posted_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    working_ = true;
    lock.unlock();
    Completion completion = task();
    task = nullptr; // its captures are freed here, not on the UI thread
    lock.lock();
    completions_.push_back(std::move(completion));
    working_ = false;
    lock.unlock();
    idle_.notify_all();
    if (wake_) wake_();
    lock.lock();
  }
}

} // namespace candela
