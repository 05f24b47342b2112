#pragma once
// From the accumulation to the screen: snapshots, their denoised images, and tone-mapped pictures of both.

#include "core/recycler.h"
#include "render/film/accumulation.h"
#include "session/display_image.h"
#include "session/scene_cache.h"

#include <functional>
#include <thread>

namespace candela {

/// Shared by three threads: the render thread makes snapshots (its members are marked), one thread denoises
/// them, one tone-maps the newest image. Their results are guarded by the session's mutex.
class Presenter {
public:
  using Clock = std::chrono::steady_clock;
  using OnPublish = std::function<void()>;

  /// `interval`: see publish_every(). `on_publish` is called from one of the threads when there is something
  /// new to show; may be empty.
  Presenter(SessionMonitor& monitor, int threads, double interval, OnPublish on_publish);

  void set_display(Locked, const DisplaySettings& display) { display_ = display; }
  /// The newest snapshots are out of date. Returns the denoiser's waiting job, to be freed without the lock.
  std::unique_ptr<DenoiseJob> outdate(Locked);
  /// Least seconds between pictures, except the first ones: each takes time from the renderer.
  void publish_every(double seconds) { interval_ = seconds; }
  void close(Locked) { closed_ = true; }

  std::shared_ptr<const Frame> frame(Locked) const { return frame_; }            ///< null before the first
  std::shared_ptr<const DisplayImage> picture(Locked) const { return picture_; } ///< null before the first
  double first_image_ms(Locked) const { return first_image_ms_; }
  const std::string& denoise_error(Locked) const { return denoise_error_; }
  double cpu_seconds(Locked) const; ///< of the thread that makes pictures
  /// Whether the newest snapshot is shown with the current display settings, denoised from this many samples
  /// if requested.
  bool shows_newest(Locked, std::uint64_t samples) const;

  // --- Called by the render thread ---

  /// The state that a snapshot shows.
  struct Source {
    std::uint64_t generation = 0; ///< of the Document that started the accumulation
    const Accumulation& accumulation;
    const SceneCache::Built& built;
    const Document& document; ///< newest
  };
  /// Reports that a Document submitted at that time restarts the accumulation.
  void await_first_image(Locked, std::uint64_t generation, Clock::time_point submitted);
  /// Another accumulation begins. Until it has `keep_until` samples, the current picture stays.
  void begin_accumulation(std::uint64_t keep_until);
  void show_anyway() { keep_until_ = 0; }
  /// A snapshot, or null if none is due: unless forced, they are taken seldom enough that copying costs
  /// little.
  std::shared_ptr<const Frame> snapshot(const Source& source, bool force);
  void show(Locked, std::shared_ptr<const Frame> snapshot) {
    if (snapshot) frame_ = std::move(snapshot);
  }
  /// Whether the newest snapshot has all samples, of this view.
  bool is_current(std::uint64_t samples) const { return published_samples_ == samples; }
  bool is_of_view(View view) const { return published_view_ == view; }
  bool is_of_mix(const LightMix& mix) const { return published_mix_ == mix; }
  /// The light layers are mixed otherwise from now on: what was denoised is out of date.
  void remix() { denoised_samples_ = 0; }
  /// A job for the denoiser, or null if none is due. Jobs are due whenever the samples have doubled, so that
  /// their cost for the render thread falls, and when no more samples come.
  std::unique_ptr<DenoiseJob> denoise_job(const Source& source, bool settled);
  /// Returns the replaced job.
  std::unique_ptr<DenoiseJob> denoise(Locked, std::unique_ptr<DenoiseJob> job);

private:
  bool denoises(const Frame& frame) const { return display_.denoise && frame.view == View::radiance; }
  std::shared_ptr<const DenoisedImage> denoised_to_show() const;
  void receive(std::shared_ptr<const DenoisedImage> made);
  void receive_error(std::string why);
  void run();

  SessionMonitor& monitor_;
  OnPublish on_publish_;
  std::atomic<double> interval_;

  // Guarded.
  DisplaySettings display_;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const DisplayImage> picture_;
  std::shared_ptr<const DenoisedImage> denoised_; ///< newest, of any accumulation
  std::string denoise_error_;
  std::uint64_t awaited_ = 0;           ///< generation whose first image is awaited; 0: none
  Clock::time_point awaited_submitted_; ///< when it was submitted
  double first_image_ms_ = 0;
  std::optional<clockid_t> clock_;
  bool closed_ = false;

  // Used by the render thread.
  Recycler<Frame> frames_;
  std::uint64_t published_samples_ =
      0; ///< camera paths in the newest snapshot: spp may be equal for two snapshots
  View published_view_ = View::radiance;
  LightMix published_mix_;
  Film mixed_; ///< memory for mixes
  Clock::time_point published_at_;
  double publish_cost_ = 0;            ///< of the newest snapshot, seconds
  std::uint64_t keep_until_ = 0;       ///< with fewer samples, the current picture is better
  std::uint64_t denoised_samples_ = 0; ///< in the denoiser's newest job; 0: none

  // Last: they use the other members.
  DenoiseThread denoiser_;
  std::jthread thread_;
};

} // namespace candela
