#pragma once
// Where the two pictures of a comparison lie.

#include "app/compare/compare_state.h"
#include "app/tools/viewport.h"

namespace candela {

struct ComparePanes {
  struct Pane {
    bool shown = false;
    PixelRect picture; ///< the whole film, parts of which may lie outside of the clip
    PixelRect clip;    ///< what of the window it may draw on
  };
  std::array<Pane, 2> variants;
  bool difference = false; ///< the difference is shown, where variant 0 has its pane
  int divider = -1;        ///< x of the line between the two; -1: there is none

  /// The variant that is at this place of the window; 0 where neither is.
  int variant_at(vec2 position) const;
};

/// `region` is what is free of panels, `whole` where the picture would lie without a comparison, `shape` the
/// film's size as it is shown, in pixels.
ComparePanes compare_panes(const CompareState& state, const PixelRect& region, const PixelRect& whole,
                           ivec2 shape);

} // namespace candela
