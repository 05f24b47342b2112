#pragma once
// Requests to a session: the newest Document, pauses, steps, a region. Any thread writes them, the render
// thread takes them.

#include "render/film/sample_range.h"
#include "scene/document.h"
#include "session/session_monitor.h"

#include <atomic>
#include <chrono>
#include <optional>

namespace candela {

/// Guarded by the session's mutex, except the flags, which a pass polls without it. Callers that change
/// something notify SessionMonitor::changed afterwards.
class Mailbox {
public:
  using Clock = std::chrono::steady_clock;

  struct Receipt {
    std::uint64_t generation = 0;
    bool restarts = false; ///< whether it restarts the accumulation; then the current pass is told to end
    bool remixes = false;  ///< whether it mixes the light layers otherwise; then the current pass is held
  };
  /// Replaces a Document that was not taken yet.
  Receipt submit(Locked, Document document);
  /// The last one submitted; an empty one before the first.
  const Document& newest(Locked) const { return newest_; }
  std::uint64_t submitted(Locked) const { return submitted_; }   ///< newest generation
  std::uint64_t restarting(Locked) const { return restarting_; } ///< newest that restarts the accumulation

  void pause(Locked, bool paused);
  void step(Locked); ///< one more sample a pixel, then a pause
  void set_region(Locked, const CropWindow& region);
  void close(Locked); ///< the session ends: tells the current pass to end

  struct Delivery {
    Document document;
    Invalidates consequence =
        Invalidates::nothing; ///< the strongest of all Documents since the last delivery
    std::uint64_t generation = 0;
    Clock::time_point submitted_at; ///< of the last one that restarts
  };
  bool has_document(Locked) const { return pending_.has_value(); }
  /// Whether a waiting Document restarts the accumulation.
  bool has_restart(Locked) const { return pending_ && consequence_ >= Invalidates::image; }
  std::optional<Delivery> take(Locked);

  bool has_region(Locked) const { return region_changed_; }
  std::optional<CropWindow> take_region(Locked);

  /// While paused, only steps and the first pass of an edit are rendered.
  bool may_render(Locked, bool first_pass_done) const {
    return !paused_ || steps_wanted_ > 0 || !first_pass_done;
  }
  bool paused(Locked) const { return paused_; }
  bool has_step(Locked) const { return paused_ && steps_wanted_ > 0; }
  bool take_step(Locked); ///< false: none was requested
  /// Clears hold() before a pass: requests from then on set it again, and wait for the pass.
  void begin_pass(Locked) { hold_ = false; }
  bool closed(Locked) const { return closing_; }

  // Polled by the current pass.
  /// The pass renders an old Document: it is to end.
  const std::atomic<bool>& outdated() const { return outdated_; }
  /// The pass is to be interrupted; it is continued later.
  const std::atomic<bool>& hold() const { return hold_; }
  const std::atomic<bool>& closing() const { return closing_; }

private:
  std::optional<Document> pending_;
  Invalidates consequence_ = Invalidates::nothing; ///< over all that pending_ replaced
  Document newest_;
  std::uint64_t submitted_ = 0, restarting_ = 0;
  Clock::time_point submitted_at_;
  bool paused_ = false;
  int steps_wanted_ = 0;
  CropWindow region_;
  bool region_changed_ = false;
  std::atomic<bool> outdated_{false}, hold_{false}, closing_{false};
};

} // namespace candela
