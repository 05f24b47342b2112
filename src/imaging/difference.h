#pragma once
// The difference of two pictures in false colour.

#include "core/math.h"
#include "imaging/color_map.h"

#include <cstdint>
#include <span>
#include <vector>

namespace candela {

/// Mean over channels of (x - r) / sqrt(r^2 + 0.01), the signed relative error of x. Its magnitude over
/// single channels is relative_error (imaging/compare.h).
double relative_difference(vec3 x, vec3 r);

/// For t in [-1, 1], clipped: blue where it is negative, orange where it is positive, near black at 0;
/// distinguishable for the colour-blind. NaN is the middle.
std::array<std::uint8_t, 3> map_signed_color(float t);

/// RGBA of every pixel. Without a sign, the colours of relative_error_picture: magma by decades from 0.1 % to
/// 100 %. With a sign, map_signed_color of relative_difference / range. Pixels that are not finite are cyan.
std::vector<std::uint8_t> difference_rgba8(std::span<const vec3> image, std::span<const vec3> reference,
                                           bool with_sign, float range);

} // namespace candela
