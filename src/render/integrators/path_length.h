#pragma once
// How long paths may become, and which lengths are shown.

#include "scene/document.h"

namespace candela {

/// Whether the settings show light of paths of `depth` segments.
bool shows_depth(const PathSettings& settings, int depth);
/// Where Russian roulette is off and path.max_depth sets no limit, paths end after so many segments.
inline constexpr int kMostSegmentsWithoutRoulette = 1024;
/// The longest path that can matter under the settings, in segments.
int longest_path(const PathSettings& settings);

} // namespace candela
