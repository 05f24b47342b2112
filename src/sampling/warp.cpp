#include "sampling/warp.h"

#include "core/lanes.h"

namespace candela {

void sample_uniform_discs(std::span<vec2> u) {
  Lanes<float> x, y;
  for (std::size_t begin = 0; begin < u.size(); begin += kLaneCount) {
    const std::size_t count = std::min(kLaneCount, u.size() - begin);
    for (std::size_t i = 0; i < count; ++i) x[i] = u[begin + i].x, y[i] = u[begin + i].y;
    for (std::size_t i = 0; i < count; ++i) { // of plain arrays, which compilers vectorise
      vec2 d = sample_uniform_disc({x[i], y[i]});
      x[i] = d.x, y[i] = d.y;
    }
    for (std::size_t i = 0; i < count; ++i) u[begin + i] = {x[i], y[i]};
  }
}

} // namespace candela
