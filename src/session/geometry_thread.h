#pragma once
// A thread that builds geometry beside the renderer: it builds well what was built fast while the user moved
// it, and prepares what the user is about to move.

#include "render/world/geometry.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace candela {

struct GeometryJob {
  std::shared_ptr<const std::vector<Instance>> instances;
  BuildQuality quality = BuildQuality::high;
  Geometry::Objects known;
  double delay = 0; ///< seconds before it begins, in which a newer one replaces it at no cost
};

class GeometryThread {
public:
  /// Called from the thread with every geometry that was not cancelled; null where memory does not suffice.
  using Done = std::function<void(const GeometryJob&, std::shared_ptr<const Geometry>)>;

  /// `prepare` runs first, on the thread.
  GeometryThread(std::function<void()> prepare, Done done);
  ~GeometryThread(); ///< cancels and joins
  GeometryThread(const GeometryThread&) = delete;
  GeometryThread& operator=(const GeometryThread&) = delete;

  /// Replaces the job that waits and cancels the one in work, which are out of date.
  void post(GeometryJob job);
  void cancel();

private:
  using Clock = std::chrono::steady_clock;
  void loop();

  Done done_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<GeometryJob> waiting_;
  Clock::time_point due_;             ///< when it begins
  std::shared_ptr<Progress> working_; ///< null: on nothing
  bool quit_ = false;
  std::jthread thread_; // last: it uses the rest
};

} // namespace candela
