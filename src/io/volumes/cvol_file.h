#pragma once
// Candela's own volumes, a text and then numbers, so that any program can write them:
//
//   candela volume 1
//   cells 64 64 64
//   bounds -1 -1 -1 1 1 1
//   channels density temperature color
//   data
//
// Lines end in LF. "bounds" may be missing: [-1, 1]^3. Of the channels, density has to be there. After the
// line "data" come little-endian floats: all values of the first channel, x fastest, then y, then z, then all
// of the next one; a color has three floats a cell. Nothing follows.

#include "media/volume_grid.h"

#include <string>

namespace candela {

/// Writes a valid grid, atomically. output_error if it cannot be written.
void write_cvol(const VolumeGrid& grid, const std::string& path);

} // namespace candela
