#include "media/brick_grid.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Bricks along an axis of so many cells: between the first and the last centre.
int bricks_along(int cells) { return std::max((cells - 1 + BrickGrid::kSide - 1) / BrickGrid::kSide, 1); }

} // namespace

BrickGrid::BrickGrid(const VolumeGrid& grid)
    : cells_(grid.cells),
      bricks_along_(bricks_along(cells_.x), bricks_along(cells_.y), bricks_along(cells_.z)) {
  const auto width = static_cast<std::size_t>(cells_.x), height = static_cast<std::size_t>(cells_.y);
  std::vector<float> own(static_cast<std::size_t>(kSamples) * kSamples * kSamples);
  std::uint32_t stored = 0;
  for (int bz = 0; bz < bricks_along_.z; ++bz)
    for (int by = 0; by < bricks_along_.y; ++by)
      for (int bx = 0; bx < bricks_along_.x; ++bx) {
        float least = kInfinity, most = 0;
        double sum = 0, weights = 0;
        for (int k = 0, n = 0; k < kSamples; ++k)
          for (int j = 0; j < kSamples; ++j)
            for (int i = 0; i < kSamples; ++i, ++n) {
              const auto x = static_cast<std::size_t>(std::min(bx * kSide + i, cells_.x - 1));
              const auto y = static_cast<std::size_t>(std::min(by * kSide + j, cells_.y - 1));
              const auto z = static_cast<std::size_t>(std::min(bz * kSide + k, cells_.z - 1));
              const float value = grid.density[(z * height + y) * width + x];
              own[static_cast<std::size_t>(n)] = value;
              least = std::min(least, value), most = std::max(most, value);
              // The integral of trilinear interpolation: samples of faces count half.
              auto share = [](int c) { return c == 0 || c == kSide ? 0.5 : 1.0; };
              const double weight = share(i) * share(j) * share(k);
              sum += weight * static_cast<double>(value), weights += weight;
            }
        most_ = std::max(most_, most);
        const bool uniform = most == least;
        const float mean = uniform ? most : static_cast<float>(sum / weights);
        bricks_.push_back(
            {{mean, most, uniform ? 0 : std::max(most - mean, mean - least)}, uniform ? kUniform : stored});
        if (uniform) continue;
        samples_.insert(samples_.end(), own.begin(), own.end());
        ++stored;
      }
}

float BrickGrid::density(const Place& brick, vec3 place) const {
  const Brick& b = bricks_[brick.index];
  if (b.first == kUniform) return b.bounds.mean;
  // Up to the last sample that is no repetition, and within the brick, whatever rounding has done.
  const vec3 local =
      glm::clamp(glm::clamp(place, vec3(0), vec3(cells_ - 1)) - brick.corner, vec3(0), vec3(kSide));
  const glm::ivec3 i = glm::min(glm::ivec3(local), glm::ivec3(kSide - 1));
  const vec3 f = local - vec3(i);
  constexpr std::size_t kRow = kSamples, kPlane = kRow * kSamples;
  const float* s = &samples_[b.first * kPlane * kSamples + static_cast<std::size_t>(i.z) * kPlane +
                             static_cast<std::size_t>(i.y) * kRow + static_cast<std::size_t>(i.x)];
  const float a = glm::mix(glm::mix(s[0], s[1], f.x), glm::mix(s[kRow], s[kRow + 1], f.x), f.y);
  const float c = glm::mix(glm::mix(s[kPlane], s[kPlane + 1], f.x),
                           glm::mix(s[kPlane + kRow], s[kPlane + kRow + 1], f.x), f.y);
  return glm::mix(a, c, f.z);
}

float BrickGrid::density(vec3 place) const {
  if (!glm::all(glm::greaterThanEqual(place, vec3(-0.5f))) ||
      !glm::all(glm::lessThanEqual(place, vec3(cells_) - 0.5f)))
    return 0;
  const glm::ivec3 b =
      glm::clamp(glm::ivec3(glm::floor(place / static_cast<float>(kSide))), glm::ivec3(0), bricks_along_ - 1);
  return density(brick_at(b), place);
}

} // namespace candela
