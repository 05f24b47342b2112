#pragma once
// Several sessions on one machine take turns, each with all of its threads, so that together they run no more
// threads than one of them, and none gets ahead of the others.

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <vector>

namespace candela {

class RenderTurns {
public:
  /// The quantity that is equal for the variants of a group.
  enum class Fairness { samples, time };

  /// `groups[i]` is the group of variant i. Variants of a group stay level; groups alternate.
  explicit RenderTurns(const std::vector<int>& groups);

  void set_fairness(Fairness fairness);

  struct Progress {
    double samples = 0; ///< per pixel of this accumulation, including parts of the first
    double seconds = 0; ///< of rendering, of this accumulation
  };
  struct Turn {
    bool granted = false;
    int most_samples = 0; ///< per pixel, until the variant is level with another one; 0: no limit
  };
  /// Waits for the variant's turn, or until `give_up`, whose setter must call wake(). A granted turn must be
  /// ended.
  Turn begin(int variant, const Progress& progress, const std::atomic<bool>& give_up);
  void end(int variant);
  /// The variant has nothing to render: the others do not wait for it until its next turn.
  void leave(int variant);
  void wake();

private:
  struct Variant {
    int group = 0;
    bool active = false;  ///< has begun and not left
    bool waiting = false; ///< for its turn
    Progress progress;
  };
  double amount(const Variant& variant) const {
    return fairness_ == Fairness::samples ? variant.progress.samples : variant.progress.seconds;
  }
  bool may_go(std::size_t variant) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  Fairness fairness_ = Fairness::samples;
  std::vector<Variant> variants_;
  int holder_ = -1;
  int last_ = -1; ///< variant that had the last turn
};

} // namespace candela
