// The render thread: takes Documents, restarts what they change, adds samples.

#include "core/error.h"
#include "render/film/film_view.h"
#include "session/session_state.h"

#include <new>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace candela {

/// libgomp keeps a team for the thread that forks it, as long as the number of threads stays. Its threads
/// inherit the niceness.
void RenderSession::State::meet_team(int niceness) {
  if (niceness > 0) setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
  omp_set_num_threads(options.threads > 0 ? options.threads : omp_get_num_procs()); // one team for all work
  std::vector<clockid_t> clocks;
  std::mutex adding;
#pragma omp parallel
  {
    const clockid_t clock = thread_cpu_clock();
    std::lock_guard lock(adding);
    clocks.push_back(clock);
  }
  std::lock_guard lock(mutex);
  team_clocks.insert(team_clocks.end(), clocks.begin(), clocks.end());
}

void RenderSession::State::render_loop() {
  meet_team(kRenderNiceness); // rendering takes what the window leaves over
  bool active = false;        // something to add samples to
  while (true) {
    {
      std::unique_lock lock(mutex);
      auto has_work = [&] {
        return quit || pending || region_changed || may_improve() ||
               (active && (may_go_on() || status.phase != SessionPhase::paused));
      };
      if (options.turns && (quit || !has_work())) options.turns->leave(options.side); // nobody waits for it
      changed.wait(lock, has_work);
      if (quit) return;
    }
    const SessionPhase before = status.phase;
    bool worked = false;
    try {
      if (!take_pending()) improve();
      apply_region();
      if (status.phase == SessionPhase::failed || scene == nullptr) {
        active = false;
        continue;
      }
      worked = !finished() && begin_pass();
      if (worked) step();
      const bool other_view = spp > 0 && published_view != current.settings.view; // of the same samples
      active = !finished();
      const bool settled = !active || !goes_on(); // asked once: phase and picture must agree about it
      if (settled || other_view) samples_to_show = 0;
      if (other_view) publish(true);
      if (settled && published_samples != rays.samples) publish(true);
      feed_denoiser(settled);
      std::lock_guard lock(mutex);
      if (active)
        status.phase = settled ? SessionPhase::paused : SessionPhase::rendering;
      else if (!pending && !improving())
        status.phase = SessionPhase::finished;
    } catch (const Cancelled&) { // building: a newer Document waits, or the end
      std::lock_guard lock(mutex);
      ++status.builds_cancelled;
      continue;
    } catch (const Error& e) {
      std::lock_guard lock(mutex);
      status.phase = SessionPhase::failed;
      status.error = e.what();
      active = false;
    } catch (const std::bad_alloc&) {
      std::lock_guard lock(mutex);
      status.phase = SessionPhase::failed;
      status.error = "scene: out of memory: close other programs or make the scene or the film smaller";
      active = false;
    }
    changed.notify_all();
    const bool rests =
        !active || (status.phase == SessionPhase::paused && (worked || status.phase != before));
    if (rests && options.on_publish) options.on_publish(); // the phase is news, too
  }
}

/// Moves the newest Document into `current`, restarting what it must.
bool RenderSession::State::take_pending() {
  Invalidates worst;
  {
    std::lock_guard lock(mutex);
    if (!pending) return false;
    current = std::move(*pending);
    pending.reset();
    worst = pending_worst;
    pending_worst = Invalidates::nothing;
    stop = false;
    status.generation = status.submitted;
    bool restarts = worst >= Invalidates::image || status.phase == SessionPhase::failed;
    if (restarts) {
      worst = std::max(worst, Invalidates::image);
      ++status.restarts;
      status.first_image_ms = -1;
      status.error.clear();
      first_image_generation = accumulation = status.generation;
      first_image_submitted = submitted_at;
      status.spp = 0;
      status.rays = {};
      status.render_seconds = 0;
      status.progress = 0;
      status.nonfinite = 0;
      building = std::make_shared<Progress>();
      if (quit) building->cancel();
    }
    status.phase = worst >= Invalidates::image ? SessionPhase::building : SessionPhase::rendering;
  }
  if (worst >= Invalidates::image) restart();
  return true;
}

bool RenderSession::State::goes_on() const {
  std::lock_guard lock(mutex);
  return may_go_on();
}

