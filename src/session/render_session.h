#pragma once
// The interactive engine, which owns the render thread. The UI submits Documents and reads the newest
// results; none of its calls waits for rendering.

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
  std::uint64_t submitted = 0;  ///< newest submitted generation
  std::uint64_t restarting = 0; ///< newest that restarts the accumulation
  std::uint64_t generation = 0; ///< the current accumulation's
  std::uint64_t restarts = 0;   ///< accumulations begun since the session began
  int spp = 0;                  ///< complete passes of this accumulation
  RayCounts rays;               ///< of this accumulation
  double render_seconds = 0;    ///< of this accumulation
  /// Input latency: from the last restarting submit() to its first published image; < 0: not published yet.
  double first_image_ms = 0;
  double built = 0; ///< progress of building, 0..1; while phase is building
  std::uint64_t builds_cancelled =
      0;                       ///< number of builds cancelled because a newer Document had other geometry
  double progress = 0;         ///< 0..1 towards the nearest stopping criterion; 0 without one
  std::uint64_t nonfinite = 0; ///< NaN or infinite samples of this accumulation
  std::string error;           ///< the cause, if phase is failed
  std::string denoise_error;   ///< the cause, if denoising this accumulation failed
};

struct SessionOptions {
  int threads = 0;                       ///< 0: every core
  std::function<void()> on_publish = {}; ///< called from a session thread when there is something new to show
  /// Called from the render thread before it builds geometry with this progress.
  std::function<void(const Progress&)> on_build = {};
  double min_publish_interval =
      1 / 30.0; ///< see publish_every(); seconds between pictures once the first full one is shown
  std::shared_ptr<RenderTurns> turns = {}; ///< shared with other sessions; null: no other sessions
  int variant = 0;                         ///< index of this session
  std::shared_ptr<const RenderScene> geometry_of = {}; ///< reused where the instances are the same
};

class RenderSession {
public:
  explicit RenderSession(const SessionOptions& options = {});
  ~RenderSession(); ///< cancels and joins
  RenderSession(const RenderSession&) = delete;
  RenderSession& operator=(const RenderSession&) = delete;

  /// Submits a new Document, which replaces an earlier one that was not taken yet, and returns its
  /// generation. compare_documents() decides what it restarts: a display-only change tone-maps the newest
  /// frame again and keeps accumulating. Other factors of light groups that the film keeps apart are applied
  /// to its samples (light_layers.h), at once but for the first pass, which ends before. A Document with
  /// other meshes or panoramas cancels building the previous one. If meshes are only moved, copied or
  /// deleted, geometry is built fast, within milliseconds, and with high quality in the background; then the
  /// accumulation restarts without a coarse picture. Only that accumulation counts as finished.
  std::uint64_t submit(Document document);
  /// Objects may be moved soon: prepares for it.
  void expect_moves();

  /// While paused, nothing accumulates, but edits still show their first pass. The current pass is continued
  /// afterwards.
  void pause(bool paused);
  /// One sample for every pixel that accumulates, then a pause.
  void step();
  /// Only these pixels of the film accumulate, without a restart; the others keep their samples and catch up
  /// when an empty window selects the whole film again. The first pass after a restart covers the whole film.
  void set_region(const CropWindow& region);

  /// Least seconds between pictures of an accumulation after its first full one: each takes time from the
  /// renderer.
  void publish_every(double seconds);

  /// Takes turns with other sessions from now on; null: no longer.
  void take_turns(std::shared_ptr<RenderTurns> turns, int variant);

  /// The newest built scene; null before the first.
  std::shared_ptr<const RenderScene> scene() const;

  std::shared_ptr<const Frame> latest() const;         ///< null before the first image
  std::shared_ptr<const DisplayImage> display() const; ///< null before the first image
  SessionStatus status() const;

  /// CPU time since the session began, seconds.
  struct CpuTime {
    double render = 0;  ///< render threads with their workers: building, passes, snapshots
    double present = 0; ///< the thread that tone-maps the snapshots
  };
  CpuTime cpu_time() const;
  int threads() const; ///< number of render threads

  /// The surface at a film position (pixels, top-left origin) of the newest built scene; nothing while it is
  /// built.
  std::optional<Pick> pick(vec2 film_position) const;

  /// The newest built scene with its Document, for work outside the render thread; null until the first is
  /// built.
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
