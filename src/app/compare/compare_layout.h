#pragma once
// The screen layout of a comparison's two pictures.

#include "app/compare/compare_state.h"
#include "app/tools/viewport.h"

namespace candela {

struct ComparePanes {
  struct Pane {
    bool shown = false;
    PixelRect picture; ///< the whole film; parts may lie outside the clip rectangle
    PixelRect clip;    ///< the part of the window that it may draw to
  };
  std::array<Pane, 2> variants;
  bool difference = false; ///< the difference is shown in variant 0's pane
  int divider = -1;        ///< x of the line between the two; -1: none

  /// The variant at this position of the window; 0 if there is none.
  int variant_at(vec2 position) const;
};

/// `region` is the part of the window without panels, `whole` the picture's rectangle without a comparison,
/// `shape` the displayed size of the film in pixels.
ComparePanes compare_panes(const CompareState& state, const PixelRect& region, const PixelRect& whole,
                           ivec2 shape);

} // namespace candela
