#pragma once
// Progress and cancellation of long work, shared by the working and the waiting thread.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>

namespace candela {

/// Thrown by work that was cancelled.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "the work was given up"; }
};

/// Units of work are the worker's own (bytes, primitives). All members may be called from any thread.
class Progress {
public:
  Progress() = default;
  /// Cancelled by this flag, too, which must outlive it (a signal handler may set no more than a flag).
  explicit Progress(const std::atomic<bool>& ends) : ends_(&ends) {}

  /// Asks the work to end; this cannot be undone.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const {
    return cancelled_.load(std::memory_order_relaxed) ||
           (ends_ != nullptr && ends_->load(std::memory_order_relaxed));
  }
  /// Throws Cancelled if it is cancelled. Not for OpenMP regions, which exceptions must not leave.
  void check() const {
    if (cancelled()) throw Cancelled();
  }

  /// Adds to the work to do.
  void expect(std::uint64_t work) { expected_.fetch_add(work, std::memory_order_relaxed); }
  /// Adds to the work done.
  void advance(std::uint64_t work) { done_.fetch_add(work, std::memory_order_relaxed); }

  /// The share of the expected work that is done, in [0, 1]; 0 if nothing is known. It never decreases, even
  /// if more work becomes known.
  double share() const {
    const auto all = expected_.load(std::memory_order_relaxed), done = done_.load(std::memory_order_relaxed);
    const double now = all > 0 ? static_cast<double>(std::min(done, all)) / static_cast<double>(all) : 0;
    double most = most_.load(std::memory_order_relaxed);
    while (now > most && !most_.compare_exchange_weak(most, now, std::memory_order_relaxed)) {}
    return std::max(now, most);
  }

private:
  std::atomic<bool> cancelled_{false};
  const std::atomic<bool>* ends_ = nullptr;
  std::atomic<std::uint64_t> expected_{0}, done_{0};
  mutable std::atomic<double> most_{0}; ///< that share() has told
};

/// Checks `progress`, which may be null, in a loop's i-th iteration; seldom enough to cost nothing.
inline void check_now_and_then(const Progress* progress, std::size_t i) {
  if (progress != nullptr && i % 16384 == 0) progress->check();
}

/// A piece of some Progress's work, of one thread, that knows its own share. What is left when it ends counts
/// as done.
class ProgressPart {
public:
  /// `work` has been expected.
  ProgressPart(Progress& whole, std::uint64_t work) : whole_(whole), work_(work) {}
  ProgressPart(const ProgressPart&) = delete;
  ProgressPart& operator=(const ProgressPart&) = delete;
  ~ProgressPart() { whole_.advance(work_ - done_); }

  bool cancelled() const { return whole_.cancelled(); }
  void check() const { whole_.check(); }
  /// Throws Cancelled if the work is to end. A share below an earlier one changes nothing.
  void reach(double share) {
    whole_.check();
    const auto done = static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(work_));
    if (done < done_ + work_ / 1024 + 1) return; // steps too small to see
    whole_.advance(done - done_);
    done_ = done;
  }

private:
  Progress& whole_;
  std::uint64_t work_, done_ = 0;
};

} // namespace candela
