#pragma once
// Colour maps: perceptually uniform with monotonic lightness, readable in grey and by the colour-blind (Smith
// and van der Walt's magma and viridis of 2015, CC0, here from nine of their colours each).

#include <array>
#include <cstdint>

namespace candela {

enum class ColorMap : int { magma, viridis };

/// 8-bit sRGB for t in [0, 1], clipped; NaN is the start of the map.
std::array<std::uint8_t, 3> map_color(ColorMap map, float t);

} // namespace candela
