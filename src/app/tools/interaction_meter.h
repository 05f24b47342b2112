#pragma once
// Input latency: how long after an input its picture is on the screen, and what the window's frames
// cost meanwhile. The viewer reports its events; the Statistics panel and `candela bench` read it.

#include "render/film/frame.h"

#include <chrono>
#include <cstdint>
#include <deque>

namespace candela {

using MeterClock = std::chrono::steady_clock;

/// One input that restarted the image, and its pictures.
struct Interaction {
  std::uint64_t generation = 0; ///< of the Document that it made
  /// From the input until the first picture of it, or of a later one, covered the whole window, ms.
  double first_ms = 0;
  double full_ms = -1; ///< the same for one sample in every pixel; < 0: not yet, or an edit came before
  double pass_ms = 0;  ///< wall time of that first pass over all pixels alone; 0 while full_ms < 0
  int coarseness = 1;  ///< of the first picture: side of its blocks, pixels
};

/// One frame of the window.
struct WindowFrame {
  double seconds = 0;     ///< from its begin until it is on the screen, wall time
  int dropped = 0;        ///< frames that would have fitted between when it was due and when it came
  bool rendering = false; ///< meanwhile samples were being added
};

/// What the panel shows: medians and tails of what was measured last.
struct MeterReadings {
  double first_ms = 0; ///< median; 0: there were no inputs
  double full_ms = 0;  ///< median; 0: each input was followed by another before
  double frame_ms = 0, frame_p99_ms = 0;
  double render_share = 0; ///< of all cores, 0..1, while samples are being added; 0: not known yet
};

class InteractionMeter {
public:
  /// An input of the time `since` was submitted and restarts the image.
  void submitted(std::uint64_t generation, MeterClock::time_point since);
  /// The picture is on the screen.
  void shown(const Frame& frame, MeterClock::time_point now);
  void add(const WindowFrame& frame);

  /// The newest of each, oldest first; never more than kKept.
  const std::deque<Interaction>& interactions() const { return interactions_; }
  const std::deque<WindowFrame>& frames() const { return frames_; }
  /// Inputs whose first picture is still to come.
  bool waiting() const { return !waiting_.empty(); }
  std::uint64_t awaited() const { return waiting_.front().generation; } ///< the oldest; waiting() must hold
  std::uint64_t submissions() const { return submissions_; }            ///< since it began
  /// Drops the inputs that wait: they will get no picture.
  void give_up() { waiting_.clear(); }
  void clear(); ///< drops what is kept
  /// Of the newest inputs and frames.
  MeterReadings readings() const;

  static constexpr std::size_t kKept = 4096;

private:
  struct Waiting {
    std::uint64_t generation;
    MeterClock::time_point since;
  };
  std::deque<Waiting> waiting_;
  std::uint64_t submissions_ = 0;
  MeterClock::time_point newest_since_; ///< of interactions_.back()
  std::deque<Interaction> interactions_;
  std::deque<WindowFrame> frames_;
};

} // namespace candela
