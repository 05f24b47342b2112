#pragma once
// The inside of RenderSession: what its threads share and what belongs to each. Only session/ includes this.

#include "core/progress.h"
#include "core/recycler.h"
#include "render/film/render_pass.h"
#include "render/film/sample_schedule.h"
#include "session/denoise_thread.h"
#include "session/geometry_thread.h"
#include "session/render_session.h"
#include "session/urgent_thread.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <pthread.h>
#include <set>
#include <thread>

namespace candela {

using Clock = std::chrono::steady_clock;

inline double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

inline constexpr int kRenderNiceness = 10, kBuildNiceness = 15;

/// Side of the blocks of the first pass; each is a multiple of the next, so the lattices nest.
inline constexpr int kCoarseLevels[] = {128, 64, 32, 16, 8, 4, 2, 1};
inline constexpr std::size_t kUsualLevel = 4; ///< to begin with while no sample has been timed
/// The first picture after an edit is finished although a newer edit waits, so that there are pictures while
/// one drags; but only so long.
inline constexpr std::chrono::milliseconds kFirstPicturePatience{100};

/// The level that the first pass of a film begins with, so that a picture of it is there soon.
std::size_t first_level(double pixels, double seconds_per_sample);

/// What instances are made of, shapes apart.
std::set<const Mesh*> meshes_of(const std::vector<Instance>& instances);
/// Whether building `before` would be in vain for who wants `now`: it has other meshes or panoramas.
bool is_built_anew(const SceneDesc& before, const SceneDesc& now);

// Five threads: `renderer` turns Documents into Frames, the first of each by way of `urgent`,
// `geometry_thread` builds well what that had to build fast, `denoiser` turns snapshots of the film into
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
      if (building) building->cancel();
    }
    changed.notify_all();
    if (options.turns) options.turns->wake();
  }

  SessionOptions options;
  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  bool quit = false;
  std::atomic<bool> stop{false}; ///< the pass in flight is out of date
  std::atomic<double> publish_interval{options.min_publish_interval};
  std::atomic<bool> quitting{false}; ///< `quit`, for who does not hold the mutex
  std::atomic<bool> hold{false};     ///< the pass in flight is to wait: it goes on later where it is left

  // The mailbox.
  std::optional<Document> pending;
  Invalidates pending_worst = Invalidates::nothing; ///< over all that pending replaced
  Document newest;                                  ///< last submitted
  Clock::time_point submitted_at;                   ///< of the last one that restarts
  bool paused = false;
  int steps_wanted = 0;
  CropWindow region;
  bool region_changed = false;

  // Written by the render thread.
  std::shared_ptr<Progress> building; ///< of the RenderScene in the making, if one is

  // Geometry that outlives edits.
  Geometry::Objects objects; ///< of the meshes of the newest built scene, as far as they ever were needed
  struct Improvement {
    std::vector<Instance> instances;
    std::shared_ptr<const Geometry> geometry; ///< null: there is no memory for it
  };
  std::optional<Improvement> improvement; ///< made by the geometry thread, not in use yet
  std::optional<Improvement>
      unused; ///< built for a scene of which the rest was given up; the render thread's

  // Whose CPU time is told.
  std::vector<clockid_t> team_clocks; ///< of the threads that render and the OpenMP teams that they keep
  std::optional<clockid_t> presenter_clock;

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
  std::size_t begun_level = 0; ///< which of kCoarseLevels this accumulation began with
  std::size_t level = 0;       ///< next of kCoarseLevels
  Recycler<Frame> frames;
  SampleSchedule schedule;
  int spp = 0;                       ///< complete passes over the film, or over the region
  bool urgent_first = true;          ///< a hand waits for the first pass
  std::uint64_t samples_to_show = 0; ///< pictures of fewer would be worse than the one that is shown
  bool stays_fast = false;           ///< memory does not suffice for more
  bool converged = false;            ///< adaptive sampling has stopped everywhere
  bool pass_held = false;            ///< the last pass ended early and is to go on
  double noise = std::numeric_limits<double>::infinity(); ///< when stop.noise was asked last
  std::uint64_t published_samples = 0; ///< camera paths in the last snapshot: spp may come to the same twice
  View published_view = View::radiance;
  double first_pass_seconds = 0; ///< those of render_seconds that gave every pixel its first sample
  double usual_seconds = 0;      ///< that a sample took in the newest first picture, of any accumulation
  double seconds_per_sample = 0; ///< of one pixel
  double publish_cost = 0;
  Clock::time_point published_at;
  std::uint64_t denoised_samples = 0; ///< in the newest snapshot for the denoiser; 0: there is none

  DenoiseThread denoiser{
      options.threads, [this](std::shared_ptr<const DenoisedImage> made) { show_denoised(std::move(made)); },
      [this](std::string why) { show_denoise_error(std::move(why)); }};
  UrgentThread urgent{[this] { meet_team(0); }};
  GeometryThread geometry_thread{[this] { meet_team(kBuildNiceness); },
                                 [this](const GeometryJob& job, std::shared_ptr<const Geometry> made) {
                                   take_in(job, std::move(made));
                                 }};
  std::jthread renderer, presenter; // last: they are joined before the rest goes

  void meet_team(int niceness);
  void render_loop();
  bool take_pending();
  void restart();
  void begin_accumulation(std::size_t first_level);
  std::shared_ptr<const Geometry> geometry_for(const std::vector<Instance>& instances,
                                               const RenderScene* previous);
  void keep_objects(const Geometry& geometry, const std::vector<Instance>& instances);
  void take_in(const GeometryJob& job, std::shared_ptr<const Geometry> made);
  /// Whether there is, for now, nothing better to do with an improvement than to use it. The mutex must be
  /// held.
  bool may_improve() const { return improvement && !paused && spp > 0; }
  void improve();
  /// Better geometry is still to come.
  bool improving() const { return scene && scene->geometry().quality() == BuildQuality::fast && !stays_fast; }
  void apply_region();
  bool finished() const;
  /// Paused, only steps are taken, and the first pass of an edit. The mutex must be held.
  bool may_go_on() const { return !paused || steps_wanted > 0 || spp == 0; }
  bool goes_on() const;
  bool take_step();
  bool begin_pass();
  StopCondition stop_condition(bool waited_for, bool may_wait) const;
  void step();
  void render_portion(int most_samples);
  void render_pass_of(int most_samples);
  void publish(bool force);
  void feed_denoiser(bool settled);
  void show_denoised(std::shared_ptr<const DenoisedImage> made);
  void show_denoise_error(std::string why);
  /// The denoised image that belongs to the newest frame, if it is to be shown. The mutex must be held.
  std::shared_ptr<const DenoisedImage> denoised_to_show() const;
  void present_loop();
};

/// The CPU-time clock of the calling thread, for any thread to read.
inline clockid_t thread_cpu_clock() {
  clockid_t clock{};
  pthread_getcpuclockid(pthread_self(), &clock);
  return clock;
}

} // namespace candela
