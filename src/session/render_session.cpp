#include "session/render_session.h"

#include "core/error.h"
#include "render/render_pass.h"

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

// Two threads: `renderer` turns Documents into Frames, `presenter` turns Frames into DisplayImages. The mutex
// guards pointers and small values and is never held while either of them works.
struct RenderSession::State {
  explicit State(SessionOptions o) : options(std::move(o)) {
    renderer = std::jthread([this] { render_loop(); });
    presenter = std::jthread([this] { present_loop(); });
  }
  ~State() {
    {
      std::lock_guard lock(mutex);
      quit = true;
      stop = true;
    }
    changed.notify_all();
  }

  SessionOptions options;
  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  bool quit = false;
  std::atomic<bool> stop{false}; ///< the pass in flight is out of date

  // The mailbox.
  std::optional<Document> pending;
  Invalidates pending_worst = Invalidates::nothing; ///< over all that pending replaced
  Document newest;                                  ///< last submitted
  Clock::time_point submitted_at;                   ///< of the last one that restarts

  // What is shown.
  SessionStatus status;
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const DisplayImage> picture;
  std::uint64_t first_image_generation =
      0; ///< of the accumulation whose first image is still awaited; 0: none
  Clock::time_point first_image_submitted;  ///< when that was submitted
  std::shared_ptr<const RenderScene> scene; ///< newest built, with its document, for picking
  std::shared_ptr<const Document> scene_document;

  // The render thread's own.
  Document current;
  std::uint64_t accumulation = 0; ///< generation of the Document that restarted last
  Film film;
  RayCounts rays;
  NonFiniteLog nonfinite;
  double render_seconds = 0;
  std::size_t level = 0; ///< next of kCoarseLevels
  int spp = 0;
  int published_spp = -1; ///< of the last snapshot
  double seconds_per_spp = 0;
  double publish_cost = 0;
  Clock::time_point published_at;

  std::jthread renderer, presenter; // last: they are joined before the rest goes

  void render_loop();
  bool take_pending();
  void restart();
  bool finished() const;
  void step();
  void publish(bool force);
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
      changed.wait(lock, [&] { return quit || pending || active; });
      if (quit) return;
    }
    try {
      if (take_pending()) active = true;
      if (status.phase == SessionPhase::failed) {
        active = false;
        continue;
      }
      if (!finished()) step();
      if (finished()) {
        if (published_spp != spp) publish(true);
        std::lock_guard lock(mutex);
        if (!pending) {
          status.phase = SessionPhase::finished;
          active = false;
        }
      }
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
    if (!active && options.on_publish) options.on_publish(); // the phase is news, too
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

void RenderSession::State::restart() {
  // Materials and lights are made anew, which is quick; the geometry stays where the instances stay.
  auto built = RenderScene::build(current, scene.get());
  {
    std::lock_guard lock(mutex);
    scene = std::move(built);
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
  published_spp = -1;
  seconds_per_spp = 0;
}

bool RenderSession::State::finished() const {
  const StopSettings& until = current.settings.stop;
  if (spp == 0) return false;
  return (until.spp > 0 && spp >= until.spp) ||
         (until.time > 0 && render_seconds >= static_cast<double>(until.time));
}

void RenderSession::State::step() {
  static const std::atomic<bool> kNeverStop{false};
  PassOptions pass_options;
  pass_options.threads = options.threads;
  SampleRange range;
  bool coarse = level < std::size(kCoarseLevels);
  if (coarse) {
    range.lattice = kCoarseLevels[level];
    range.skip_lattice = level > 0 ? kCoarseLevels[level - 1] : 0;
  } else {
    // Enough samples a pass to be worth its synchronisation, few enough to publish often.
    int portion = seconds_per_spp > 0 ? std::clamp(static_cast<int>(0.02 / seconds_per_spp), 1, 64) : 1;
    if (current.settings.stop.spp > 0) portion = std::min(portion, current.settings.stop.spp - spp);
    range.begin = static_cast<std::uint32_t>(spp);
    range.end = static_cast<std::uint32_t>(spp + portion);
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
    auto done = static_cast<int>(range.end - range.begin);
    spp += done;
    seconds_per_spp = taken / done;
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
    film.resolve(snapshot->coarseness, snapshot->linear);
    snapshot->view = current.settings.view;
    snapshot->display_scale = display_scale(*scene, current.settings);
    snapshot->rays = rays;
    snapshot->render_seconds = render_seconds;
    snapshot->nonfinite = nonfinite;
    published_spp = spp;
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

void RenderSession::State::present_loop() {
  while (true) {
    std::shared_ptr<const Frame> source;
    DisplaySettings display;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] {
        return quit || (frame &&
                        (!picture || picture->frame != frame || picture->display != newest.settings.display));
      });
      if (quit) return;
      source = frame;
      display = newest.settings.display;
    }
    auto made = std::make_shared<DisplayImage>();
    made->frame = source;
    made->display = display;
    made->width = source->width;
    made->height = source->height;
    made->rgba.resize(4 * source->linear.size());
    made->transform = display_transform(source->linear, source->width, source->height, display, source->view,
                                        source->display_scale);
    display_rgba8(source->linear, made->transform, made->rgba);
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

std::uint64_t RenderSession::submit(Document document) {
  State& s = *state_;
  std::uint64_t generation;
  {
    std::lock_guard lock(s.mutex);
    Invalidates consequence =
        s.status.submitted == 0 ? Invalidates::scene : compare_documents(s.newest, document);
    s.newest = document;
    s.pending = std::move(document);
    s.pending_worst = std::max(s.pending_worst, consequence);
    if (consequence >= Invalidates::image) {
      s.submitted_at = Clock::now();
      s.stop = true;
    }
    generation = ++s.status.submitted;
  }
  s.changed.notify_all();
  return generation;
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
  std::shared_ptr<const RenderScene> scene;
  std::shared_ptr<const Document> document;
  {
    std::lock_guard lock(state_->mutex);
    scene = state_->scene;
    document = state_->scene_document;
  }
  return scene ? candela::pick(*scene, *document, film_position) : std::nullopt;
}

bool RenderSession::wait_finished(double seconds) const {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  return s.changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
    if (s.status.generation != s.status.submitted || s.pending) return false;
    if (s.status.phase == SessionPhase::failed) return true;
    return s.status.phase == SessionPhase::finished && s.picture && s.picture->frame == s.frame &&
           s.picture->display == s.newest.settings.display;
  });
}

} // namespace candela
