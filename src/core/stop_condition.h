#pragma once
// Conditions for ending work early, polled by long loops of rendering.

#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <optional>

namespace candela {

/// Flags and a deadline. Polled often, from any thread: a few loads, and the clock where there is a deadline.
/// It refers to its flags, which must outlive it.
class StopCondition {
public:
  using Clock = std::chrono::steady_clock;

  /// Never.
  StopCondition() = default;
  /// As soon as the flag is set.
  StopCondition(const std::atomic<bool>& flag) { when(flag); }

  /// Also as soon as this flag is set, at most three in all.
  StopCondition& when(const std::atomic<bool>& flag) {
    assert(count_ < flags_.size());
    flags_[count_++] = &flag;
    return *this;
  }
  /// Also when this flag is set, but not before that time.
  StopCondition& when(const std::atomic<bool>& flag, Clock::time_point not_before) {
    patient_flag_ = &flag;
    not_before_ = not_before;
    return *this;
  }
  /// Also from the deadline on.
  StopCondition& at(Clock::time_point deadline) {
    deadline_ = deadline;
    return *this;
  }

  bool asked() const {
    for (std::size_t i = 0; i < count_; ++i)
      if (flags_[i]->load(std::memory_order_relaxed)) return true;
    if (patient_flag_ != nullptr && patient_flag_->load(std::memory_order_relaxed) &&
        Clock::now() >= not_before_)
      return true;
    return deadline_ && Clock::now() >= *deadline_;
  }

private:
  std::array<const std::atomic<bool>*, 3> flags_{};
  std::size_t count_ = 0;
  const std::atomic<bool>* patient_flag_ = nullptr;
  Clock::time_point not_before_;
  std::optional<Clock::time_point> deadline_;
};

/// One worker's view of a condition. It latches: partially stopped work is useless, even if the flag is
/// cleared.
class StopPoll {
public:
  explicit StopPoll(const StopCondition& condition) : condition_(condition) {}

  bool asked() {
    asked_ = asked_ || condition_.asked();
    return asked_;
  }

private:
  StopCondition condition_;
  bool asked_ = false;
};

} // namespace candela
