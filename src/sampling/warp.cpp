#include "sampling/warp.h"

#include <array>

namespace candela {

void sample_uniform_discs(std::span<vec2> u) {
  constexpr std::size_t kChunk = 64;
  std::array<float, kChunk> x, y;
  for (std::size_t begin = 0; begin < u.size(); begin += kChunk) {
    const std::size_t count = std::min(kChunk, u.size() - begin);
    for (std::size_t i = 0; i < count; ++i) x[i] = u[begin + i].x, y[i] = u[begin + i].y;
    for (std::size_t i = 0; i < count; ++i) { // of plain arrays, which compilers vectorise
      vec2 d = sample_uniform_disc({x[i], y[i]});
      x[i] = d.x, y[i] = d.y;
    }
    for (std::size_t i = 0; i < count; ++i) u[begin + i] = {x[i], y[i]};
  }
}

} // namespace candela