/// Whether there still is to be a pass; from now on, whoever wants it to wait must say so again, and waits
/// for what has been begun.
bool RenderSession::State::begin_pass() {
  std::lock_guard lock(mutex);
  if (!may_go_on()) return false;
  hold = false;
  status.phase = SessionPhase::rendering;
  return true;
}

/// When the pass that begins now is to end early. `may_wait`: it may be held and go on later; those of many
/// samples are short, and left in their middle they would put pixels far ahead of others.
StopCondition RenderSession::State::stop_condition(bool waited_for, bool may_wait) const {
  StopCondition condition(quitting);
  if (waited_for) return condition.when(stop, Clock::now() + kFirstPicturePatience);
  condition.when(stop);
  if (may_wait) condition.when(hold);
  const auto limit = static_cast<double>(current.settings.stop.time);
  if (limit > 0 && spp > 0)
    condition.at(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(std::min(limit - render_seconds, 1e9))));
  return condition;
}

/// Whether this pass is one that step() asked for.
bool RenderSession::State::take_step() {
  std::lock_guard lock(mutex);
  if (steps_wanted == 0) return false;
  --steps_wanted;
  status.phase = SessionPhase::rendering;
  return true;
}

void RenderSession::State::apply_region() {
  CropWindow wanted;
  {
    std::lock_guard lock(mutex);
    if (!region_changed) return;
    region_changed = false;
    wanted = region;
    if (scene && status.phase != SessionPhase::failed) status.phase = SessionPhase::rendering;
  }
  schedule.set_region(wanted);
  converged = false; // within another region
  if (spp > 0) spp = static_cast<int>(schedule.samples());
}

/// Seconds after the last edit of geometry: nobody waits for the better one, and each step of a drag would
/// begin to build it in vain.
constexpr double kHandRests = 0.3;

std::size_t first_level(double pixels, double seconds_per_sample) {
  if (seconds_per_sample <= 0) return kUsualLevel;
  // Finer pictures are worth some waiting, coarser ones only the saving of a lot.
  constexpr std::pair<std::size_t, double> kWorth[] = {
      {5, 6e-3}, {4, 12e-3}, {3, 30e-3}, {2, 60e-3}, {1, 80e-3}};
  for (auto [level, seconds] : kWorth)
    if (pixels / (kCoarseLevels[level] * kCoarseLevels[level]) * seconds_per_sample <= seconds) return level;
  return 0;
}

void RenderSession::State::restart() {
  // Materials and lights are made anew, which is quick; the geometry stays where the instances stay.
  struct End { // also when it is cancelled or fails
    State& state;
    ~End() {
      std::lock_guard lock(state.mutex);
      state.building.reset();
    }
  } end{*this};
  const std::shared_ptr<const RenderScene> previous = scene ? scene : options.geometry_of;
  const std::vector<Instance>& instances = current.scene.instances;
  std::shared_ptr<const Geometry> geometry = geometry_for(instances, previous.get());
  std::shared_ptr<Progress> progress;
  {
    std::lock_guard lock(mutex);
    progress = building;
  }
  if (previous == nullptr || geometry != previous->shared_geometry())
    unused = Improvement{instances, geometry};
  auto made = RenderScene::build(current, geometry, previous.get(), progress.get());
  unused.reset();
  const bool is_new = scene == nullptr || scene->shared_geometry() != geometry;
  {
    std::lock_guard lock(mutex);
    scene = std::move(made);
    scene_document = std::make_shared<const Document>(current);
    status.phase = SessionPhase::rendering;
    if (is_new) {
      improvement.reset();
      keep_objects(*geometry, instances);
      stays_fast = false;
      if (geometry->quality() == BuildQuality::fast)
        geometry_thread.post({instances, BuildQuality::high, objects, kHandRests});
      else
        geometry_thread.cancel();
    }
  }
  const FilmSettings& size = current.settings.film;
  film.resize(size.width, size.height);
  samples_to_show = 0;
  urgent_first = true;
  begin_accumulation(first_level(static_cast<double>(size.width) * size.height, usual_seconds));
}

void RenderSession::State::begin_accumulation(std::size_t first_level) {
  rays = {};
  nonfinite = {};
  render_seconds = 0;
  level = begun_level = first_level;
  spp = 0;
  schedule.reset({0, 0, film.width(), film.height()}, 1); // the first pass is everywhere
  converged = pass_held = false;
  noise = std::numeric_limits<double>::infinity();
  published_samples = 0;
  denoised_samples = 0;
  seconds_per_sample = 0;
}

