#pragma once
// Application of the display settings to a picture: first the values that depend on its pixels (exposure,
// range of the false colours), then the mapping of every pixel. The window and the 8-bit files share this
// code.

#include "imaging/color_map.h"
#include "imaging/tone_map.h"
#include "imaging/view.h"

#include <optional>
#include <string_view>

namespace candela {

/// The mapping of values to false colours.
struct FalseColorScale {
  ColorMap map = ColorMap::viridis;
  float lo = 0; ///< at the start of the colours, in the view's unit
  float hi = 1; ///< at their end, > lo
  bool logarithmic = false;
  bool black_at_zero = false; ///< 0 means no value (depth without a surface)

  /// Position of a value in the map, 0 to 1 without clipping; NaN for NaN.
  float position(float value) const;
  /// The inverse, for the ticks of a legend.
  float value(float position) const;
  bool operator==(const FalseColorScale&) const = default;
};

struct DisplayTransform {
  DisplaySettings tone;         ///< with the total exposure, without auto_exposure, with the effective dither
  float automatic_exposure = 0; ///< stops; the automatic part of tone.exposure
  std::optional<FalseColorScale> false_color; ///< in place of the tone map
  bool operator==(const DisplayTransform&) const = default;
};

/// For a picture of `view` in linear values, row by row. `display_scale` multiplies values that are shown
/// without false colour (Frame::display_scale). Only radiance is exposed and tone-mapped; properties of
/// surfaces and shares are encoded directly. The range of the false colours, unless the settings give it, is
/// that between the 1st and the 99th percentile of a depth, from 0 to the 99th of a cost, from 0 to the
/// largest count, [0, 1] of a share, and at most six decades, in equal steps of the logarithm, of radiance
/// and variance. Only radiance is dithered: colours that represent numbers must be exact.
DisplayTransform display_transform(std::span<const vec3> linear, int width, int height,
                                   const DisplaySettings& display, View view, float display_scale);

/// Every pixel to 8-bit sRGB. The output has 3 (4) bytes a pixel, alpha is 255. False colours show the
/// luminance.
void display_rgb8(std::span<const vec3> linear, PictureRows rows, const DisplayTransform& transform,
                  std::span<std::uint8_t> rgb);
void display_rgba8(std::span<const vec3> linear, PictureRows rows, const DisplayTransform& transform,
                   std::span<std::uint8_t> rgba);

/// The unit of the view's values; "" if they have none.
std::string_view view_unit(View view);

} // namespace candela
