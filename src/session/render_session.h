#pragma once
// The interactive engine: the only owner of the render thread. The UI submits Documents and reads what is
// newest; no call of it waits for rendering.

#include "core/progress.h"
#include "render/camera/picking.h"
#include "render/film/render_pass.h"
#include "session/display_image.h"
#include "session/render_turns.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace candela {

enum class SessionPhase { idle, building, rendering, paused, finished, failed };

struct SessionStatus {
  SessionPhase phase = SessionPhase::idle;
  std::uint64_t submitted = 0;  ///< newest generation handed in
  std::uint64_t restarting = 0; ///< newest that restarts what is accumulated
  std::uint64_t generation = 0; ///< the one that is accumulating
  std::uint64_t restarts = 0;   ///< accumulations begun since the session began
  int spp = 0;                  ///< complete passes of this accumulation
  RayCounts rays;               ///< of this accumulation
  double render_seconds = 0;    ///< of this accumulation
  /// Input latency: from the last restarting submit() to its first published image; < 0: not there yet.
  double first_image_ms = 0;
  double built = 0;                   ///< 0..1: how far building is; while phase is building
  std::uint64_t builds_cancelled = 0; ///< since the session began: a newer Document had other geometry
  double progress = 0;                ///< 0..1 towards the nearest stopping criterion; 0 where there is none
  std::uint64_t nonfinite = 0;        ///< NaN or infinite samples of this accumulation
  std::string error;                  ///< why phase is failed
  std::string denoise_error;          ///< why the last attempt to denoise this accumulation made no picture
};

struct SessionOptions {
  int threads = 0;                       ///< 0: every core
  std::function<void()> on_publish = {}; ///< called from a session thread when there is something new to show
  /// Called from the render thread, which waits for it, before it builds geometry with this progress.
  std::function<void(const Progress&)> on_build = {};
  double min_publish_interval =
      1 / 30.0; ///< see publish_every(); seconds between pictures once the first full one is shown
  std::shared_ptr<RenderTurns> turns = {}; ///< taken with other sessions; null: alone on the machine
  int variant = 0;                         ///< which one of them this is
  std::shared_ptr<const RenderScene> geometry_of = {}; ///< reused where the instances are the same
};

class RenderSession {
public:
  explicit RenderSession(SessionOptions options = {});
  ~RenderSession(); ///< cancels and joins
  RenderSession(const RenderSession&) = delete;
  RenderSession& operator=(const RenderSession&) = delete;

  /// Hands in a new Document (latest wins) and returns its generation. What it restarts is decided by
  /// compare_documents(): a display-only change re-tones the newest frame and keeps accumulating. A Document
  /// with other meshes or panoramas cancels the building of the one before. Where meshes are only moved,
  /// copied or deleted, geometry is built fast, which takes milliseconds, and well beside the rendering; when
  /// that is done the accumulation begins anew, without a coarse picture, and only what comes of it is ever
  /// called finished.
  std::uint64_t submit(Document document);
  /// Objects may be moved soon: makes ready for it.
  void expect_moves();

  /// While paused nothing accumulates; edits still show their first pass. The pass in flight is continued
  /// afterwards.
  void pause(bool paused);
  /// One sample for every pixel that accumulates, then a pause.
  void step();
  /// Only these pixels of the film accumulate, without a restart; the rest keeps what it has and catches up
  /// when an empty window gives the whole film back. After a restart the first pass is everywhere.
  void set_region(const CropWindow& region);

  /// Pictures of an accumulation, once its first full one is shown, need come no more often: each costs the
  /// renderer. Seconds.
  void publish_every(double seconds);

  /// Takes turns from now on; null: no longer.
  void take_turns(std::shared_ptr<RenderTurns> turns, int variant);

  /// Newest that was built; null before.
  std::shared_ptr<const RenderScene> scene() const;

  std::shared_ptr<const Frame> latest() const;         ///< null before the first image
  std::shared_ptr<const DisplayImage> display() const; ///< null before the first image
  SessionStatus status() const;

  /// CPU time since the session began, seconds.
  struct CpuTime {
    double render = 0;  ///< threads that compute, with their workers: building, passes, snapshots of the film
    double present = 0; ///< the thread that makes pictures of the snapshots
  };
  CpuTime cpu_time() const;
  int threads() const; ///< that render

  /// What lies under a film position (pixels, top-left origin) of the newest built scene; nothing while it
  /// builds.
  std::optional<Pick> pick(vec2 film_position) const;

  /// The newest built scene with its Document, for work beside the render; null while the first builds.
  struct Built {
    std::shared_ptr<const RenderScene> scene;
    std::shared_ptr<const Document> document;
  };
  Built built() const;

  /// For tests and screenshots: waits until the newest Document is finished (or failed, or paused with every
  /// step taken) and its picture is shown; false after `seconds`. Never called by the UI thread.
  bool wait_finished(double seconds) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace candela
