#include "app/bench/interaction_bench.h"

#include "app/platform/load_average.h"
#include "core/error.h"
#include "core/statistics.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <omp.h>
#include <unistd.h>

namespace candela {

namespace {

constexpr double kInputSeconds = 1 / 60.0; // from one movement of a flight to the next
constexpr double kLook = 0.25;             // how often to poll what sends no event
/// Spreads the delay between a picture and the next input, so that inputs fall evenly between two frames of a
/// slow window: multiples of the golden ratio modulo 1 fill the range evenly.
constexpr double kRest = 0.05, kRestSpread = 0.1;
constexpr double kGoldenStep = 0.6180339887498949;

// Targets for interaction that feels direct on a machine without a GPU.
constexpr double kFirstImageShare = 1 / 20.0; // of a pass over all pixels
constexpr double kFirstImageFloor = 15;       // ms
constexpr double kFrameTail = 2;              // 99th percentile over the median
constexpr double kRenderShare = 0.85;

double clock_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// CPU time of all programs on this machine; 0 if unknown.
double machine_seconds() {
  std::ifstream file("/proc/stat");
  std::string cpu;
  double user = 0, nice = 0, system = 0, idle = 0, wait = 0, interrupts = 0, soft = 0, steal = 0;
  if (!(file >> cpu >> user >> nice >> system >> idle >> wait >> interrupts >> soft >> steal)) return 0;
  return (user + nice + system + interrupts + soft + steal) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

bool moves_mouse(InputKind kind) { return kind == InputKind::camera || kind == InputKind::flight; }

} // namespace

Percentiles percentiles_of(std::span<const double> values) {
  return {values.size(), percentile(values, 50), percentile(values, 90), percentile(values, 99)};
}

CpuBill CpuBill::operator-(const CpuBill& o) const {
  return {wall - o.wall,       render - o.render,   present - o.present, window - o.window,
          process - o.process, machine - o.machine, passes - o.passes};
}

double CpuBill::render_share(int cores) const {
  const double others = std::max(machine - process, 0.0);
  return render / std::max(wall * cores - others, render);
}

std::vector<Target> targets(const BenchResult& r) {
  std::vector<Target> out;
  const double first = std::max(kFirstImageShare * r.full_pass_ms, kFirstImageFloor);
  for (const KindResult& k : r.kinds)
    out.push_back({fmt::format("first image, {}", to_string(k.kind)), k.first.median, first, "ms", false});
  out.push_back({"99th percentile of frames", r.frames.p99, kFrameTail * r.frames.median, "ms", false});
  out.push_back(
      {"cores to rendering", 100 * r.refining.render_share(r.threads), 100 * kRenderShare, "%", true});
  return out;
}

InteractionBench::InteractionBench(const BenchPlan& plan, int threads) : plan_(plan), bar_(plan.quiet) {
  result_.threads = threads > 0 ? threads : omp_get_num_procs();
  result_.load[0] = load_average();
}

double InteractionBench::elapsed() const {
  return std::chrono::duration<double>(MeterClock::now() - start_).count();
}

void InteractionBench::report_progress(double share_of_stage, const char* what) {
  const double stages = static_cast<double>(kinds_.size()) + 1;
  bar_.update((static_cast<double>(kind_) + share_of_stage) / stages, what);
}

CpuBill InteractionBench::bill(const Viewer& viewer) const {
  const RenderSession::CpuTime session = viewer.session().cpu_time();
  return {elapsed(),
          session.render,
          session.present,
          clock_seconds(CLOCK_THREAD_CPUTIME_ID),
          clock_seconds(CLOCK_PROCESS_CPUTIME_ID),
          machine_seconds(),
          viewer.session().status().render_seconds};
}

double InteractionBench::next(Viewer& viewer) {
  if (const std::string& error = viewer.session().status().error; !error.empty())
    throw Error(ExitCode::bad_input, error);
  double wait = 0;
  while ((wait = advance(viewer)) == 0) {}
  return wait;
}

double InteractionBench::advance(Viewer& viewer) {
  const double now = elapsed();
  const auto& picture = viewer.state().picture;
  const SessionStatus status = viewer.session().status();
  const bool settled = !viewer.has_pending_events() && !viewer.meter().waiting() && picture &&
                       picture->frame->generation == status.restarting && picture->frame->spp > 0;
  if (stage_ != Stage::refine && stage_ != Stage::done && !settled &&
      !(stage_ == Stage::play && kind() == InputKind::flight))
    return kLook;
  switch (stage_) {
  case Stage::warm_up:
    for (InputKind k : kInputKinds)
      if (can_edit(k, viewer.state().document)) kinds_.push_back(k);
    result_.size = {picture->width, picture->height};
    stage_ = Stage::begin;
    return 0;
  case Stage::begin:
    step_ = 0;
    if (moves_mouse(kind())) {
      const vec2 at = flight_position(0, viewer.framebuffer());
      viewer.handle(MouseMoved{at + vec2(0, 40)}); // too far for a click
      viewer.handle(MouseButtonChanged{MouseButton::left, true});
      viewer.handle(MouseMoved{at});
    }
    stage_ = Stage::prepared;
    return kLook;
  case Stage::prepared:
    viewer.meter().clear();
    due_ = now + kRest;
    stage_ = Stage::play;
    return 0;
  case Stage::play: return play(viewer);
  case Stage::end:
    collect(viewer.meter());
    if (moves_mouse(kind())) viewer.handle(MouseButtonChanged{MouseButton::left, false});
    stage_ = ++kind_ < kinds_.size() ? Stage::begin : Stage::refine_begin;
    return kLook;
  case Stage::refine_begin:
    viewer.meter().clear();
    before_ = bill(viewer);
    samples_before_ = status.rays.samples;
    due_ = now + plan_.seconds;
    stage_ = Stage::refine;
    return 0;
  case Stage::refine:
    report_progress(1 - (due_ - now) / plan_.seconds, "refining");
    if (now < due_) return std::min(due_ - now, kLook);
    if (status.rays.samples == samples_before_) return kLook; // no pass has ended yet
    result_.refining = bill(viewer) - before_;
    result_.samples_per_second =
        static_cast<double>(status.rays.samples - samples_before_) / result_.refining.wall;
    collect_frames(viewer.meter());
    finish();
    stage_ = Stage::done;
    return -1;
  case Stage::done: return -1;
  }
  return -1;
}

/// The next input of this kind once it is due: at fixed times in a flight, else some time after the last
/// picture of the previous input.
double InteractionBench::play(Viewer& viewer) {
  const double now = elapsed();
  const bool flies = kind() == InputKind::flight;
  const int steps = flies ? static_cast<int>(std::ceil(plan_.seconds / kInputSeconds)) : plan_.repeats;
  report_progress(static_cast<double>(step_) / steps, to_string(kind()));
  if (step_ == steps) {
    stage_ = Stage::end;
    return 0;
  }
  if (!flies && !resting_) {
    resting_ = true;
    due_ = now + kRest + kRestSpread * std::fmod(step_ * kGoldenStep, 1.0);
  }
  if (now < due_) return due_ - now;
  if (moves_mouse(kind()))
    viewer.handle(MouseMoved{flight_position(flies ? step_ + 1 : 5 * (step_ + 1), viewer.framebuffer())});
  else
    viewer.handle(DocumentEdited{
        [kind = kind(), step = step_](Document& document) { apply_edit(kind, step, document); }});
  ++step_;
  resting_ = false;
  due_ = std::max(due_ + kInputSeconds, now); // after a delay, no inputs are made up for
  return flies ? kInputSeconds : kLook;
}

void InteractionBench::collect(const InteractionMeter& meter) {
  KindResult out;
  out.kind = kind();
  std::vector<double> first, full, coarseness;
  for (const Interaction& i : meter.interactions()) {
    first.push_back(i.first_ms);
    coarseness.push_back(i.coarseness);
    if (i.full_ms < 0) continue;
    full.push_back(i.full_ms);
    pass_ms_.push_back(i.pass_ms);
  }
  out.first = percentiles_of(first);
  if (kind() != InputKind::flight) out.full = percentiles_of(full);
  out.coarseness = percentiles_of(coarseness);
  result_.kinds.push_back(out);
  collect_frames(meter);
}

void InteractionBench::collect_frames(const InteractionMeter& meter) {
  for (const WindowFrame& frame : meter.frames()) {
    if (!frame.rendering) continue;
    frame_ms_.push_back(1000 * frame.seconds);
    result_.dropped += static_cast<std::size_t>(frame.dropped);
  }
}

void InteractionBench::finish() {
  result_.frames = percentiles_of(frame_ms_);
  result_.full_pass_ms = percentiles_of(pass_ms_).median;
  result_.load[1] = load_average();
  bar_.finish(fmt::format("measured for {:.0f} s", elapsed()));
}

} // namespace candela
