#pragma once
// Tone mapping: from linear radiance to display values. The window and the 8-bit files use the same code.

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
/// Negative and NaN channels count as 0, infinite ones as very large. They stay visible as black and white
/// pixels, and are counted elsewhere.
vec3 tone_mapped(vec3 linear, const DisplaySettings& display);

/// The smallest scene-linear grey, before the exposure, that becomes white (code 255); infinity if white is
/// only a limit. A histogram marks it.
float white_level(const DisplaySettings& display);

/// Rows of `width` pixels; `origin` is the first one's position in the frame, on which the dither depends.
struct PictureRows {
  int width = 1;
  ivec2 origin{0};
};

/// round(255 s) with s the sRGB encoding (IEC 61966-2-1) of x clipped to [0, 1]: the correctly rounded result
/// for every float, by one table look-up. NaN gives 0.
std::uint8_t srgb8_from_linear(float x);

/// tone_mapped, then srgb8_from_linear, for every pixel. The output has 3 (4) bytes a pixel, alpha is 255.
///
/// With display.dither the code is floor(255 s + u) instead, with a u that is uniform over (0, 1) from pixel
/// to pixel: the mean over pixels of one value is that value, while rounding would show bands in gradients.
/// Exact codes (black, white, flat areas of 8 bits) do not change, and every code differs from the rounded
/// one by at most one. u is equal for a pixel's three channels, so that greys stay grey, and depends only on
/// the pixel's position, so that the output is reproducible.
void tone_map_rgb8(std::span<const vec3> linear, PictureRows rows, const DisplaySettings& display,
                   std::span<std::uint8_t> rgb);
void tone_map_rgba8(std::span<const vec3> linear, PictureRows rows, const DisplaySettings& display,
                    std::span<std::uint8_t> rgba);

} // namespace candela
