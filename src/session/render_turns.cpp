#include "session/render_turns.h"

#include <algorithm>
#include <cmath>

namespace candela {

RenderTurns::RenderTurns(const std::vector<int>& groups) {
  for (int group : groups) variants_.push_back({group, false, false, {}});
}

void RenderTurns::set_fairness(Fairness fairness) {
  {
    std::lock_guard lock(mutex_);
    fairness_ = fairness;
  }
  changed_.notify_all();
}

bool RenderTurns::may_go(std::size_t variant) const {
  if (holder_ >= 0) return false;
  const Variant& mine = variants_[variant];
  const bool held_last = last_ == static_cast<int>(variant);
  for (std::size_t i = 0; i < variants_.size(); ++i) {
    const Variant& other = variants_[i];
    if (i == variant || !other.active) continue;
    if (other.group == mine.group) {
      if (amount(other) < amount(mine)) return false;
      if (amount(other) == amount(mine) && other.waiting && held_last) return false;
    } else if (other.waiting && last_ >= 0 &&
               variants_[static_cast<std::size_t>(last_)].group == mine.group) {
      return false;
    }
  }
  return true;
}

RenderTurns::Turn RenderTurns::begin(int variant, const Progress& progress,
                                     const std::atomic<bool>& give_up) {
  const auto index = static_cast<std::size_t>(variant);
  Turn turn;
  {
    std::unique_lock lock(mutex_);
    Variant& mine = variants_[index];
    mine.progress = progress;
    mine.active = mine.waiting = true;
    changed_.notify_all(); // a waiting variant may proceed if it is now level
    changed_.wait(lock, [&] { return give_up.load() || may_go(index); });
    mine.waiting = false;
    if (!give_up.load()) {
      holder_ = variant;
      turn.granted = true;
      if (fairness_ == Fairness::samples)
        for (std::size_t i = 0; i < variants_.size(); ++i) {
          const double lead = variants_[i].progress.samples - progress.samples;
          if (i == index || !variants_[i].active || variants_[i].group != mine.group || lead <= 0) continue;
          const int most = std::max(1, static_cast<int>(std::ceil(std::min(lead, 1e6))));
          turn.most_samples = turn.most_samples == 0 ? most : std::min(turn.most_samples, most);
        }
    }
  }
  if (!turn.granted) changed_.notify_all();
  return turn;
}

void RenderTurns::end(int variant) {
  {
    std::lock_guard lock(mutex_);
    if (holder_ == variant) holder_ = -1;
    last_ = variant;
  }
  changed_.notify_all();
}

void RenderTurns::leave(int variant) {
  {
    std::lock_guard lock(mutex_);
    variants_[static_cast<std::size_t>(variant)].active = false;
  }
  changed_.notify_all();
}

void RenderTurns::wake() {
  { std::lock_guard lock(mutex_); } // ensures that no thread is between testing give_up and waiting
  changed_.notify_all();
}

} // namespace candela
