#pragma once
// Which samples of which part of the film come next, when parts are ahead of others: a region that the user
// looks at accumulates alone, and once it is given up the rest catches up, so that every pixel gets each
// sample index once and the image ends as the headless one, bit for bit.

#include "render/film/render_pass.h"

#include <vector>

namespace candela {

class SampleSchedule {
public:
  struct Job {
    CropWindow window;
    std::uint32_t begin = 0, end = 0; ///< sample indices
  };

  /// A film of this size whose pixels all have `samples`. The region stays.
  void reset(int width, int height, std::uint32_t samples);

  /// Only these pixels get samples; an empty window, or one outside of the film, means all of them.
  void set_region(const CropWindow& region);

  /// The next samples: the least that any pixel of the region has, up to `portion` more, but no further than
  /// what other pixels have already.
  Job next(std::uint32_t portion) const;
  /// `job` is what next() gave, or a shorter one of the same window.
  void done(const Job& job);

  /// Samples that every pixel of the region has.
  std::uint32_t samples() const;

private:
  struct Patch { ///< [x0, x1) x [y0, y1)
    int x0, y0, x1, y1;
    std::uint32_t samples;
  };
  bool active(const Patch& p) const {
    return p.x0 >= region_.x0 && p.x1 <= region_.x1 && p.y0 >= region_.y0 && p.y1 <= region_.y1;
  }
  void split();
  void merge();

  int width_ = 0, height_ = 0;
  CropWindow wanted_;
  Patch region_{};             ///< wanted_ clipped to the film; `samples` means nothing here
  std::vector<Patch> patches_; ///< a partition of the film; each inside or outside of the region
};

} // namespace candela
