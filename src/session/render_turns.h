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
  /// What the sides of a contest have equally much of.
  enum class Fairness { samples, time };

  /// `contest[i]` is the contest of side i. Sides of one contest stay level; contests alternate.
  explicit RenderTurns(std::vector<int> contest);

  void set_fairness(Fairness fairness);

  struct Progress {
    double samples = 0; ///< a pixel, of this accumulation; parts of the first one count, too
    double seconds = 0; ///< of rendering, of this accumulation
  };
  struct Turn {
    bool granted = false;
    int most_samples = 0; ///< a pixel, until the side is level with another one; 0: as many as it likes
  };
  /// Waits for the side's turn, or until `give_up`; who sets that must call wake(). A turn that is granted
  /// must be ended.
  Turn begin(int side, const Progress& progress, const std::atomic<bool>& give_up);
  void end(int side);
  /// The side has nothing to render: nobody waits for it until it begins again.
  void leave(int side);
  void wake();

private:
  struct Side {
    int contest = 0;
    bool active = false;  ///< has begun and did not leave
    bool waiting = false; ///< for its turn
    Progress progress;
  };
  double amount(const Side& side) const {
    return fairness_ == Fairness::samples ? side.progress.samples : side.progress.seconds;
  }
  bool may_go(std::size_t side) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  Fairness fairness_ = Fairness::samples;
  std::vector<Side> sides_;
  int holder_ = -1;
  int last_ = -1; ///< side that held last
};

} // namespace candela
