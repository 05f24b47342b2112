#include "app/window/window_offscreen.h"

#include "app/platform/offscreen_context.h"

#include <condition_variable>
#include <mutex>

namespace candela {

namespace {

/// The counterpart of glfwWaitEventsTimeout() and glfwPostEmptyEvent().
class Bell {
public:
  void ring() {
    {
      std::lock_guard lock(mutex_);
      rung_ = true;
    }
    heard_.notify_one();
  }
  void wait(double seconds) {
    std::unique_lock lock(mutex_);
    heard_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return rung_; });
    rung_ = false;
  }

private:
  std::mutex mutex_;
  std::condition_variable heard_;
  bool rung_ = false;
};

} // namespace

void run_offscreen(ViewerOptions options, ivec2 size, ViewerDriver& driver) {
  OffscreenContext context;
  context.resize(size);
  Bell bell;
  options.wake = [&bell] { bell.ring(); };
  Viewer viewer(context.gl(), std::move(options));
  viewer.handle(Resized{size, 1});
  const auto began = std::chrono::steady_clock::now();
  const FrameHost host{
      [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(); },
      [&](double seconds) { bell.wait(seconds); }, [&] { context.gl().Finish(); }};
  run_frames(viewer, host, &driver);
}

} // namespace candela
