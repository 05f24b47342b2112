#pragma once
// Samples of matter in space: what a file of smoke, cloud or fire holds.

#include "core/bounds.h"
#include "core/spectrum.h"

#include <cstdint>
#include <string>
#include <vector>

namespace candela {

/// Values at the centres of the cells of a box, x fastest, then y, then z; between them trilinear, and
/// towards the faces of the box those of the outermost cells. Nothing is outside of it.
struct VolumeGrid {
  static constexpr std::uint64_t kMaxCells = 1u << 28; ///< 1 GiB a channel

  glm::ivec3 cells{0};            ///< along each axis, at least 1
  Bounds3 bounds{};               ///< the box, scene units, where the file says so; else [-1, 1]^3
  std::vector<float> density;     ///< a value for each cell; >= 0, finite
  std::vector<float> temperature; ///< likewise, >= 0; or empty
  std::vector<vec3> color;        ///< of scattering, likewise, in [0, 1]; or empty
  std::string source;             ///< the file; empty if it was made by the program

  bool operator==(const VolumeGrid&) const = default;
  std::uint64_t cell_count() const {
    return static_cast<std::uint64_t>(cells.x) * static_cast<std::uint64_t>(cells.y) *
           static_cast<std::uint64_t>(cells.z);
  }
};

/// What is wrong with it: "density: cause; remedy"; empty if all is well.
std::string volume_grid_problem(const VolumeGrid& grid);

} // namespace candela
