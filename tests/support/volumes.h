#pragma once
// Grids for tests.

#include "media/volume_grid.h"

#include <random>

namespace candela::test {

inline std::size_t cell_index(const VolumeGrid& grid, int x, int y, int z) {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(grid.cells.y) +
          static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(grid.cells.x) +
         static_cast<std::size_t>(x);
}

/// Densities in [0, 1), a tenth of them 0.
inline VolumeGrid random_grid(glm::ivec3 cells, std::uint64_t seed) {
  VolumeGrid grid;
  grid.cells = cells;
  grid.bounds.lo = vec3(-1), grid.bounds.hi = vec3(1);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> density(-0.1f, 1);
  grid.density.resize(grid.cell_count());
  for (float& value : grid.density) value = std::max(density(random), 0.0f);
  return grid;
}

/// Smooth waves between 0 and 1, with empty corners.
inline VolumeGrid wavy_grid(glm::ivec3 cells) {
  VolumeGrid grid = random_grid(cells, 0);
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) {
        const vec3 p = (vec3(x, y, z) + 0.5f) / vec3(cells) * 2.0f - 1.0f;
        const float wave = 0.5f + 0.5f * std::sin(7 * p.x + 3 * p.y) * std::cos(5 * p.z - 2 * p.x);
        grid.density[cell_index(grid, x, y, z)] = glm::dot(p, p) < 1.2f ? wave : 0;
      }
  return grid;
}

} // namespace candela::test
