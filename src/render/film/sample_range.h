#pragma once
// A range of samples and pixels.

#include <cstdint>

namespace candela {

/// Sample indices [begin, end) of the pixels of a lattice. The first pass of an interactive render visits a
/// coarse lattice first, then finer ones: every level adds its own pixels' sample 0, so no path is traced
/// twice or thrown away.
struct SampleRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 1;
  int lattice = 1;      ///< pixels whose x and y are multiples of it ...
  int skip_lattice = 0; ///< ... but not both of this one; 0: skip none
};

struct CropWindow { ///< pixels of the frame; empty width or height: the whole film
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const CropWindow&) const = default;
  bool empty() const { return width <= 0 || height <= 0; }
};

/// The part of the window within a frame of this size; the whole frame for an empty window.
CropWindow clip_to_frame(const CropWindow& window, int frame_width, int frame_height);

/// Pixels [x0, x1) x [y0, y1) of the frame.
struct PixelBox {
  int x0, y0, x1, y1;
};

} // namespace candela
