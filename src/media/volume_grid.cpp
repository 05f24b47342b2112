#include "media/volume_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace candela {

std::string volume_grid_problem(const VolumeGrid& grid) {
  if (!(grid.cells.x > 0 && grid.cells.y > 0 && grid.cells.z > 0))
    return fmt::format("cells: {} x {} x {} has no cell; give at least 1 along each axis", grid.cells.x,
                       grid.cells.y, grid.cells.z);
  const std::uint64_t count = grid.cell_count();
  if (count > VolumeGrid::kMaxCells)
    return fmt::format("cells: {} are more than {}; make the grid coarser", count, VolumeGrid::kMaxCells);
  if (!glm::all(glm::lessThan(grid.bounds.lo, grid.bounds.hi)))
    return "bounds: the box is empty; give a lower corner below the upper one";
  auto is_amount = [](float value) { return value >= 0 && std::isfinite(value); };
  if (grid.density.size() != count) return "density: not one value a cell; give as many as there are cells";
  if (!std::ranges::all_of(grid.density, is_amount))
    return "density: negative, infinite or no number; give values from 0 up";
  if (!grid.temperature.empty() &&
      (grid.temperature.size() != count || !std::ranges::all_of(grid.temperature, is_amount)))
    return "temperature: not one value from 0 up a cell; give as many as there are cells";
  auto is_color = [](vec3 c) {
    return glm::all(glm::greaterThanEqual(c, vec3(0))) && glm::all(glm::lessThanEqual(c, vec3(1)));
  };
  if (!grid.color.empty() && (grid.color.size() != count || !std::ranges::all_of(grid.color, is_color)))
    return "color: not one value in [0, 1] a cell; give as many as there are cells";
  return {};
}

} // namespace candela
