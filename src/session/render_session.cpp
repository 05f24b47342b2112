#include "session/render_session.h"

#include "core/error.h"
#include "render/film_view.h"
#include "render/render_pass.h"
#include "session/sample_schedule.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

/// Side of the blocks of the first pass; each is a multiple of the next, so the lattices nest.
constexpr int kCoarseLevels[] = {8, 4, 2, 1};
/// Copying a frame out must not take more of the render thread than this share.
constexpr double kPublishShare = 0.05;

} // namespace

// Three threads: `renderer` turns Documents into Frames, `denoiser` turns snapshots of the film into
// DenoisedImages, `presenter` turns either into DisplayImages. The mutex guards pointers and small values and
// is never held while one of them works.
struct RenderSession::State {
  explicit State(SessionOptions o) : options(std::move(o)) {
    renderer = std::jthread([this] { render_loop(); });
    presenter = std::jthread([this] { present_loop(); });
  }
  ~State() {
    {
      std::lock_guard lock(mutex);
      quit = true;
      quitting = stop = true;
    }
    changed.notify_all();
    if (options.turns) options.turns->wake();
  }

  SessionOptions options;
  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  bool quit = false;
  std::atomic<bool> stop{false};     ///< the pass in flight is out of date
  std::atomic<bool> quitting{false}; ///< `quit`, for who does not hold the mutex

  // The mailbox.
  std::optional<Document> pending;
  Invalidates pending_worst = Invalidates::nothing; ///< over all that pending replaced
  Document newest;                                  ///< last submitted
  Clock::time_point submitted_at;                   ///< of the last one that restarts
  BuildQuality quality = BuildQuality::high;        ///< of the newest
  bool paused = false;
  int steps_wanted = 0;
  CropWindow region;
  bool region_changed = false;

  // What is shown.
  SessionStatus status;
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const DisplayImage> picture;
  std::uint64_t first_image_generation =
      0; ///< of the accumulation whose first image is still awaited; 0: none
  Clock::time_point first_image_submitted;  ///< when that was submitted
  std::shared_ptr<const RenderScene> scene; ///< newest built, with its document, for picking
  std::shared_ptr<const Document> scene_document;
  std::shared_ptr<const DenoisedImage> denoised; ///< newest, of any accumulation

  // The render thread's own.
  Document current;
  std::uint64_t accumulation = 0; ///< generation of the Document that restarted last
  Film film;
  RayCounts rays;
  NonFiniteLog nonfinite;
  double render_seconds = 0;
  std::size_t level = 0; ///< next of kCoarseLevels
  SampleSchedule schedule;
  int spp = 0;            ///< complete passes over the film, or over the region
  bool converged = false; ///< adaptive sampling has stopped everywhere
  double noise = std::numeric_limits<double>::infinity(); ///< when stop.noise was asked last
  BuildQuality built = BuildQuality::high;                ///< of the scene's geometry
  std::uint64_t published_samples = 0; ///< camera paths in the last snapshot: spp may come to the same twice
  View published_view = View::radiance;
  double seconds_per_sample = 0; ///< of one pixel
  double publish_cost = 0;
  Clock::time_point published_at;
  std::uint64_t denoised_samples = 0; ///< in the newest snapshot for the denoiser; 0: there is none

  DenoiseThread denoiser{
      options.threads, [this](std::shared_ptr<const DenoisedImage> made) { show_denoised(std::move(made)); }};
  std::jthread renderer, presenter; // last: they are joined before the rest goes

  void render_loop();
  bool take_pending();
  void restart();
  void apply_region();
  bool finished() const;
  /// Paused, only steps are taken, and the first pass of an edit. The mutex must be held.
  bool may_go_on() const { return !paused || steps_wanted > 0 || spp == 0; }
  bool goes_on() const;
  bool take_step();
  void step();
  void render_portion(int most_samples);
  void publish(bool force);
  void feed_denoiser(bool settled);
  void show_denoised(std::shared_ptr<const DenoisedImage> made);
  /// The denoised image that belongs to the newest frame, if it is to be shown. The mutex must be held.
  std::shared_ptr<const DenoisedImage> denoised_to_show() const;
  void present_loop();
};

