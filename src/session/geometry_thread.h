#pragma once
// A thread that builds geometry in the background: high-quality builds of geometry that was built fast during
// edits, and preparations for objects that the user is about to move.

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
  double delay = 0; ///< seconds before it begins, in which a newer one can replace it at no cost
};

class GeometryThread {
public:
  /// Called from the thread with every geometry that was not cancelled; null without enough memory.
  using Done = std::function<void(const GeometryJob&, std::shared_ptr<const Geometry>)>;

  /// `prepare` runs first, on the thread.
  GeometryThread(std::function<void()> prepare, Done done);
  ~GeometryThread(); ///< cancels and joins
  GeometryThread(const GeometryThread&) = delete;
  GeometryThread& operator=(const GeometryThread&) = delete;

  /// Replaces the waiting job and cancels the one in work: both are out of date.
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
  std::shared_ptr<Progress> working_; ///< null: idle
  bool quit_ = false;
  std::jthread thread_; // last: it uses the other members
};

} // namespace candela
