#pragma once
// Input latency: the time from an input until its picture is on the screen, and the window's frame times. The
// viewer reports events; the Statistics panel and `candela bench` read the results.

#include "render/film/frame.h"

#include <chrono>
#include <cstdint>
#include <deque>

namespace candela {

using MeterClock = std::chrono::steady_clock;

/// One input that restarted the image, with the latency of its pictures.
struct Interaction {
  std::uint64_t generation = 0; ///< generation of the Document with the edit
  /// Milliseconds from the input until its first picture, or that of a later input, was on the screen.
  double first_ms = 0;
  double full_ms = -1; ///< the same for one sample in every pixel; < 0: not yet, or an edit came before
  double pass_ms = 0;  ///< wall time of that first pass over all pixels alone; 0 while full_ms < 0
  int coarseness = 1;  ///< side of the first picture's blocks, pixels
};

/// One frame of the window.
struct WindowFrame {
  double seconds = 0;     ///< wall time from its start until it is on the screen
  int dropped = 0;        ///< frames missed between its due time and its actual time
  bool rendering = false; ///< samples were being added at that time
};

/// The panel's values: medians and tails of recent measurements.
struct MeterReadings {
  double first_ms = 0; ///< median; 0: no inputs yet
  double full_ms = 0;  ///< median; 0: none was reached before the next input
  double frame_ms = 0, frame_p99_ms = 0;
  double render_share = 0; ///< share of all cores while rendering, 0..1; 0: not known yet
};

class InteractionMeter {
public:
  /// Reports that an input, received at `since`, was submitted and restarts the image.
  void submitted(std::uint64_t generation, MeterClock::time_point since);
  /// Reports that the picture is on the screen.
  void shown(const Frame& frame, MeterClock::time_point now);
  void add(const WindowFrame& frame);

  /// The newest of each, oldest first; at most kKept.
  const std::deque<Interaction>& interactions() const { return interactions_; }
  const std::deque<WindowFrame>& frames() const { return frames_; }
  /// Whether there are inputs without a picture yet.
  bool waiting() const { return !waiting_.empty(); }
  std::uint64_t awaited() const {
    return waiting_.front().generation;
  }                                                          ///< the oldest such input; waiting() must hold
  std::uint64_t submissions() const { return submissions_; } ///< total number
  /// Drops the waiting inputs, which will get no picture.
  void give_up() { waiting_.clear(); }
  void clear(); ///< drops all measurements
  /// Medians and tails of the newest inputs and frames.
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
