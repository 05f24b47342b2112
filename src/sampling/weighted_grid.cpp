#include "sampling/weighted_grid.h"

#include <stdexcept>

namespace candela {

GuidedTable::GuidedTable(std::span<const float> weights) {
  double sum = 0;
  for (float w : weights) {
    if (!(w >= 0) || std::isinf(w))
      throw std::invalid_argument("a distribution's weights must be finite and not negative");
    sum += static_cast<double>(w);
  }
  if (weights.empty()) throw std::invalid_argument("a distribution needs a weight");
  const std::size_t n = weights.size();
  upper_.resize(n);
  double running = 0;
  std::size_t last = n - 1; // of any weight: rounding must not leave numbers above it
  for (std::size_t i = 0; i < n; ++i) {
    double share = sum > 0 ? static_cast<double>(weights[i]) / sum : 1 / static_cast<double>(n);
    if (share > 0) last = i;
    running += share;
    upper_[i] = static_cast<float>(std::min(running, 1.0));
  }
  std::fill(upper_.begin() + static_cast<std::ptrdiff_t>(last), upper_.end(), 1.0f);
  const std::size_t parts = std::bit_ceil((n + 3) / 4);
  parts_ = static_cast<float>(parts);
  guide_.resize(parts);
  std::uint32_t i = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    while (upper_[i] <= static_cast<float>(part) / parts_) ++i;
    guide_[part] = i;
  }
}

WeightedGrid::WeightedGrid(std::span<const float> weights, std::size_t columns, const Progress* progress) {
  if (columns == 0 || weights.empty() || weights.size() % columns != 0)
    throw std::invalid_argument("a grid needs whole rows of weights");
  std::vector<float> sums;
  for (std::size_t begin = 0; begin < weights.size(); begin += columns) {
    if (progress != nullptr) progress->check();
    auto row = weights.subspan(begin, columns);
    columns_.emplace_back(row);
    double sum = 0;
    for (float w : row) sum += static_cast<double>(w);
    sums.push_back(static_cast<float>(sum));
  }
  rows_ = GuidedTable(sums);
}

std::size_t WeightedGrid::memory_bytes() const {
  std::size_t bytes = rows_.memory_bytes();
  for (const GuidedTable& row : columns_) bytes += row.memory_bytes() + sizeof(GuidedTable);
  return bytes;
}

} // namespace candela
