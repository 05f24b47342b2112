#pragma once
// Clouds, smoke and flames that are computed, not read.

#include "core/progress.h"
#include "media/volume_grid.h"

#include <memory>
#include <string_view>

namespace candela {

/// Which of them, and how it looks. The same values give the same bits, whatever the number of threads.
struct ProceduralGrid {
  static constexpr std::string_view kPatterns[] = {"cloud", "smoke", "fire"};
  static constexpr int kLeastResolution = 16, kMostResolution = 512;

  int pattern = 0;       ///< index of kPatterns
  int seed = 1;          ///< another number, another one of the same kind
  int resolution = 128;  ///< cells along the longest side, in [kLeastResolution, kMostResolution]
  float frequency = 4;   ///< features of the largest size along the longest side
  int octaves = 5;       ///< sizes of features, each half of the one before, at least 1
  float coverage = 0.5f; ///< how much of the box is filled, in [0, 1]
  float softness = 0.3f; ///< of the edges, in [0, 1]: from sharp ones to a gradual decrease
  bool operator==(const ProceduralGrid&) const = default;
};

/// Sides of the pattern's box to its longest one. The grid's bounds are such a box about 0, 2 units long.
vec3 procedural_proportions(int pattern);

/// The grid: a cumulus of round billows on a flat base (after Schneider & Vos 2015, "The Real-time Volumetric
/// Cloudscapes of Horizon Zero Dawn"), a ball of curling smoke, or a flame. y is up. Densities are in [0, 1],
/// and 0 at the faces of the box and where nothing is; a flame has temperatures in [0, 1]. Throws Cancelled
/// when `progress`, which may be null, is cancelled. `threads`: 0 for as many as the machine runs at once.
std::shared_ptr<const VolumeGrid> make_procedural_grid(const ProceduralGrid& desc,
                                                       const Progress* progress = nullptr, int threads = 0);

} // namespace candela
