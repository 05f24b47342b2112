#pragma once
// Several sessions on one machine: they take turns, each with all of its threads, so that together they never
// run more threads than one of them would, and none gets ahead of the others.

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <vector>

namespace candela {

class RenderTurns {
public:
  /// What the variants of a group have equally much of.
  enum class Fairness { samples, time };

  /// `groups[i]` is the group of variant i. Those of one group stay level; groups alternate.
  explicit RenderTurns(std::vector<int> groups);

  void set_fairness(Fairness fairness);

  struct Progress {
    double samples = 0; ///< a pixel, of this accumulation; parts of the first one count, too
    double seconds = 0; ///< of rendering, of this accumulation
  };
  struct Turn {
    bool granted = false;
    int most_samples = 0; ///< a pixel, until the variant is level with another one; 0: no limit
  };
  /// Waits for the variant's turn, or until `give_up`; whoever sets that calls wake(). A turn that is granted
  /// must be ended.
  Turn begin(int variant, const Progress& progress, const std::atomic<bool>& give_up);
  void end(int variant);
  /// The variant has nothing to render: the others do not wait for it until it begins again.
  void leave(int variant);
  void wake();

private:
  struct Variant {
    int group = 0;
    bool active = false;  ///< has begun and did not leave
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
  int last_ = -1; ///< variant that held last
};

} // namespace candela
