#include "session/render_loop.h"

#include "core/error.h"

#include <new>
#include <utility>

namespace candela {

namespace {

/// Low priority: rendering must not delay the window.
constexpr int kRenderNiceness = 10;
/// Longest time for which the first picture after an edit is completed although a newer edit waits, so that
/// pictures appear during drags.
constexpr std::chrono::milliseconds kFirstPicturePatience{100};
/// Seconds of a pass: long enough that its synchronisation costs little, short enough to publish often.
constexpr double kInteractivePassSeconds = 0.02;
/// Side of the coarsest blocks before any sample has been timed.
constexpr int kUsualLattice = 8;

} // namespace

int coarsest_lattice(double pixels, double seconds_per_sample) {
  if (seconds_per_sample <= 0) return kUsualLattice;
  // The finest level that is rendered soon enough. If the complete picture is ready before the next frame, no
  // coarser one is needed, which would be shown for a frame.
  constexpr std::pair<int, double> kWorth[] = {{1, 12e-3},  {4, 6e-3},   {8, 12e-3},
                                               {16, 30e-3}, {32, 60e-3}, {64, 80e-3}};
  for (auto [lattice, seconds] : kWorth)
    if (pixels / (lattice * lattice) * seconds_per_sample <= seconds) return lattice;
  return 128;
}

RenderLoop::RenderLoop(SessionMonitor& monitor, WorkerThreads& workers, Mailbox& mailbox, SceneCache& scenes,
                       Presenter& presenter, const SessionOptions& options)
    : monitor_(monitor), mailbox_(mailbox), scenes_(scenes), presenter_(presenter),
      on_publish_(options.on_publish), turns_{options.turns, options.variant},
      renderer_(make_pass_renderer(options.threads)), urgent_thread_([&workers] { workers.start(0); }),
      thread_([this, &workers] {
        workers.start(kRenderNiceness);
        run();
      }) {}

void RenderLoop::set_turns(Locked, Turns turns) {
  if (turns_.turns) turns_.turns->leave(turns_.variant);
  turns_ = std::move(turns);
}

/// Whether there is work: a request, better geometry, or samples to add.
bool RenderLoop::has_work(Locked lock) const {
  return mailbox_.has_document(lock) || mailbox_.has_region(lock) || may_improve(lock) ||
         (active_ &&
          (mailbox_.may_render(lock, accumulation_.spp() > 0) || status_.phase != SessionPhase::paused));
}

/// Whether better geometry is available and using it would not delay a picture that the user waits for.
bool RenderLoop::may_improve(Locked lock) const {
  return scenes_.geometry().has_improvement(lock) && !mailbox_.paused(lock) && accumulation_.spp() > 0;
}

void RenderLoop::run() {
  while (true) {
    {
      auto lock = monitor_.lock();
      auto wakes = [&] { return mailbox_.closed(lock) || has_work(lock); };
      if (turns_.turns && (mailbox_.closed(lock) || !wakes()))
        turns_.turns->leave(turns_.variant); // the others must not wait for it
      monitor_.changed.wait(lock, wakes);
      if (mailbox_.closed(lock)) return;
    }
    const SessionPhase before = status_.phase;
    bool worked = false;
    try {
      worked = work();
    } catch (const Cancelled&) { // building was cancelled by a newer Document, or by the end
      const auto lock = monitor_.lock();
      ++status_.builds_cancelled;
      continue;
    } catch (const Error& e) { fail(e.what()); } catch (const std::bad_alloc&) {
      fail("scene: out of memory: close other programs or make the scene or the film smaller");
    }
    monitor_.changed.notify_all();
    const bool rests =
        !active_ || (status_.phase == SessionPhase::paused && (worked || status_.phase != before));
    if (rests && on_publish_) on_publish_(); // a change of phase is published, too
  }
}

/// One iteration of the loop; returns whether a pass was rendered.
bool RenderLoop::work() {
  if (!take_document()) improve();
  apply_region();
  if (status_.phase == SessionPhase::failed || built_.scene == nullptr) {
    active_ = false;
    return false;
  }
  const bool worked = !finished() && begin_pass();
  if (worked) take_turn();
  const bool other_view = accumulation_.spp() > 0 && !presenter_.is_of_view(current_.settings.view);
  const bool other_mix = accumulation_.coarseness() > 0 && !presenter_.is_of_mix(accumulation_.mix());
  active_ = !finished();
  const bool settled = !active_ || !may_render(); // evaluated once, so that phase and picture agree
  if (settled || other_view || other_mix) presenter_.show_anyway();
  if (other_view || other_mix) publish(true); // from the same samples
  if (settled && !presenter_.is_current(accumulation_.rays().samples)) publish(true);
  feed_denoiser(settled);
  const auto lock = monitor_.lock();
  if (active_)
    status_.phase = settled ? SessionPhase::paused : SessionPhase::rendering;
  else if (!mailbox_.has_document(lock) && !scenes_.geometry().improving(lock))
    status_.phase = SessionPhase::finished;
  return worked;
}

void RenderLoop::fail(std::string error) {
  const auto lock = monitor_.lock();
  status_.phase = SessionPhase::failed;
  status_.error = std::move(error);
  active_ = false;
}

/// Makes the newest Document the current one, and restarts what it affects.
bool RenderLoop::take_document() {
  bool restarts = false;
  {
    const auto lock = monitor_.lock();
    auto delivery = mailbox_.take(lock);
    if (!delivery) return false;
    current_ = std::move(delivery->document);
    status_.generation = delivery->generation;
    restarts = delivery->consequence >= Invalidates::image || status_.phase == SessionPhase::failed;
    if (restarts) {
      const std::uint64_t restart_count = status_.restarts + 1, cancelled = status_.builds_cancelled;
      status_ = {};
      status_.generation = generation_ = delivery->generation;
      status_.restarts = restart_count;
      status_.builds_cancelled = cancelled;
      presenter_.await_first_image(lock, generation_, delivery->submitted_at);
      scenes_.begin(lock);
      if (mailbox_.closed(lock)) scenes_.cancel(lock);
    }
    status_.phase = restarts ? SessionPhase::building : SessionPhase::rendering;
  }
  if (restarts)
    restart();
  else
    remix();
  return true;
}

/// Applies the factors of the current Document's light groups to the film's layers.
void RenderLoop::remix() {
  if (built_.scene == nullptr || built_.document->scene.light_groups == current_.scene.light_groups) return;
  accumulation_.set_mix(light_mix(current_.scene, built_.scene->light_layers()), current_.settings.stop);
  presenter_.remix();
  const auto lock = monitor_.lock();
  scenes_.set_light_groups(lock, current_.scene.light_groups);
  built_ = scenes_.newest(lock);
}

void RenderLoop::restart() {
  struct End { // also after cancellation and errors
    RenderLoop& loop;
    ~End() {
      const auto lock = loop.monitor_.lock();
      loop.scenes_.end(lock);
    }
  } end{*this};
  std::shared_ptr<const RenderScene> made = scenes_.build(current_);
  {
    const auto lock = monitor_.lock();
    scenes_.adopt(lock, std::move(made), current_);
    built_ = scenes_.newest(lock);
    status_.phase = SessionPhase::rendering;
  }
  const FilmSettings& size = current_.settings.film;
  urgent_ = true;
  presenter_.begin_accumulation(0);
  accumulation_.restart(
      size, {.coarsest = coarsest_lattice(static_cast<double>(size.width) * size.height, usual_seconds_),
             .mix = light_mix(current_.scene, built_.scene->light_layers()),
             .whole_first_pass = true});
}

/// Continues with better geometry of the same instances. The current picture stays until the new one has as
/// many samples.
void RenderLoop::improve() {
  {
    const auto lock = monitor_.lock();
    if (!may_improve(lock) || status_.phase == SessionPhase::failed) return;
  }
  std::shared_ptr<const RenderScene> made = scenes_.build_improved(current_);
  if (made == nullptr) return;
  urgent_ = false;
  presenter_.begin_accumulation(accumulation_.rays().samples);
  accumulation_.restart(current_.settings.film,
                        {.mix = light_mix(current_.scene, made->light_layers()), .whole_first_pass = true});
  const auto lock = monitor_.lock();
  scenes_.adopt_improved(lock, std::move(made));
  built_ = scenes_.newest(lock);
  status_.phase = SessionPhase::rendering;
}

void RenderLoop::apply_region() {
  std::optional<CropWindow> region;
  {
    const auto lock = monitor_.lock();
    region = mailbox_.take_region(lock);
    if (region && built_.scene && status_.phase != SessionPhase::failed)
      status_.phase = SessionPhase::rendering;
  }
  if (region) accumulation_.set_region(*region);
}

bool RenderLoop::may_render() const {
  const auto lock = monitor_.lock();
  return mailbox_.may_render(lock, accumulation_.spp() > 0);
}

/// Whether another pass is to be rendered.
bool RenderLoop::begin_pass() {
  const auto lock = monitor_.lock();
  if (!mailbox_.may_render(lock, accumulation_.spp() > 0)) return false;
  mailbox_.begin_pass(lock);
  status_.phase = SessionPhase::rendering;
  return true;
}

/// Renders a pass, in this session's turn.
void RenderLoop::take_turn() {
  Turns with;
  {
    const auto lock = monitor_.lock();
    with = turns_;
  }
  // The user waits for the coarsest image: it waits for no other session and is not interrupted by newer
  // edits.
  const bool urgent = accumulation_.at_coarsest() && urgent_;
  if (!with.turns) {
    render(0, urgent);
    return;
  }
  const auto turn =
      with.turns->begin(with.variant, {accumulation_.samples_per_pixel(), accumulation_.seconds()},
                        urgent ? mailbox_.closing() : mailbox_.outdated());
  if (!turn.granted) return;
  struct End { // also if memory runs out
    const Turns& with;
    ~End() { with.turns->end(with.variant); }
  } end{with};
  render(turn.most_samples, urgent);
}

/// `most_samples` a pixel; 0: no limit.
void RenderLoop::render(int most_samples, bool urgent) {
  if (urgent)
    urgent_thread_.run([&] { render_pass(most_samples, true); });
  else
    render_pass(most_samples, false);
}

/// When the pass is to end early. A held pass is continued later. Passes of many samples are short and not
/// interrupted, which would leave pixels with very different sample counts.
StopCondition RenderLoop::stop_condition(const Accumulation::Pass& pass, bool urgent) const {
  StopCondition condition(mailbox_.closing());
  if (urgent) return condition.when(mailbox_.outdated(), Mailbox::Clock::now() + kFirstPicturePatience);
  condition.when(mailbox_.outdated());
  if (pass.range.end - pass.range.begin == 1) condition.when(mailbox_.hold());
  return condition;
}

void RenderLoop::render_pass(int most_samples, bool urgent) {
  Portion portion{kInteractivePassSeconds, most_samples};
  if (accumulation_.spp() > 0) {
    const auto lock = monitor_.lock();
    if (mailbox_.take_step(lock)) {
      portion.most_samples = 1;
      status_.phase = SessionPhase::rendering;
    }
  }
  const Accumulation::Pass pass = accumulation_.next(current_.settings.stop, portion);
  const Accumulation::Step step =
      accumulation_.step(pass, *renderer_, *built_.scene, current_, stop_condition(pass, urgent));
  if (step.rays.samples > 0 && (urgent || usual_seconds_ == 0))
    usual_seconds_ = step.seconds / static_cast<double>(step.rays.samples);
  if (!step.completed) return;
  if (!pass.first)
    publish(false);
  else if (urgent || !mailbox_.outdated()) // otherwise a newer edit waits
    publish(true);
}

Presenter::Source RenderLoop::source() const { return {generation_, accumulation_, built_, current_}; }

void RenderLoop::publish(bool force) {
  auto snapshot = presenter_.snapshot(source(), force);
  const auto lock = monitor_.lock();
  presenter_.show(lock, std::move(snapshot));
  status_.spp = accumulation_.spp();
  status_.rays = accumulation_.rays();
  status_.render_seconds = accumulation_.seconds();
  status_.nonfinite = accumulation_.nonfinite().count;
  status_.progress = accumulation_.fraction(current_.settings.stop);
  monitor_.changed.notify_all();
}

void RenderLoop::feed_denoiser(bool settled) {
  auto job = presenter_.denoise_job(source(), settled);
  if (!job) return;
  const auto lock = monitor_.lock();
  if (!mailbox_.has_restart(lock))
    job = presenter_.denoise(lock, std::move(job)); // otherwise it is out of date
}

} // namespace candela
