#include "session/render_session.h"

#include "session/session_state.h"

#include <ctime>
#include <omp.h>

namespace candela {

namespace {

/// 0 for a thread that has ended.
double cpu_seconds(clockid_t clock) {
  timespec time{};
  if (clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

RenderSession::RenderSession(SessionOptions options) : state_(std::make_unique<State>(std::move(options))) {}
RenderSession::~RenderSession() = default;

std::uint64_t RenderSession::submit(Document document) {
  State& s = *state_;
  std::uint64_t generation;
  std::unique_ptr<DenoiseJob> dropped;
  std::shared_ptr<RenderTurns> turns;
  {
    std::lock_guard lock(s.mutex);
    turns = s.options.turns;
    Invalidates consequence =
        s.status.submitted == 0 ? Invalidates::scene : compare_documents(s.newest, document);
    if (s.building && is_built_anew(s.newest.scene, document.scene)) s.building->cancel();
    s.newest = document;
    s.pending = std::move(document);
    s.pending_worst = std::max(s.pending_worst, consequence);
    if (consequence >= Invalidates::image) {
      s.submitted_at = Clock::now();
      s.stop = true;
      dropped = s.denoiser.cancel();
      s.status.denoise_error.clear();
    }
    generation = ++s.status.submitted;
    if (consequence >= Invalidates::image) s.status.restarting = generation;
  }
  s.changed.notify_all();
  if (turns) turns->wake();
  return generation;
}

void RenderSession::expect_moves() {
  const std::shared_ptr<const RenderScene> newest = scene();
  if (newest == nullptr || newest->geometry().quality() == BuildQuality::fast) return;
  GeometryJob job{newest->instances(), BuildQuality::fast, {}, 0};
  State& s = *state_;
  std::lock_guard lock(s.mutex);
  if (s.scene != newest) return; // an edit was quicker
  job.known = s.objects;
  s.geometry_thread.post(std::move(job));
}

void RenderSession::pause(bool paused) {
  State& s = *state_;
  {
    std::lock_guard lock(s.mutex);
    s.paused = paused;
    s.steps_wanted = 0;
    if (paused) s.hold = true;
  }
  s.changed.notify_all();
}

void RenderSession::step() {
  State& s = *state_;
  {
    std::lock_guard lock(s.mutex);
    s.paused = true;
    ++s.steps_wanted;
  }
  s.changed.notify_all();
}

void RenderSession::set_region(const CropWindow& region) {
  State& s = *state_;
  {
    std::lock_guard lock(s.mutex);
    s.region = region;
    s.region_changed = s.hold = true;
  }
  s.changed.notify_all();
}

void RenderSession::publish_every(double seconds) { state_->publish_interval = seconds; }

void RenderSession::take_turns(std::shared_ptr<RenderTurns> turns, int side) {
  {
    std::lock_guard lock(state_->mutex);
    if (state_->options.turns) state_->options.turns->leave(state_->options.side);
    state_->options.turns = std::move(turns);
    state_->options.side = side;
  }
  state_->changed.notify_all();
}

std::shared_ptr<const RenderScene> RenderSession::scene() const {
  std::lock_guard lock(state_->mutex);
  return state_->scene;
}

std::shared_ptr<const Frame> RenderSession::latest() const {
  std::lock_guard lock(state_->mutex);
  return state_->frame;
}

std::shared_ptr<const DisplayImage> RenderSession::display() const {
  std::lock_guard lock(state_->mutex);
  return state_->picture;
}

SessionStatus RenderSession::status() const {
  std::lock_guard lock(state_->mutex);
  SessionStatus status = state_->status;
  status.built = state_->building ? state_->building->share() : 0;
  return status;
}

std::optional<Pick> RenderSession::pick(vec2 film_position) const {
  const Built newest = built();
  return newest.scene ? candela::pick(*newest.scene, *newest.document, film_position) : std::nullopt;
}

RenderSession::Built RenderSession::built() const {
  std::lock_guard lock(state_->mutex);
  return {state_->scene, state_->scene_document};
}

RenderSession::CpuTime RenderSession::cpu_time() const {
  std::lock_guard lock(state_->mutex);
  CpuTime time;
  for (clockid_t clock : state_->team_clocks) time.render += cpu_seconds(clock);
  if (state_->presenter_clock) time.present = cpu_seconds(*state_->presenter_clock);
  return time;
}

int RenderSession::threads() const {
  const int wanted = state_->options.threads;
  return wanted > 0 ? wanted : omp_get_num_procs();
}

bool RenderSession::wait_finished(double seconds) const {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  return s.changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
    if (s.status.generation != s.status.submitted || s.pending) return false;
    if (s.status.phase == SessionPhase::failed) return true;
    if (s.region_changed || (s.paused && s.steps_wanted > 0)) return false;
    const bool still =
        s.status.phase == SessionPhase::finished || (s.status.phase == SessionPhase::paused && s.paused);
    if (!still || !s.picture || s.picture->frame != s.frame ||
        s.picture->display != s.newest.settings.display)
      return false;
    if (!s.newest.settings.display.denoise || s.frame->view != View::radiance || s.frame->spp < 2 ||
        !s.status.denoise_error.empty())
      return true;
    return s.picture->denoised && s.picture->denoised->accumulation == s.frame->generation &&
           s.picture->denoised->samples == s.status.rays.samples;
  });
}

} // namespace candela
