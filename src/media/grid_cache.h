#pragma once

#include "media/brick_grid.h"
#include "media/procedural_grid.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace candela {

/// The bricks of grids, and grids that are computed, which edits of other values keep.
class GridCache {
public:
  /// Those of `previous` (may be null) serve again. Work is given up when `progress` (may be null) is
  /// cancelled, until trim().
  explicit GridCache(const GridCache* previous = nullptr, const Progress* progress = nullptr)
      : progress_(progress) {
    if (previous != nullptr) known_ = previous->used_, known_made_ = previous->used_made_;
  }
  /// The grid that is computed of the description. Throws Cancelled.
  std::shared_ptr<const VolumeGrid> made(const ProceduralGrid& desc) {
    const auto find = [&](const Made& grids) -> std::shared_ptr<const VolumeGrid> {
      for (const auto& [known, grid] : grids)
        if (known == desc) return grid;
      return nullptr;
    };
    if (auto grid = find(used_made_)) return grid;
    auto grid = find(known_made_);
    if (!grid) grid = make_procedural_grid(desc, progress_);
    used_made_.emplace_back(desc, grid);
    return grid;
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
  void trim() {
    known_.clear();
    known_made_.clear();
    progress_ = nullptr;
  }
  std::uint64_t memory_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& [grid, bricks] : used_) bytes += bricks->memory_bytes();
    for (const auto& [desc, grid] : used_made_)
      bytes += (grid->density.size() + grid->temperature.size()) * sizeof(float);
    return bytes;
  }

private:
  using Bricks = std::map<std::shared_ptr<const VolumeGrid>, std::shared_ptr<const BrickGrid>>;
  using Made = std::vector<std::pair<ProceduralGrid, std::shared_ptr<const VolumeGrid>>>;
  Bricks known_, used_;
  Made known_made_, used_made_;
  const Progress* progress_;
};

} // namespace candela
