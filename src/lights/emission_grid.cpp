#include "lights/emission_grid.h"

namespace candela {

EmissionGrid::EmissionGrid(std::span<const float> luminance, std::size_t columns, const Progress* progress)
    : cells_(luminance, columns, progress), columns_(columns) {
  const std::size_t rows = luminance.size() / columns;
  size_ = vec2(columns, rows);
  const auto n = static_cast<double>(luminance.size());
  double sum = 0, squares = 0;
  for (float l : luminance) {
    const auto value = static_cast<double>(l);
    sum += value, squares += value * value;
  }
  const double mean = sum / n;
  contrast_ = static_cast<float>(std::max(squares / n / (mean * mean) - 1, 0.0));
  pdf_.reserve(luminance.size());
  for (float l : luminance) pdf_.push_back(static_cast<float>(static_cast<double>(l) / mean));
}

} // namespace candela
