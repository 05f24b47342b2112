#pragma once
// Densities in bricks of 8^3 cells: what a brick holds at most bounds the extinction there, so that tracking
// takes long steps through thin parts (local majorants), and empty or uniform bricks take no memory.

#include "core/ray.h"
#include "media/volume_grid.h"

#include <memory>

namespace candela {

/// Of the densities between the samples of a brick, corners included.
struct BrickBounds {
  float mean;   ///< of the volume
  float most;   ///< the largest
  float spread; ///< largest distance from the mean; 0: the density is the mean everywhere
};

/// In cells, from the centre of the first cell: its own centre is 0, the box is from -1/2 to cells - 1/2.
class BrickGrid {
public:
  static constexpr int kSide = 8; ///< cells
  /// Tentative collisions of a ray in a brick, at most, so that all tracking ends whatever the extinction:
  /// where none of so many is real, the rest of the brick is taken for empty.
  static constexpr int kMostCollisions = 4096;

  explicit BrickGrid(const VolumeGrid& grid);

  glm::ivec3 cells() const { return cells_; }
  bool is_empty() const { return !(most_ > 0); }
  std::uint64_t memory_bytes() const {
    return samples_.size() * sizeof(float) + bricks_.size() * sizeof(Brick);
  }

  /// One of its bricks.
  struct Place {
    std::uint32_t index;
    vec3 corner; ///< the lowest
  };
  const BrickBounds& bounds(const Place& brick) const { return bricks_[brick.index].bounds; }
  /// At a place that walk() has found to lie in the brick.
  float density(const Place& brick, vec3 place) const;
  /// At any place; 0 outside of the box.
  float density(vec3 place) const;

  /// Calls visit(brick, begin, end) for the bricks along origin + t direction, t in [begin, end], in their
  /// order, until it returns false: of each the interval that lies in it. `end` may be infinite. Amanatides &
  /// Woo 1987, "A Fast Voxel Traversal Algorithm for Ray Tracing".
  template <class Visit>
  void walk(vec3 origin, vec3 direction, float begin, float end, Visit visit) const;

private:
  static constexpr int kSamples = kSide + 1; ///< along an edge of a brick, both faces included
  static constexpr std::uint32_t kUniform = ~0u;

  struct Brick {
    BrickBounds bounds;
    std::uint32_t first; ///< of its samples, in units of kSamples^3; kUniform: none, they are all the mean
  };

  Place brick_at(glm::ivec3 b) const {
    return {static_cast<std::uint32_t>((b.z * bricks_along_.y + b.y) * bricks_along_.x + b.x),
            vec3(kSide * b)};
  }

  glm::ivec3 cells_, bricks_along_;
  float most_ = 0;
  std::vector<Brick> bricks_;
  std::vector<float> samples_;
};

template <class Visit>
void BrickGrid::walk(vec3 origin, vec3 direction, float begin, float end, Visit visit) const {
  const vec3 low(-0.5f), high = vec3(cells_) - 0.5f;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < low[axis] || origin[axis] > high[axis]) return;
      continue;
    }
    const float a = (low[axis] - origin[axis]) / direction[axis];
    const float b = (high[axis] - origin[axis]) / direction[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(begin < end)) return;
  glm::ivec3 brick;
  vec3 next(kInfinity), step_length(kInfinity); // where the next brick along each axis begins
  glm::ivec3 step(0);
  const vec3 start = origin + begin * direction;
  for (int axis = 0; axis < 3; ++axis) {
    const float place = start[axis] / kSide;
    brick[axis] = std::clamp(static_cast<int>(std::floor(place)), 0, bricks_along_[axis] - 1);
    if (direction[axis] == 0) continue;
    step[axis] = direction[axis] > 0 ? 1 : -1;
    const int border = direction[axis] > 0 ? brick[axis] + 1 : brick[axis];
    next[axis] = (static_cast<float>(border * kSide) - origin[axis]) / direction[axis];
    step_length[axis] = kSide / std::abs(direction[axis]);
  }
  for (float t = begin;;) {
    // The outermost bricks go on to the faces of the box.
    int axis = 0;
    float least = kInfinity;
    for (int i = 0; i < 3; ++i) {
      const int after = brick[i] + step[i];
      if (after >= 0 && after < bricks_along_[i] && next[i] < least) least = next[i], axis = i;
    }
    const float stop = std::min(std::max(least, t), end);
    if (stop > t && !visit(brick_at(brick), t, stop)) return;
    if (!(least < end)) return;
    t = stop;
    brick[axis] += step[axis];
    next[axis] += step_length[axis];
  }
}

} // namespace candela
