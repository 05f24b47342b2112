#pragma once
// A lens as its designers print it: a table of interfaces.

#include <span>
#include <string_view>

namespace candela {

/// One row, from the scene to the film; lengths in millimetres. A flat one with the same index on both sides
/// is the aperture stop.
struct LensInterface {
  float curvature_radius;  ///< positive: the centre lies towards the film; 0: flat
  float thickness;         ///< along the axis to the next interface; of no meaning in the last row
  float eta;               ///< refractive index behind it, towards the film
  float aperture_diameter; ///< of the clear opening
  bool operator==(const LensInterface&) const = default;
};

struct LensPrescription {
  std::string_view key; ///< of the settings, as "double_gauss"
  std::string_view name;
  std::string_view source;
  float table_focal_length; ///< millimetres, of the table as it stands, as its source states it
  float focal_length;       ///< millimetres, to which it is scaled where nothing else is asked for
  std::span<const LensInterface> interfaces;
};

} // namespace candela
