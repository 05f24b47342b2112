#pragma once
// What the user wants of a session: the newest Document, pauses, steps, a region. Any thread writes it, the
// render thread takes from it.

#include "render/film/sample_range.h"
#include "scene/document.h"
#include "session/session_monitor.h"

#include <atomic>
#include <chrono>
#include <optional>

namespace candela {

/// Guarded by the session's mutex, but for the flags, which a pass polls without it. Whoever changes
/// something notifies SessionMonitor::changed afterwards.
class Mailbox {
public:
  using Clock = std::chrono::steady_clock;

  struct Receipt {
    std::uint64_t generation = 0;
    bool restarts = false; ///< the accumulation; the pass in flight is told to end
  };
  /// Replaces a Document that was not taken yet: the latest wins.
  Receipt submit(Locked, Document document);
  /// The last one submitted; an empty one before the first.
  const Document& newest(Locked) const { return newest_; }
  std::uint64_t submitted(Locked) const { return submitted_; }   ///< newest generation
  std::uint64_t restarting(Locked) const { return restarting_; } ///< newest that restarts the accumulation

  void pause(Locked, bool paused);
  void step(Locked); ///< one more sample a pixel, and a pause
  void set_region(Locked, const CropWindow& region);
  void close(Locked); ///< the session ends: tells a pass in flight

  struct Delivery {
    Document document;
    Invalidates consequence = Invalidates::nothing; ///< the heaviest of all Documents since the last delivery
    std::uint64_t generation = 0;
    Clock::time_point submitted_at; ///< of the last one that restarts
  };
  bool has_document(Locked) const { return pending_.has_value(); }
  /// A Document waits that makes the accumulation out of date.
  bool has_restart(Locked) const { return pending_ && consequence_ >= Invalidates::image; }
  std::optional<Delivery> take(Locked);

  bool has_region(Locked) const { return region_changed_; }
  std::optional<CropWindow> take_region(Locked);

  /// While paused, only steps are taken, and the first pass of an edit.
  bool may_render(Locked, bool first_pass_done) const {
    return !paused_ || steps_wanted_ > 0 || !first_pass_done;
  }
  bool paused(Locked) const { return paused_; }
  bool has_step(Locked) const { return paused_ && steps_wanted_ > 0; }
  bool take_step(Locked); ///< false: none is wanted
  /// From now on, whoever wants the pass to wait sets hold() again, and waits for what has begun.
  void begin_pass(Locked) { hold_ = false; }
  bool closed(Locked) const { return closing_; }

  // What the pass in flight polls.
  /// It shows an old Document.
  const std::atomic<bool>& outdated() const { return outdated_; }
  /// It is to wait; it is continued later.
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
