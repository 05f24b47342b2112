#pragma once
// The earth's clear atmosphere: how it scatters and absorbs sunlight, by wavelength.

#include "core/math.h"

#include <array>

namespace candela {

/// Bands of 20 nm about 400, 420, ... 700 nm. What humans see outside of them is less than 1 %.
inline constexpr int kSkyBands = 16;
using SkyBands = std::array<float, kSkyBands>;
constexpr double sky_band_nanometres(int band) { return 400 + 20.0 * band; }

/// The sun's irradiance at the mean distance of the earth, outside of the atmosphere, W/(m^2 nm).
const SkyBands& extraterrestrial_irradiance();

/// Amounts of what lies along a path: as lengths, in metres, of matter as dense as it is at sea level (ozone:
/// at its peak).
struct AirColumns {
  double molecules = 0, aerosol = 0, ozone = 0;
};

/// Molecules and aerosol that thin out exponentially, and a layer of ozone, about a spherical earth: the
/// model of Bruneton and Neyret 2008, "Precomputed Atmospheric Scattering", with the ozone of Bruneton 2017
/// ("A Qualitative and Quantitative Evaluation of 8 Clear Sky Models"). Refraction is left out.
class Atmosphere {
public:
  static constexpr double kGround = 6360e3, kTop = 6420e3; ///< radii, m
  static constexpr double kMoleculeHeight = 8000, kAerosolHeight = 1200;
  static constexpr double kOzoneMiddle = 25e3, kOzoneHalfWidth = 15e3;
  static constexpr float kAsymmetry = 0.76f;    ///< of aerosol
  static constexpr float kAerosolAlbedo = 0.9f; ///< of single scattering

  /// Turbidity: the optical thickness of all the air over that of its molecules alone, at 550 nm (McCartney
  /// 1976): 2 on a clear day, 6 in haze. Ozone in Dobson units.
  Atmosphere(float turbidity, float ozone_dobson, float ground_albedo);

  // Coefficients at sea level, 1/m; of ozone at its peak.
  SkyBands molecule_scattering{}, aerosol_scattering{}, aerosol_extinction{}, ozone_absorption{};
  float ground_albedo;

  /// Relative to sea level, and to the peak of ozone, at a height above it.
  static AirColumns densities(double height);
  static float molecule_phase(float cosine); ///< Rayleigh, 1/sr
  static float aerosol_phase(float cosine);  ///< Cornette and Shanks 1992, 1/sr

  /// From a distance r of the earth's middle to the top, along directions whose cosine to the vertical is mu;
  /// the ray must not meet the ground. From a table that is made once.
  static AirColumns columns_to_top(double r, double mu);
  /// exp(-optical thickness).
  void transmittance(const AirColumns& columns, SkyBands& out) const;
  /// Without what the aerosol scatters forwards: its delta part.
  void transmittance_with_forward(const AirColumns& columns, SkyBands& out) const;
  /// Legendre moments 0 to 2 of the phase functions; of the aerosol's without its delta part, which is
  /// `forward` of what it scatters.
  static constexpr std::array<float, 3> kMoleculeMoments = {1, 0, 0.1f};
  std::array<float, 3> aerosol_moments{};
  float forward = 0;
  /// Whether the ground is in the way.
  static bool meets_ground(double r, double mu) {
    return mu < 0 && r * r * (1 - mu * mu) < kGround * kGround;
  }

private:
  void transmittance(const AirColumns& columns, const SkyBands& aerosol, SkyBands& out) const;

  SkyBands aerosol_without_forward_{}; ///< extinction
};

} // namespace candela
