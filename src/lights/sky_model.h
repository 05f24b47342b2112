#pragma once
// The sun and a clear sky.

#include "core/progress.h"
#include "core/spectrum.h"
#include "lights/panorama.h"
#include "sampling/warp.h"

#include <memory>

namespace candela {

/// Luminances over this many lm/W are given as radiances: the efficacy of daylight under a clear sky
/// (Littlefair 1985, "The Luminous Efficacy of Daylight: a Review", 105 to 115 lm/W), so that a surface that
/// the eye finds as bright receives about the W/m^2 of all wavelengths that a pyranometer reads.
inline constexpr double kDaylightEfficacy = 110;

struct SkyParameters {
  float sun_elevation = radians(45); ///< radians above the horizon
  float sun_azimuth = radians(180);  ///< radians from north (-z) by east (+x)
  float turbidity = 2;               ///< 1: no haze, 2: clear, 6: hazy (lights/atmosphere.h)
  float ground_albedo = 0.2f;
  float ozone = 300;      ///< Dobson units
  float sun_distance = 1; ///< astronomical units
  int width = 256;        ///< of the panorama; its height is half of it
  bool operator==(const SkyParameters&) const = default;
};

/// The disc of the sun, with its limb darkening: radiance falls from the middle to the limb as a power of the
/// cosine to the sun's surface (Hestroffer and Magnan 1998, "Wavelength dependency of the Solar limb
/// darkening", power -0.023 + 0.292 um / wavelength, here at the dominant wavelengths of the primaries).
struct SunDisc {
  vec3 direction{0, 1, 0}; ///< unit, towards the sun
  Spectrum irradiance{0};  ///< W/m^2 on a plane that faces it; what the air lets through
  static constexpr float kAngularDiameter = radians(0.53f);
  static constexpr Spectrum kLimbPower{0.455f, 0.509f, 0.606f}; ///< at 611, 549 and 464 nm

  /// W/(m^2 sr) from the unit direction w; 0 outside of the disc.
  Spectrum radiance(vec3 w) const {
    const vec3 apart = w - direction; // |apart|^2 = 2 (1 - cos), with all its digits
    const float share = 0.5f * length_squared(apart) / one_minus_cos_max();
    return share < 1 ? radiance_within(share) : Spectrum(0);
  }
  struct Sample {
    vec3 direction;
    Spectrum radiance;
    float pdf; ///< 1/sr
  };
  /// u in [0, 1)^2; uniform over the disc.
  Sample sample(vec2 u) const;
  float pdf(vec3 w) const {
    return 0.5f * length_squared(w - direction) < one_minus_cos_max() ? uniform_cone_pdf(one_minus_cos_max())
                                                                      : 0;
  }
  static float one_minus_cos_max() {
    const float half_sine = std::sin(0.25f * kAngularDiameter);
    return 2 * half_sine * half_sine;
  }

private:
  /// `share` of the disc's solid angle is nearer to its middle.
  Spectrum radiance_within(float share) const {
    const float log_cosine = 0.5f * std::log(std::max(1 - share, 1e-12f));
    // The mean of cosine^p over a disc is 2 / (2 + p).
    const Spectrum profile = (1.0f + 0.5f * kLimbPower) * glm::exp(kLimbPower * log_cosine);
    return irradiance * profile / (2 * kPi * one_minus_cos_max());
  }
};

struct SkyModel {
  /// Latitude and longitude, for EnvironmentMapping::latlong with up = +y; without the sun. Below the horizon
  /// lies the ground: diffuse, lit by sun and sky.
  std::shared_ptr<const Panorama> sky;
  SunDisc sun; ///< black where it has set
};

/// Single and multiple scattering through a spherical atmosphere in sixteen bands of wavelengths, as
/// lights/atmosphere_light.h has it, seen by the CIE 1931 observer. Takes some tenths of a second of one
/// core. Parameters out of range are taken for the next in it. Throws Cancelled soon after `progress`, which
/// may be null, is told to.
SkyModel make_sky(const SkyParameters& parameters, const Progress* progress = nullptr);

/// W/m^2 of a latlong panorama's upper half on a level plane.
Spectrum sky_irradiance(const Image& latlong);

} // namespace candela
