#include "session/geometry_thread.h"

#include <new>
#include <utility>

namespace candela {

GeometryThread::GeometryThread(std::function<void()> prepare, Done done)
    : done_(std::move(done)), thread_([this, prepare = std::move(prepare)] {
        prepare();
        loop();
      }) {}

GeometryThread::~GeometryThread() {
  {
    std::lock_guard lock(mutex_);
    quit_ = true;
    if (working_) working_->cancel();
  }
  changed_.notify_one();
}

void GeometryThread::post(GeometryJob job) {
  const std::chrono::duration<double> job_delay(job.delay);
  std::optional<GeometryJob> replaced(std::move(job)); // freed without the lock
  {
    std::lock_guard lock(mutex_);
    due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(job_delay);
    waiting_.swap(replaced);
    if (working_) working_->cancel();
  }
  changed_.notify_one();
}

void GeometryThread::cancel() {
  std::optional<GeometryJob> dropped;
  std::lock_guard lock(mutex_);
  waiting_.swap(dropped);
  if (working_) working_->cancel();
}

void GeometryThread::loop() {
  while (true) {
    GeometryJob job;
    std::shared_ptr<Progress> progress;
    {
      std::unique_lock lock(mutex_);
      while (!quit_ && !(waiting_ && Clock::now() >= due_))
        if (waiting_)
          changed_.wait_until(lock, due_);
        else
          changed_.wait(lock);
      if (quit_) return;
      job = std::move(*waiting_);
      waiting_.reset();
      progress = working_ = std::make_shared<Progress>();
    }
    std::shared_ptr<const Geometry> made;
    bool cancelled = false;
    try {
      made = Geometry::build(*job.instances, job.quality, progress.get(), job.known);
    } catch (const Cancelled&) { cancelled = true; } catch (const std::bad_alloc&) {
    } // existing geometry stays
    {
      std::lock_guard lock(mutex_);
      working_.reset();
      cancelled |= progress->cancelled();
    }
    if (!cancelled) done_(job, std::move(made));
  }
}

} // namespace candela