void RenderSession::State::render_loop() {
  // Rendering takes what the window leaves over. The OpenMP team is made by this thread and inherits its
  // niceness.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
  bool active = false; // something to add samples to
  while (true) {
    {
      std::unique_lock lock(mutex);
      auto has_work = [&] { return quit || pending || region_changed || (active && may_go_on()); };
      if (options.turns && (quit || !has_work())) options.turns->leave(options.side); // nobody waits for it
      changed.wait(lock, has_work);
      if (quit) return;
    }
    const SessionPhase before = status.phase;
    try {
      take_pending();
      apply_region();
      if (status.phase == SessionPhase::failed || scene == nullptr) {
        active = false;
        continue;
      }
      if (!finished() && goes_on()) step();
      if (spp > 0 && published_view != current.settings.view) publish(true); // of the same samples
      active = !finished();
      const bool settled = !active || !goes_on();
      if (settled && published_samples != rays.samples) publish(true);
      feed_denoiser(settled);
      std::lock_guard lock(mutex);
      if (active)
        status.phase = may_go_on() ? SessionPhase::rendering : SessionPhase::paused;
      else if (!pending)
        status.phase = SessionPhase::finished;
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
    const bool rests = !active || (status.phase == SessionPhase::paused && status.phase != before);
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

void RenderSession::State::restart() {
  // Materials and lights are made anew, which is quick; the geometry stays where the instances stay.
  BuildQuality wanted;
  {
    std::lock_guard lock(mutex);
    wanted = quality;
  }
  const bool too_coarse = built == BuildQuality::fast && wanted == BuildQuality::high;
  const RenderScene* previous = scene ? scene.get() : options.geometry_of.get();
  auto made = RenderScene::build(current, too_coarse ? nullptr : previous, wanted);
  if (scene == nullptr || &made->geometry() != &scene->geometry()) built = wanted;
  {
    std::lock_guard lock(mutex);
    scene = std::move(made);
    scene_document = std::make_shared<const Document>(current);
    status.phase = SessionPhase::rendering;
  }
  const FilmSettings& size = current.settings.film;
  film = Film(size.width, size.height);
  rays = {};
  nonfinite = {};
  render_seconds = 0;
  level = 0;
  spp = 0;
  schedule.reset(size.width, size.height, 1); // the first pass is everywhere
  converged = false;
  noise = std::numeric_limits<double>::infinity();
  published_samples = 0;
  denoised_samples = 0;
  seconds_per_sample = 0;
}

bool RenderSession::State::finished() const {
  const StopSettings& until = current.settings.stop;
  if (spp == 0) return false;
  return converged || (until.noise > 0 && noise <= static_cast<double>(until.noise)) ||
         (until.spp > 0 && spp >= until.spp) ||
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
  const double samples = spp > 0 ? spp : static_cast<double>(level) / std::size(kCoarseLevels);
  // Like the pass itself, the turn of the coarsest image is never given up for a newer edit.
  const auto turn = turns->begin(side, {samples, render_seconds}, level == 0 ? quitting : stop);
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
  static const std::atomic<bool> kNeverStop{false};
  PassOptions pass_options;
  pass_options.threads = options.threads;
  SampleRange range;
  SampleSchedule::Job job;
  bool coarse = level < std::size(kCoarseLevels);
  if (coarse) {
    range.lattice = kCoarseLevels[level];
    range.skip_lattice = level > 0 ? kCoarseLevels[level - 1] : 0;
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
  // The coarsest image is always finished: while an edit is dragged there is a picture of every moment.
  PassResult pass = render_pass(*scene, current, range, film, level == 0 ? kNeverStop : stop, pass_options);
  double taken = seconds_between(start, Clock::now());
  render_seconds += taken;
  rays += pass.rays;
  nonfinite.count += pass.nonfinite.count;
  for (const NonFiniteSample& s : pass.nonfinite.records)
    if (nonfinite.records.size() < NonFiniteLog::kMaxRecords) nonfinite.records.push_back(s);
  if (!pass.completed) return;
  if (coarse) {
    ++level;
    if (level == std::size(kCoarseLevels)) spp = 1;
    publish(true);
  } else {
    seconds_per_sample =
        taken / (static_cast<double>(job.end - job.begin) * job.window.width * job.window.height);
    schedule.done(job);
    spp = static_cast<int>(schedule.samples());
    converged = pass.converged && current.settings.adaptive.error > 0;
    if (current.settings.stop.noise > 0 && is_noise_check(spp)) noise = std::sqrt(estimated_relmse(film));
    publish(false);
  }
}

/// Hands a snapshot to the presenter; between full images only so often that copying costs little.
void RenderSession::State::publish(bool force) {
  auto start = Clock::now();
  double interval = std::max(options.min_publish_interval, publish_cost / kPublishShare);
  bool due = force || seconds_between(published_at, start) >= interval;
  std::shared_ptr<Frame> snapshot;
  if (due) {
    snapshot = std::make_shared<Frame>();
    snapshot->generation = accumulation;
    snapshot->width = film.width();
    snapshot->height = film.height();
    snapshot->coarseness = spp > 0 ? 1 : kCoarseLevels[level - 1];
    snapshot->spp = spp;
    snapshot->document = scene_document;
    snapshot->view = current.settings.view;
    resolve_view(film, snapshot->view, snapshot->coarseness, snapshot->linear);
    if (spp > 0) resolve_statistics(film, snapshot->variance, snapshot->samples);
    snapshot->display_scale = display_scale(*scene, current.settings);
    snapshot->rays = rays;
    snapshot->render_seconds = render_seconds;
    snapshot->nonfinite = nonfinite;
    published_samples = rays.samples;
    published_view = snapshot->view;
    published_at = Clock::now();
    publish_cost = seconds_between(start, published_at);
  }
  std::lock_guard lock(mutex);
  if (snapshot) frame = std::move(snapshot);
  status.spp = spp;
  status.rays = rays;
  status.render_seconds = render_seconds;
  status.nonfinite = nonfinite.count;
  const StopSettings& until = current.settings.stop;
  double by_spp = until.spp > 0 ? static_cast<double>(spp) / until.spp : 0;
  double by_time = until.time > 0 ? render_seconds / static_cast<double>(until.time) : 0;
  status.progress = std::min(std::max(by_spp, by_time), 1.0);
  changed.notify_all();
}

/// Takes a snapshot for the denoiser whenever the samples have doubled, which costs the render thread ever
/// less, and when no more come.
void RenderSession::State::feed_denoiser(bool settled) {
  if (!current.settings.display.denoise || current.settings.view != View::radiance || spp < 2) return;
  const bool due = rays.samples >= 2 * denoised_samples || (settled && rays.samples != denoised_samples);
  if (!due) return;
  auto job = std::make_unique<DenoiseJob>();
  job->accumulation = accumulation;
  job->samples = rays.samples;
  job->spp = spp;
  job->color = noisy_image(film);
  std::unique_ptr<DenoiseJob> replaced;
  std::lock_guard lock(mutex);
  if (pending && pending_worst >= Invalidates::image) return; // it is out of date already
  job->scene = scene;
  job->document = scene_document;
  replaced = denoiser.post(std::move(job));
  denoised_samples = rays.samples;
}

void RenderSession::State::show_denoised(std::shared_ptr<const DenoisedImage> made) {
  {
    std::lock_guard lock(mutex);
    denoised = std::move(made);
  }
  changed.notify_all();
}

std::shared_ptr<const DenoisedImage> RenderSession::State::denoised_to_show() const {
  const bool fits = newest.settings.display.denoise && frame && frame->view == View::radiance && denoised &&
                    denoised->accumulation == frame->generation;
  return fits ? denoised : nullptr;
}

void RenderSession::State::present_loop() {
  while (true) {
    std::shared_ptr<const Frame> source;
    std::shared_ptr<const DenoisedImage> clean;
    DisplaySettings display;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] {
        return quit || (frame &&
                        (!picture || picture->frame != frame || picture->display != newest.settings.display ||
                         picture->denoised != denoised_to_show()));
      });
      if (quit) return;
      source = frame;
      clean = denoised_to_show();
      display = newest.settings.display;
    }
    auto made = std::make_shared<DisplayImage>();
    made->frame = source;
    made->denoised = clean;
    const std::vector<vec3>& linear = made->linear();
    made->display = display;
    made->width = source->width;
    made->height = source->height;
    made->rgba.resize(4 * linear.size());
    made->transform = display_transform(linear, source->width, source->height, display, source->view,
                                        source->display_scale);
    display_rgba8(linear, made->transform, made->rgba);
    {
      std::lock_guard lock(mutex);
      picture = std::move(made);
      if (first_image_generation != 0 && source->generation >= first_image_generation) {
        status.first_image_ms = 1000 * seconds_between(first_image_submitted, Clock::now());
        first_image_generation = 0;
      }
    }
    changed.notify_all();
    if (options.on_publish) options.on_publish();
  }
}

RenderSession::RenderSession(SessionOptions options) : state_(std::make_unique<State>(std::move(options))) {}
RenderSession::~RenderSession() = default;

std::uint64_t RenderSession::submit(Document document, BuildQuality quality) {
  State& s = *state_;
  std::uint64_t generation;
  std::unique_ptr<DenoiseJob> dropped;
  std::shared_ptr<RenderTurns> turns;
  {
    std::lock_guard lock(s.mutex);
    turns = s.options.turns;
    Invalidates consequence =
        s.status.submitted == 0 ? Invalidates::scene : compare_documents(s.newest, document);
    if (s.quality == BuildQuality::fast && quality == BuildQuality::high) consequence = Invalidates::scene;
    s.quality = quality;
    s.newest = document;
    s.pending = std::move(document);
    s.pending_worst = std::max(s.pending_worst, consequence);
    if (consequence >= Invalidates::image) {
      s.submitted_at = Clock::now();
      s.stop = true;
      dropped = s.denoiser.cancel();
    }
    generation = ++s.status.submitted;
  }
  s.changed.notify_all();
  if (turns) turns->wake();
  return generation;
}

void RenderSession::pause(bool paused) {
  State& s = *state_;
  {
    std::lock_guard lock(s.mutex);
    s.paused = paused;
    s.steps_wanted = 0;
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
    s.region_changed = true;
  }
  s.changed.notify_all();
}

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
  return state_->status;
}

std::optional<Pick> RenderSession::pick(vec2 film_position) const {
  const Built newest = built();
  return newest.scene ? candela::pick(*newest.scene, *newest.document, film_position) : std::nullopt;
}

RenderSession::Built RenderSession::built() const {
  std::lock_guard lock(state_->mutex);
  return {state_->scene, state_->scene_document};
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
    if (!s.newest.settings.display.denoise || s.frame->view != View::radiance || s.frame->spp < 2)
      return true;
    return s.picture->denoised && s.picture->denoised->accumulation == s.frame->generation &&
           s.picture->denoised->samples == s.status.rays.samples;
  });
}

} // namespace candela
