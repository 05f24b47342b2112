#pragma once
// The lab over the picture: the lessons of `candela lab`, live.

#include "app/lab/lab_pages.h"

#include <functional>
#include <vector>

namespace candela {

class LabPanel {
public:
  /// `wake` is called from the lab's thread when a slice of a lesson is done.
  explicit LabPanel(std::function<void()> wake);
  ~LabPanel();

  /// Draws the panel into what is free of the window, if `visible`, which its close button clears, and lets
  /// the lesson on show go on. No lesson runs while this is not called or not `visible`.
  void draw(Ui& ui, bool& visible, vec2 position, vec2 room);
  /// Of `room`, that the panel takes from the left while it is shown.
  static float width(float scale, float room);
  /// Whether draw() would show something new.
  bool has_news() const { return worker_.has_completions(); }
  /// Whether the lesson on show has not come to its end, and whether a slice of one is under way.
  bool busy() const { return pages_[page_]->busy(); }
  bool running() const { return worker_.pending() > 0; }

private:
  Document sampler_;                            ///< whose sampler rows are the lab's
  std::vector<std::unique_ptr<LabPage>> pages_; ///< in the order of lessons()
  std::size_t page_ = 0;
  TaskThread worker_; // last, so that it ends first: its tasks' completions point into the pages
};

} // namespace candela
