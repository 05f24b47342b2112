#include "session/render_turns.h"

#include <algorithm>
#include <cmath>

namespace candela {

RenderTurns::RenderTurns(std::vector<int> contest) {
  for (int c : contest) sides_.push_back({c, false, false, {}});
}

void RenderTurns::set_fairness(Fairness fairness) {
  {
    std::lock_guard lock(mutex_);
    fairness_ = fairness;
  }
  changed_.notify_all();
}

bool RenderTurns::may_go(std::size_t side) const {
  if (holder_ >= 0) return false;
  const Side& mine = sides_[side];
  const bool held_last = last_ == static_cast<int>(side);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& other = sides_[i];
    if (i == side || !other.active) continue;
    if (other.contest == mine.contest) {
      if (amount(other) < amount(mine)) return false;
      if (amount(other) == amount(mine) && other.waiting && held_last) return false;
    } else if (other.waiting && last_ >= 0 &&
               sides_[static_cast<std::size_t>(last_)].contest == mine.contest) {
      return false;
    }
  }
  return true;
}

RenderTurns::Turn RenderTurns::begin(int side, const Progress& progress, const std::atomic<bool>& give_up) {
  const auto index = static_cast<std::size_t>(side);
  Turn turn;
  {
    std::unique_lock lock(mutex_);
    Side& mine = sides_[index];
    mine.progress = progress;
    mine.active = mine.waiting = true;
    changed_.notify_all(); // who waits for this side may go now that it is known to be ahead
    changed_.wait(lock, [&] { return give_up.load() || may_go(index); });
    mine.waiting = false;
    if (!give_up.load()) {
      holder_ = side;
      turn.granted = true;
      if (fairness_ == Fairness::samples)
        for (std::size_t i = 0; i < sides_.size(); ++i) {
          const double lead = sides_[i].progress.samples - progress.samples;
          if (i == index || !sides_[i].active || sides_[i].contest != mine.contest || lead <= 0) continue;
          const int most = std::max(1, static_cast<int>(std::ceil(std::min(lead, 1e6))));
          turn.most_samples = turn.most_samples == 0 ? most : std::min(turn.most_samples, most);
        }
    }
  }
  if (!turn.granted) changed_.notify_all();
  return turn;
}

void RenderTurns::end(int side) {
  {
    std::lock_guard lock(mutex_);
    if (holder_ == side) holder_ = -1;
    last_ = side;
  }
  changed_.notify_all();
}

void RenderTurns::leave(int side) {
  {
    std::lock_guard lock(mutex_);
    sides_[static_cast<std::size_t>(side)].active = false;
  }
  changed_.notify_all();
}

void RenderTurns::wake() {
  { std::lock_guard lock(mutex_); } // nobody is between looking at give_up and waiting
  changed_.notify_all();
}

} // namespace candela
