#pragma once
// Which parts of a flat light shine how much.

#include "sampling/weighted_grid.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace candela {

/// Density over the unit square that is constant in each cell of a grid.
class EmissionGrid {
public:
  /// In proportion to the cells' luminance, row by row from y = 0: finite and not negative, not all 0. Throws
  /// Cancelled soon after `progress` is told to end; it may be null.
  EmissionGrid(std::span<const float> luminance, std::size_t columns, const Progress* progress = nullptr);

  /// Where it shines, in [0, 1)^2; u likewise.
  vec2 sample(vec2 u) const {
    const WeightedGrid::Sample s = cells_.sample(u);
    return glm::min((vec2(s.column, s.row) + s.u) / size_, kOneMinusEpsilon);
  }
  /// Density with which sample() gives a place, per area of the unit square; outside it is that of the
  /// border, for points are rounded.
  float pdf(vec2 place) const {
    const vec2 cell = glm::clamp(place * size_, vec2(0), size_ - 1.0f);
    return pdf_[static_cast<std::size_t>(cell.y) * columns_ + static_cast<std::size_t>(cell.x)];
  }
  /// Variance of the luminance over the square of its mean.
  float contrast() const { return contrast_; }
  /// Seen from far away, of the second moment of an even sample the picture makes this share: nothing if it
  /// is even, nearly all if it is mostly black. So much of a mixture of both samples by the grid; the rest
  /// keeps the weights bounded, for no place is left to the grid alone.
  float share_of_samples() const {
    constexpr float kMost = 0.9f;
    return std::min(contrast_ / (1 + contrast_), kMost);
  }
  std::size_t memory_bytes() const { return cells_.memory_bytes() + pdf_.size() * sizeof(float); }

private:
  WeightedGrid cells_;
  std::vector<float> pdf_;
  std::size_t columns_ = 0;
  vec2 size_{0}; ///< cells along x and y
  float contrast_ = 0;
};

} // namespace candela
