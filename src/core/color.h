#pragma once
// Colours are linear with Rec. 709 primaries; sRGB is only the encoding of 8-bit files and screens.

#include "core/math.h"

namespace candela {

/// CIE Y of a linear Rec. 709 colour.
inline float luminance(vec3 rgb) { return glm::dot(rgb, vec3(0.212671f, 0.715160f, 0.072169f)); }

/// IEC 61966-2-1, both directions, for values in [0, 1] (and its linear extension below 0).
inline float srgb_from_linear(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}
inline float linear_from_srgb(float x) {
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

} // namespace candela
