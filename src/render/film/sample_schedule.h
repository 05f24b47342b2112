#pragma once
// The next samples of parts of the film with different progress: a region selected by the user accumulates
// alone, and when it is reset the rest catches up, so that every pixel gets each sample index once and the
// final image equals the headless one, bit for bit.

#include "render/film/sample_range.h"

#include <span>
#include <vector>

namespace candela {

class SampleSchedule {
public:
  /// Pixels that all have their samples up to, not including, index `samples`.
  struct Patch {
    PixelBox pixels;
    std::uint32_t samples;
  };
  struct Job {
    CropWindow window;
    std::uint32_t begin = 0, end = 0; ///< sample indices
  };

  /// A film of this window of the frame whose pixels all have `samples`. The region stays.
  void reset(const CropWindow& film, std::uint32_t samples);

  /// Only these pixels of the frame get samples; an empty window, or one outside of the film, means all.
  void set_region(const CropWindow& region);

  /// The next samples: the least that any pixel of the region has, up to `portion` more, but no further than
  /// what other pixels have already.
  Job next(std::uint32_t portion) const;
  /// `job` is what next() gave, or a shorter one of the same window.
  void done(const Job& job);

  /// Samples that every pixel of the region has.
  std::uint32_t samples() const;

  /// Samples [begin, end) of a window within the film were rendered elsewhere. False, and nothing changes,
  /// unless all of its pixels have their samples up to `begin`, and no more.
  bool add(const CropWindow& window, std::uint32_t begin, std::uint32_t end);

  /// Together they are the film, in no particular order.
  std::span<const Patch> patches() const { return patches_; }

private:
  bool active(const Patch& p) const;
  void merge();

  PixelBox film_{0, 0, 0, 0};
  CropWindow wanted_;
  PixelBox region_{0, 0, 0, 0}; ///< wanted_ clipped to the film
  std::vector<Patch> patches_;  ///< each inside or outside of the region
};

} // namespace candela
