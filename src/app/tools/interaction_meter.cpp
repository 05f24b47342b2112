#include "app/tools/interaction_meter.h"

#include "core/statistics.h"

#include <algorithm>
#include <vector>

namespace candela {

namespace {

double milliseconds(MeterClock::time_point a, MeterClock::time_point b) {
  return std::chrono::duration<double, std::milli>(b - a).count();
}

template <class T>
void keep(std::deque<T>& list, const T& value) {
  list.push_back(value);
  if (list.size() > InteractionMeter::kKept) list.pop_front();
}

} // namespace

void InteractionMeter::submitted(std::uint64_t generation, MeterClock::time_point since) {
  waiting_.push_back({generation, since});
  ++submissions_;
}

void InteractionMeter::shown(const Frame& frame, MeterClock::time_point now) {
  while (!waiting_.empty() && waiting_.front().generation <= frame.generation) {
    Interaction made;
    made.generation = waiting_.front().generation;
    made.first_ms = milliseconds(waiting_.front().since, now);
    made.coarseness = frame.coarseness;
    newest_since_ = waiting_.front().since;
    keep(interactions_, made);
    waiting_.pop_front();
  }
  if (frame.spp == 0 || interactions_.empty()) return;
  Interaction& newest = interactions_.back();
  if (newest.generation != frame.generation || newest.full_ms >= 0) return;
  newest.full_ms = milliseconds(newest_since_, now);
  newest.pass_ms = 1000 * frame.first_pass_seconds;
}

void InteractionMeter::add(const WindowFrame& frame) { keep(frames_, frame); }

void InteractionMeter::clear() {
  interactions_.clear();
  frames_.clear();
}

MeterReadings InteractionMeter::readings() const {
  constexpr std::ptrdiff_t kInputs = 32, kFrames = 256;
  std::vector<double> first, full, frame;
  for (auto i = interactions_.end() - std::min(std::ssize(interactions_), kInputs); i != interactions_.end();
       ++i) {
    first.push_back(i->first_ms);
    if (i->full_ms >= 0) full.push_back(i->full_ms);
  }
  for (auto i = frames_.end() - std::min(std::ssize(frames_), kFrames); i != frames_.end(); ++i)
    frame.push_back(1000 * i->seconds);
  return {percentile(first, 50), percentile(full, 50), percentile(frame, 50), percentile(frame, 99), 0};
}

} // namespace candela
