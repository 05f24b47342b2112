#pragma once

#include "media/brick_grid.h"

#include <map>
#include <memory>

namespace candela {

/// The bricks of grids, which edits of other values keep.
class GridCache {
public:
  /// Those of `previous` (may be null) serve again.
  explicit GridCache(const GridCache* previous = nullptr) {
    if (previous != nullptr) known_ = previous->used_;
  }
  std::shared_ptr<const BrickGrid> bricks(const std::shared_ptr<const VolumeGrid>& grid) {
    auto& bricks = used_[grid];
    if (!bricks) {
      const auto known = known_.find(grid);
      bricks = known != known_.end() ? known->second : std::make_shared<const BrickGrid>(*grid);
    }
    return bricks;
  }
  /// Lets go of what was not asked for.
  void trim() { known_.clear(); }
  std::uint64_t memory_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& [grid, bricks] : used_) bytes += bricks->memory_bytes();
    return bytes;
  }

private:
  using Bricks = std::map<std::shared_ptr<const VolumeGrid>, std::shared_ptr<const BrickGrid>>;
  Bricks known_, used_;
};

} // namespace candela
