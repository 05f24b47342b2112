#pragma once
// How the display settings apply to one picture: what is found from its pixels (exposure, range of the false
// colours) is worked out first, then every pixel is mapped. The window and the 8-bit files use the same code,
// so they show the same.

#include "imaging/color_map.h"
#include "imaging/tone_map.h"
#include "imaging/view.h"

#include <optional>
#include <string_view>

namespace candela {

/// What a colour means.
struct FalseColorScale {
  ColorMap map = ColorMap::viridis;
  float lo = 0; ///< at the start of the colours, in the view's unit
  float hi = 1; ///< at their end, > lo
  bool logarithmic = false;
  bool black_at_zero = false; ///< 0 means that there is nothing (the depth where no surface is)

  /// Where a value lies in the map, 0 to 1 without clipping; NaN for NaN.
  float position(float value) const;
  /// The other way round, for the ticks of a legend.
  float value(float position) const;
  bool operator==(const FalseColorScale&) const = default;
};

struct DisplayTransform {
  DisplaySettings tone;         ///< its exposure is the whole one, auto_exposure is off, dither as it applies
  float automatic_exposure = 0; ///< stops; that part of tone.exposure that was found from the picture
  std::optional<FalseColorScale> false_color; ///< in place of the tone map
  bool operator==(const DisplayTransform&) const = default;
};

/// For a picture of `view` in linear values, row by row. `display_scale` multiplies values that are shown
/// without false colour (Frame::display_scale). Only radiance is exposed and tone-mapped; what is a property
/// of surfaces or a share is encoded as it is. The range of the false colours, where the settings leave it
/// open, is that between the 1st and the 99th percentile of a depth, from 0 to the 99th of a cost, from 0 to
/// the largest count, [0, 1] of a share, and at most six decades, in equal steps of the logarithm, of
/// radiance and variance. Only radiance is dithered: colours that stand for numbers are to be exact.
DisplayTransform display_transform(std::span<const vec3> linear, int width, int height,
                                   const DisplaySettings& display, View view, float display_scale);

/// Every pixel to 8-bit sRGB. The output has 3 (4) bytes a pixel, alpha is 255. False colours are of the
/// luminance.
void display_rgb8(std::span<const vec3> linear, PictureRows rows, const DisplayTransform& transform,
                  std::span<std::uint8_t> rgb);
void display_rgba8(std::span<const vec3> linear, PictureRows rows, const DisplayTransform& transform,
                   std::span<std::uint8_t> rgba);

/// The unit of the view's values; "" where they have none.
std::string_view view_unit(View view);

} // namespace candela
