#pragma once
// From linear radiance to what a screen shows. The window and the 8-bit files use the same code.

#include "core/math.h"
#include "imaging/display_settings.h"

#include <cstdint>
#include <span>

namespace candela {

/// The display-referred linear colour, not yet encoded; above 1 it will be clipped. First the exposure (a
/// factor of 2^stops), then
///   reinhard: L (1 + L / w^2) / (1 + L) of the luminance, the colour scaled along (Reinhard, Stark, Shirley
///             and Ferwerda, "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, eq. 4);
///   reinhard_simple: the same without a white point, L / (1 + L) (eq. 3);
///   filmic:   Hable's curve of "Uncharted 2" per channel (Hable, "Uncharted 2: HDR Lighting", GDC 2010),
///             with its exposure bias of 2 and its linear white of 11.2, so that 5.6 becomes white;
///   aces:     Hill's fit of the ACES reference rendering transform and its sRGB output transform, by channel
///             in a wider space, so that bright saturated colours go to white (Stephen Hill, "ACES.hlsl" in
///             BakingLab by Pettineo and Hill, 2016); middle grey becomes 0.106, as darker as ACES has it;
///   srgb:     nothing.
/// Negative and NaN channels count as 0, infinite ones as very large: both stay visible as black and white
/// spots, and are counted elsewhere.
vec3 tone_mapped(vec3 linear, const DisplaySettings& display);

/// The scene-linear grey, before the exposure, that becomes white (code 255) first; infinity where only a
/// limit is white. A histogram marks it.
float white_level(const DisplaySettings& display);

/// Pixels row by row, of rows of `width`; `origin` is where the first one lies in the frame that they are a
/// part of. The dither depends on it.
struct PictureRows {
  int width = 1;
  ivec2 origin{0};
};

/// round(255 s) with s the sRGB encoding (IEC 61966-2-1) of x clipped to [0, 1]: the correctly rounded result
/// for every float, by one table look-up. NaN gives 0.
std::uint8_t srgb8_from_linear(float x);

/// tone_mapped, then srgb8_from_linear, for every pixel. The output has 3 (4) bytes a pixel, alpha is 255.
///
/// With display.dither the code is floor(255 s + u) instead, with a u that is uniform over (0, 1) from
/// pixel to pixel: the mean over pixels of one value is that value, where rounding would make bands of a
/// gradient. What is exactly a code (black, white, a flat area of 8 bits) stays that code, and no code is
/// more than one from the rounded one. u is the same for a pixel's three channels, so that greys stay grey,
/// and a function of its place alone, so that the bits are the same every time.
void tone_map_rgb8(std::span<const vec3> linear, PictureRows rows, const DisplaySettings& display,
                   std::span<std::uint8_t> rgb);
void tone_map_rgba8(std::span<const vec3> linear, PictureRows rows, const DisplaySettings& display,
                    std::span<std::uint8_t> rgba);

} // namespace candela
