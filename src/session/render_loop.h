#pragma once
// The render thread: takes Documents, restarts what they change, adds samples.

#include "render/film/accumulation.h"
#include "render/film/make_pass_renderer.h"
#include "session/mailbox.h"
#include "session/presenter.h"
#include "session/render_session.h"
#include "session/render_turns.h"
#include "session/scene_cache.h"
#include "session/urgent_thread.h"

#include <thread>

namespace candela {

/// Side of the coarsest blocks of a first pass over so many pixels, for an early picture; a power of two.
/// `seconds_per_sample` is for one pixel; 0: not known.
int coarsest_lattice(double pixels, double seconds_per_sample);

class RenderLoop {
public:
  /// Starts the thread, which uses the other parts of the session; they must outlive it.
  RenderLoop(SessionMonitor& monitor, WorkerThreads& workers, Mailbox& mailbox, SceneCache& scenes,
             Presenter& presenter, const SessionOptions& options);

  /// The render thread's part of the status.
  const SessionStatus& status(Locked) const { return status_; }

  struct Turns { ///< with other sessions; null: no other sessions
    std::shared_ptr<RenderTurns> turns;
    int variant = 0; ///< index of this session
  };
  Turns turns(Locked) const { return turns_; }
  void set_turns(Locked, Turns turns);

private:
  void run();
  bool has_work(Locked lock) const;
  bool may_improve(Locked lock) const;
  bool work();
  bool take_document();
  void restart();
  void remix();
  void improve();
  void apply_region();
  bool begin_pass();
  bool may_render() const;
  bool finished() const { return accumulation_.finished(current_.settings.stop); }
  StopCondition stop_condition(const Accumulation::Pass& pass, bool urgent) const;
  void take_turn();
  void render(int most_samples, bool urgent);
  void render_pass(int most_samples, bool urgent);
  void publish(bool force);
  void feed_denoiser(bool settled);
  void fail(std::string error);
  Presenter::Source source() const;

  SessionMonitor& monitor_;
  Mailbox& mailbox_;
  SceneCache& scenes_;
  Presenter& presenter_;
  std::function<void()> on_publish_;

  // Guarded by the session's mutex, written by the render thread.
  SessionStatus status_;
  // Guarded by the session's mutex.
  Turns turns_;

  // Used by the render thread.
  Document current_;
  SceneCache::Built built_;      ///< SceneCache::newest()
  std::uint64_t generation_ = 0; ///< of the last Document that restarted
  Accumulation accumulation_;
  std::unique_ptr<PassRenderer> renderer_;
  bool active_ = false;      ///< there is an accumulation to add samples to
  bool urgent_ = true;       ///< the user waits for the first pass
  double usual_seconds_ = 0; ///< per sample in the newest first picture, of any accumulation

  // Last: they use the other members.
  UrgentThread urgent_thread_;
  std::jthread thread_;
};

} // namespace candela
