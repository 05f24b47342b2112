#pragma once
// What goniometers measure of luminaires.

#include "core/math.h"

#include <string>
#include <vector>

namespace candela {

/// Where the axis lies about which a goniometer turned, in the luminaire's own frame: +z is up as it hangs,
/// +x its photometric horizontal. Angles "about" an axis are those of the half planes that end in it.
enum class PhotometricType : int {
  c, ///< vertical angles from -z (nadir), horizontal ones about the z axis from +x towards +y
  a, ///< as c, with horizontal angles from +x towards -y
  b, ///< vertical angles from -x, horizontal ones about the x axis from -z towards -y
};

/// The intensity of a luminaire by direction, in candela (lm/sr), on a grid of angles: bilinear between them,
/// 0 outside of them. Vertical angles are counted from the pole of the type, also of types whose files count
/// from the equator.
struct IesProfile {
  std::string name;   ///< of the file
  std::string source; ///< the file; may be empty
  PhotometricType type = PhotometricType::c;
  std::vector<float> vertical;   ///< radians, ascending, in [0, pi]; at least one
  std::vector<float> horizontal; ///< radians, ascending, at most 2 pi apart; one: the same all around
  std::vector<float>
      candela; ///< finite, not negative: all vertical angles of a horizontal one, then the next
  bool operator==(const IesProfile&) const = default;

  /// Candela in the direction away from the luminaire, of any length, in its own frame.
  float intensity(vec3 direction_local) const;
  /// The same relative to the greatest: for lights whose own intensity, in W/sr, is that of the profile's
  /// maximum. 0 of a profile that is dark.
  float relative_intensity(vec3 direction_local) const;
  float maximum() const;
  /// Over the sphere, lumen: exact for the interpolated intensity.
  double flux() const;
  std::size_t memory_bytes() const {
    return (vertical.size() + horizontal.size() + candela.size()) * sizeof(float);
  }
};

/// What is wrong with its numbers ("its values do not fit its angles"); empty where all is well.
const char* ies_profile_problem(const IesProfile& profile);

} // namespace candela
