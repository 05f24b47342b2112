#pragma once
// Sampling cells of a large grid in proportion to their weights.

#include "core/math.h"
#include "core/progress.h"

#include <span>
#include <vector>

namespace candela {

/// Indices 0..n-1 by inversion of their distribution function, which keeps well-distributed numbers well
/// distributed; a table of where to begin (Chen & Asau 1974, "On Generating Random Variates from an Empirical
/// Distribution") makes that a few steps on average.
class GuidedTable {
public:
  struct Sample {
    std::uint32_t index;
    float u; ///< what is left of the number, uniform in [0, 1) again
  };

  GuidedTable() = default;
  /// Weights finite and not negative, at least one; where all are 0 the draws are uniform.
  explicit GuidedTable(std::span<const float> weights);

  /// Never an index without weight. u in [0, 1).
  Sample sample(float u) const {
    // The first whose upper end is above u, at or after the first that reaches into u's part of [0, 1).
    std::uint32_t i = guide_[static_cast<std::uint32_t>(u * parts_)];
    while (upper_[i] <= u) ++i;
    const float lower = i > 0 ? upper_[i - 1] : 0;
    return {i, std::min((u - lower) / (upper_[i] - lower), kOneMinusEpsilon)};
  }
  std::size_t memory_bytes() const { return (upper_.size() + guide_.size()) * 4; }

private:
  std::vector<float> upper_; ///< the distribution function behind each; 1 from the last one with weight on
  std::vector<std::uint32_t> guide_;
  float parts_ = 0; ///< how many; a power of two, so that no product with it rounds
};

/// Cells of a grid: a row by its sum, then one of its cells.
class WeightedGrid {
public:
  struct Sample {
    std::uint32_t column, row;
    vec2 u; ///< what is left of the numbers
  };

  WeightedGrid() = default;
  /// Weights row by row, as of GuidedTable.
  WeightedGrid(std::span<const float> weights, std::size_t columns, const Progress* progress = nullptr);

  Sample sample(vec2 u) const {
    GuidedTable::Sample row = rows_.sample(u.y);
    GuidedTable::Sample column = columns_[row.index].sample(u.x);
    return {column.index, row.index, {column.u, row.u}};
  }
  std::size_t memory_bytes() const;

private:
  GuidedTable rows_;
  std::vector<GuidedTable> columns_; ///< of each row
};

} // namespace candela
