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

  /// If `visible`, draws the panel into the free part of the window and advances the current lesson. Its
  /// close button clears `visible`. No lesson runs while the panel is hidden.
  void draw(Ui& ui, bool& visible, vec2 position, vec2 room);
  /// The width that the panel takes from the left of `room` while it is shown.
  static float width(float scale, float room);
  /// Whether draw() would show something new.
  bool has_news() const { return worker_.has_completions(); }
  /// Whether the current lesson has not finished, and whether a slice is running.
  bool busy() const { return pages_[page_]->busy(); }
  bool running() const { return worker_.pending() > 0; }

private:
  Document sampler_;                            ///< whose sampler rows are the lab's
  std::vector<std::unique_ptr<LabPage>> pages_; ///< in the order of lessons()
  std::size_t page_ = 0;
  TaskThread worker_; // last, so that it is destroyed first: completions point into the pages
};

} // namespace candela