bool RenderSession::State::finished() const {
  const StopSettings& until = current.settings.stop;
  if (spp == 0) return false;
  return converged || (until.noise > 0 && noise <= static_cast<double>(until.noise)) ||
         (until.spp > 0 && spp >= until.spp && !pass_held) ||
         (until.time > 0 && render_seconds >= static_cast<double>(until.time));
}

/// Renders a portion, when it is this session's turn.
void RenderSession::State::step() {
  std::shared_ptr<RenderTurns> turns;
  int side = 0;
  {
    std::lock_guard lock(mutex);
    turns = options.turns;
    side = options.side;
  }
  if (!turns) {
    render_portion(0);
    return;
  }
  const double samples = spp > 0 ? spp : static_cast<double>(level - begun_level) / std::size(kCoarseLevels);
  // Like the pass itself, the turn of the coarsest image is never given up for a newer edit.
  const bool waited_for = level == begun_level && urgent_first;
  const auto turn = turns->begin(side, {samples, render_seconds}, waited_for ? quitting : stop);
  if (!turn.granted) return;
  struct End { // also when memory runs out
    RenderTurns& turns;
    int side;
    ~End() { turns.end(side); }
  } end{*turns, side};
  render_portion(turn.most_samples);
}

/// `most_samples` a pixel; 0: as many as are worth it.
void RenderSession::State::render_portion(int most_samples) {
  if (level == begun_level && urgent_first)
    urgent.run([&] { render_pass_of(most_samples); });
  else
    render_pass_of(most_samples);
}

void RenderSession::State::render_pass_of(int most_samples) {
  PassOptions pass_options;
  pass_options.threads = options.threads;
  SampleRange range;
  SampleSchedule::Job job;
  const bool coarse = level < std::size(kCoarseLevels), first = level == begun_level,
             waited_for = first && urgent_first;
  if (coarse) {
    range.lattice = kCoarseLevels[level];
    range.skip_lattice = first ? 0 : kCoarseLevels[level - 1];
    film.clear(range.lattice,
               range.skip_lattice); // of the image before; all at once would keep a hand waiting
  } else {
    // Enough samples a pass to be worth its synchronisation, few enough to publish often.
    job = schedule.next(1);
    const double pixels = static_cast<double>(job.window.width) * job.window.height;
    int portion = 1;
    if (!take_step() && seconds_per_sample > 0)
      portion = static_cast<int>(std::clamp(0.02 / (seconds_per_sample * pixels), 1.0, 64.0));
    if (most_samples > 0) portion = std::min(portion, most_samples);
    if (current.settings.stop.spp > 0) portion = std::min(portion, current.settings.stop.spp - spp);
    if (current.settings.stop.noise > 0) portion = std::min(portion, next_noise_check(spp) - spp);
    job = schedule.next(static_cast<std::uint32_t>(portion));
    range.begin = job.begin;
    range.end = job.end;
    pass_options.crop = job.window;
  }
  auto start = Clock::now();
  const bool continued = std::exchange(pass_held, false);
  PassResult pass = render_pass(*scene, current, range, film,
                                stop_condition(waited_for, range.end - range.begin == 1), pass_options);
  double taken = seconds_between(start, Clock::now());
  render_seconds += taken;
  rays += pass.rays;
  nonfinite += pass.nonfinite;
  if (pass.rays.samples > 0 && (waited_for || usual_seconds == 0))
    usual_seconds = taken / static_cast<double>(pass.rays.samples);
  pass_held = !pass.completed;
  if (!pass.completed) return;
  if (coarse) {
    ++level;
    if (level == std::size(kCoarseLevels)) spp = 1, first_pass_seconds = render_seconds;
    if (waited_for || !stop) publish(true); // a newer edit waits
  } else {
    if (!continued) // or it was a part of a pass
      seconds_per_sample =
          taken / (static_cast<double>(job.end - job.begin) * job.window.width * job.window.height);
    schedule.done(job);
    spp = static_cast<int>(schedule.samples());
    converged = pass.converged && current.settings.adaptive.error > 0;
    if (current.settings.stop.noise > 0 && is_noise_check(spp)) noise = std::sqrt(estimated_relmse(film));
    publish(false);
  }
}

} // namespace candela
