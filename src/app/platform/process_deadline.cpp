#include "app/platform/process_deadline.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace candela {

ProcessDeadline::ProcessDeadline(double seconds)
    : thread_([this, seconds] {
        std::unique_lock lock(mutex_);
        if (kept_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return is_kept_; })) return;
        std::fflush(nullptr);
        std::_Exit(0); // no destructors: they would wait for threads that do not end
      }) {}

ProcessDeadline::~ProcessDeadline() {
  {
    std::lock_guard lock(mutex_);
    is_kept_ = true;
  }
  kept_.notify_one();
  thread_.join();
}

} // namespace candela
