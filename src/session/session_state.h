#pragma once
// The implementation of RenderSession: its parts, which document the ownership of their threads. Only
// session/ includes this.
//
// Threads: `renderer` has one that renders Documents and one of normal priority for the first samples after
// an edit; `scenes` has one for high-quality geometry; `presenter` has one that denoises and one that
// tone-maps.

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
  RenderLoop renderer; // last: it uses the other members, and its thread must end first
};

} // namespace candela
