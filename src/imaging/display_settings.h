#pragma once
// Display settings of a picture.

namespace candela {

enum class ToneMap : int { reinhard, reinhard_simple, filmic, aces, srgb };
enum class FalseColor : int { automatic, off, viridis, magma };

/// Affect how the picture is shown and written to 8-bit files; never the accumulation.
struct DisplaySettings {
  ToneMap tone_map = ToneMap::srgb;
  float exposure = 0;         ///< stops (powers of two)
  bool auto_exposure = false; ///< the exposure is relative to one found from the picture
  float white_point = 4;      ///< luminance that extended Reinhard maps to white
  FalseColor false_color = FalseColor::automatic;
  float false_color_min = 0; ///< value at the start of the colours, in the view's unit
  float false_color_max = 0; ///< value at their end; if it is not above the start, both are found
                             ///< from the picture
  bool denoise = false;
  bool dither = true;
  bool operator==(const DisplaySettings&) const = default;
};

} // namespace candela
