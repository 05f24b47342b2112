#pragma once
// A lesson that runs in slices on another thread while its page is shown.

#include "app/platform/task_thread.h"

#include <chrono>
#include <memory>
#include <utility>

namespace candela {

/// The page shows an immutable copy, from which the next slice continues. So closing the panel loses nothing,
/// and the result does not depend on the slices. Used on the UI thread; it must outlive the completions of
/// its TaskThread.
template <class Lesson>
class LabJob {
public:
  LabJob() = default;
  LabJob(const LabJob&) = delete;
  LabJob& operator=(const LabJob&) = delete;

  /// Begins a new lesson, which `make` constructs on the task thread. Until then the old one is shown.
  void start(std::function<Lesson()> make) {
    make_ = std::move(make);
    ++generation_;
  }
  bool started() const { return generation_ > 0; }
  bool busy() const { return make_ || in_flight_ || (lesson_ && !lesson_->finished()); }
  /// Null before the first slice.
  const Lesson* shown() const { return lesson_.get(); }

  /// Posts the next slice, if there is one and none is running.
  void step(TaskThread& worker) {
    if (in_flight_ || !busy()) return;
    in_flight_ = true;
    worker.post([this, make = std::exchange(make_, nullptr), before = lesson_,
                 generation = generation_]() -> TaskThread::Completion {
      auto lesson = std::make_shared<Lesson>(make ? make() : *before);
      run_slice(*lesson);
      return [this, generation, lesson = std::shared_ptr<const Lesson>(std::move(lesson))] {
        in_flight_ = false;
        if (generation == generation_) lesson_ = lesson;
      };
    });
  }

private:
  static void run_slice(Lesson& lesson) {
    constexpr std::chrono::milliseconds kSlice(30);
    const auto end = std::chrono::steady_clock::now() + kSlice;
    while (!lesson.finished() && std::chrono::steady_clock::now() < end) {
      if constexpr (requires { lesson.advance(1); })
        lesson.advance(2048);
      else
        lesson.advance();
    }
  }

  std::shared_ptr<const Lesson> lesson_;
  std::function<Lesson()> make_;
  std::uint64_t generation_ = 0;
  bool in_flight_ = false;
};

} // namespace candela
