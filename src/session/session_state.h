#pragma once
// The inside of RenderSession: its parts, each of which says what its threads own. Only session/ includes
// this.
//
// Threads: `renderer`'s turns Documents into samples, and the first ones of an edit on a thread of their own
// that has not given up its priority; `scenes` has one that builds geometry well; `presenter` has one that
// denoises and one that tone-maps.

#include "session/mailbox.h"
#include "session/presenter.h"
#include "session/render_loop.h"
#include "session/render_session.h"
#include "session/scene_cache.h"
#include "session/session_monitor.h"
#include "session/worker_threads.h"

namespace candela {

struct RenderSession::State {
  explicit State(const SessionOptions& options)
      : workers(options.threads), scenes(monitor, workers, options.on_build, options.geometry_of),
        presenter(monitor, options.threads, options.min_publish_interval, options.on_publish),
        renderer(monitor, workers, mailbox, scenes, presenter, options) {}
  ~State() {
    RenderLoop::Turns turns;
    {
      const auto lock = monitor.lock();
      mailbox.close(lock);
      presenter.close(lock);
      scenes.cancel(lock);
      turns = renderer.turns(lock);
    }
    monitor.changed.notify_all();
    if (turns.turns) turns.turns->wake();
  }

  SessionMonitor monitor;
  WorkerThreads workers;
  Mailbox mailbox;
  SceneCache scenes;
  Presenter presenter;
  RenderLoop renderer; // last: it uses the rest, and its thread ends first
};

} // namespace candela
