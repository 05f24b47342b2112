#include "session/render_session.h"

#include "session/session_state.h"

namespace candela {

RenderSession::RenderSession(const SessionOptions& options) : state_(std::make_unique<State>(options)) {}
RenderSession::~RenderSession() = default;

std::uint64_t RenderSession::submit(Document document) {
  State& s = *state_;
  Mailbox::Receipt receipt;
  RenderLoop::Turns turns;
  std::unique_ptr<DenoiseJob> dropped; // freed without the lock
  {
    const auto lock = s.monitor.lock();
    if (s.scenes.is_building(lock) && is_built_anew(s.mailbox.newest(lock).scene, document.scene))
      s.scenes.cancel(lock);
    s.presenter.set_display(lock, document.settings.display);
    receipt = s.mailbox.submit(lock, std::move(document));
    if (receipt.restarts || receipt.remixes) dropped = s.presenter.outdate(lock);
    turns = s.renderer.turns(lock);
  }
  s.monitor.changed.notify_all();
  if (turns.turns) turns.turns->wake();
  return receipt.generation;
}

void RenderSession::expect_moves() {
  const auto lock = state_->monitor.lock();
  state_->scenes.geometry().prepare_moves(lock);
}

void RenderSession::pause(bool paused) {
  {
    const auto lock = state_->monitor.lock();
    state_->mailbox.pause(lock, paused);
  }
  state_->monitor.changed.notify_all();
}

void RenderSession::step() {
  {
    const auto lock = state_->monitor.lock();
    state_->mailbox.step(lock);
  }
  state_->monitor.changed.notify_all();
}

void RenderSession::set_region(const CropWindow& region) {
  {
    const auto lock = state_->monitor.lock();
    state_->mailbox.set_region(lock, region);
  }
  state_->monitor.changed.notify_all();
}

void RenderSession::publish_every(double seconds) { state_->presenter.publish_every(seconds); }

void RenderSession::take_turns(std::shared_ptr<RenderTurns> turns, int variant) {
  {
    const auto lock = state_->monitor.lock();
    state_->renderer.set_turns(lock, {std::move(turns), variant});
  }
  state_->monitor.changed.notify_all();
}

std::shared_ptr<const RenderScene> RenderSession::scene() const { return built().scene; }

std::shared_ptr<const Frame> RenderSession::latest() const {
  const auto lock = state_->monitor.lock();
  return state_->presenter.frame(lock);
}

std::shared_ptr<const DisplayImage> RenderSession::display() const {
  const auto lock = state_->monitor.lock();
  return state_->presenter.picture(lock);
}

SessionStatus RenderSession::status() const {
  const State& s = *state_;
  const auto lock = s.monitor.lock();
  SessionStatus status = s.renderer.status(lock);
  status.submitted = s.mailbox.submitted(lock);
  status.restarting = s.mailbox.restarting(lock);
  status.built = s.scenes.built_share(lock);
  status.first_image_ms = s.presenter.first_image_ms(lock);
  status.denoise_error = s.presenter.denoise_error(lock);
  return status;
}

std::optional<Pick> RenderSession::pick(vec2 film_position) const {
  const Built newest = built();
  return newest.scene ? candela::pick(*newest.scene, *newest.document, film_position) : std::nullopt;
}

RenderSession::Built RenderSession::built() const {
  const auto lock = state_->monitor.lock();
  const SceneCache::Built newest = state_->scenes.newest(lock);
  return {newest.scene, newest.document};
}

RenderSession::CpuTime RenderSession::cpu_time() const {
  const auto lock = state_->monitor.lock();
  return {state_->workers.cpu_seconds(), state_->presenter.cpu_seconds(lock)};
}

int RenderSession::threads() const { return state_->workers.count(); }

bool RenderSession::wait_finished(double seconds) const {
  const State& s = *state_;
  auto lock = s.monitor.lock();
  return s.monitor.changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
    const SessionStatus& status = s.renderer.status(lock);
    if (status.generation != s.mailbox.submitted(lock) || s.mailbox.has_document(lock)) return false;
    if (status.phase == SessionPhase::failed) return true;
    if (s.mailbox.has_region(lock) || s.mailbox.has_step(lock)) return false;
    const bool rests = status.phase == SessionPhase::finished ||
                       (status.phase == SessionPhase::paused && s.mailbox.paused(lock));
    return rests && s.presenter.shows_newest(lock, status.rays.samples);
  });
}

} // namespace candela
