#pragma once
// `candela bench interactive`: measures a viewer while a script sends it input.
//
// Latency is from Viewer::handle() of the input to the end of the buffer swap (glFinish() without a window)
// that shows its picture. CPU time is counted by thread: the render thread and its OpenMP workers, the thread
// that tone-maps, the UI's thread, by their CLOCK_THREAD_CPUTIME_ID; the rest of the process
// (CLOCK_PROCESS_CPUTIME_ID) is mostly the software OpenGL driver. Other programs' CPU time is that of
// /proc/stat less the process's.

#include "app/bench/bench_script.h"
#include "app/console/progress_bar.h"
#include "app/viewer/viewer.h"
#include "app/window/frame_loop.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace candela {

struct BenchPlan {
  int repeats = 20;   ///< inputs of each kind
  double seconds = 5; ///< of flight, and of refining without input
  bool quiet = false;
};

/// Median and tails of measured values.
struct Percentiles {
  std::size_t count = 0;
  double median = 0, p90 = 0, p99 = 0;
};
Percentiles percentiles_of(std::span<const double> values);

/// CPU seconds, and the wall time in which they were spent.
struct CpuBill {
  double wall = 0;
  double render = 0;  ///< the render thread and its workers
  double present = 0; ///< tone mapping
  double window = 0;  ///< the UI's thread
  double process = 0; ///< all of this program
  double machine = 0; ///< all programs; 0 where /proc/stat does not tell
  double passes = 0;  ///< wall time spent in render passes

  CpuBill operator-(const CpuBill& o) const;
  /// The render threads' share of the CPU time that other programs left: 0..1.
  double render_share(int cores) const;
};

struct KindResult {
  InputKind kind{};
  Percentiles first, full; ///< ms from input to picture; `full` is empty for a flight
  Percentiles coarseness;  ///< side of the first picture's blocks, pixels
};

struct Target {
  std::string name;
  double measured = 0, limit = 0;
  std::string unit;
  bool at_least = false; ///< else at most
  bool met() const { return at_least ? measured >= limit : measured <= limit; }
};

struct BenchResult {
  ivec2 size{0};
  int threads = 0;
  double full_pass_ms = 0; ///< median wall time of the first sample of every pixel
  std::vector<KindResult> kinds;
  Percentiles frames;            ///< ms of the window's frames while rendering
  std::size_t dropped = 0;       ///< frames that were not drawn in time
  CpuBill refining;              ///< without input
  double samples_per_second = 0; ///< camera paths a second of wall time, meanwhile
  std::array<double, 2> load{};  ///< average of the last minute, before and after
};

/// Whether all targets are met.
std::vector<Target> targets(const BenchResult& result);

/// The driver: warms up, plays each kind of input, measures refining, ends.
class InteractionBench : public ViewerDriver {
public:
  InteractionBench(const BenchPlan& plan, int threads);
  double next(Viewer& viewer) override;
  /// Valid once the loop has ended.
  const BenchResult& result() const { return result_; }
  bool done() const { return stage_ == Stage::done; }

private:
  enum class Stage { warm_up, begin, prepared, play, end, refine_begin, refine, done };
  double advance(Viewer& viewer); ///< seconds to wait; 0: call again at once
  double play(Viewer& viewer);
  void collect(const InteractionMeter& meter);
  void collect_frames(const InteractionMeter& meter);
  void finish();
  CpuBill bill(const Viewer& viewer) const;
  double elapsed() const;
  void report_progress(double share_of_stage, const char* what);
  InputKind kind() const { return kinds_[kind_]; }

  BenchPlan plan_;
  ProgressBar bar_;
  MeterClock::time_point start_ = MeterClock::now();
  Stage stage_ = Stage::warm_up;
  std::vector<InputKind> kinds_;
  std::size_t kind_ = 0;
  int step_ = 0;
  double due_ = 0;       ///< time of the next input, on elapsed()'s clock
  bool resting_ = false; ///< all pictures of the last input have been shown
  CpuBill before_;
  std::uint64_t samples_before_ = 0;
  std::vector<double> frame_ms_, pass_ms_;
  BenchResult result_;
};

} // namespace candela
