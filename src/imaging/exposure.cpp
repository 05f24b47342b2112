#include "imaging/exposure.h"

#include "core/color.h"

#include <cassert>

namespace candela {

float automatic_exposure(std::span<const vec3> linear, int width, int height) {
  assert(linear.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  constexpr int kCells = 64;
  const int columns = std::min(width, kCells), rows = std::min(height, kCells);
  double sum_of_logs = 0;
  int counted = 0;
  for (int row = 0; row < rows; ++row) {
    const int y0 = row * height / rows, y1 = (row + 1) * height / rows;
    for (int column = 0; column < columns; ++column) {
      const int x0 = column * width / columns, x1 = (column + 1) * width / columns;
      double sum = 0;
      for (int y = y0; y < y1; ++y) {
        const vec3* at = linear.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        for (int x = x0; x < x1; ++x) {
          const float l = luminance(at[x]);
          if (l > 0 && l < kInfinity) sum += static_cast<double>(l);
        }
      }
      if (sum <= 0) continue;
      sum_of_logs += std::log2(sum / (static_cast<double>(x1 - x0) * (y1 - y0)));
      ++counted;
    }
  }
  if (counted == 0) return 0;
  return static_cast<float>(std::log2(static_cast<double>(kMiddleGrey)) - sum_of_logs / counted);
}

} // namespace candela
