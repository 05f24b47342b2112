#include "render/film/sample_range.h"

#include <algorithm>

namespace candela {

CropWindow clip_to_frame(const CropWindow& window, int frame_width, int frame_height) {
  if (window.empty()) return {0, 0, frame_width, frame_height};
  const int x0 = std::max(window.x, 0), y0 = std::max(window.y, 0);
  const int x1 = std::min(window.x + window.width, frame_width);
  const int y1 = std::min(window.y + window.height, frame_height);
  return {x0, y0, std::max(x1 - x0, 0), std::max(y1 - y0, 0)};
}

} // namespace candela
