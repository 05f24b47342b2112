#pragma once
// The light of the sky.

#include "lights/atmosphere.h"

#include <vector>

namespace candela {

/// The light of one sun in an atmosphere: the sky's radiance, to an observer at sea level. Light that is
/// scattered once has its phase functions; what is scattered again is iterated until it stays, as moments of
/// the radiance over directions up to the second (spherical harmonics) on a grid of heights and of places on
/// the earth, which see the sun at other angles. The part of the aerosol's forward peak that such moments
/// cannot hold counts as light that was not scattered at all (delta-M, Wiscombe 1977), and the first
/// scattering is put right (Nakajima and Tanaka 1988, "Algorithms for radiative intensity calculations in
/// moderately thick atmospheres using a truncation approximation", TMS). Values are relative to the
/// irradiance of the sun outside of the atmosphere.
class AtmosphereLight {
public:
  /// The elevation in radians.
  AtmosphereLight(const Atmosphere& air, double sun_elevation);

  /// What arrives from a direction at or above the horizon, 1/sr: its elevation, and its azimuth from the
  /// sun's.
  void radiance(double elevation, double azimuth_from_sun, SkyBands& out) const;
  /// Of that, what was scattered only once, without the treatment of forward peaks.
  void radiance_scattered_once(double elevation, double azimuth_from_sun, SkyBands& out) const;
  /// Of the sun's light, at sea level: what comes through to a plane that faces it. Nothing where it has set.
  void direct(SkyBands& out) const;

  /// A point of a ray: how far from the earth's middle, and directions relative to the vertical there.
  struct Place {
    double r, mu, sun_mu, sun_cosine; ///< cosines: vertical and ray, vertical and sun, ray and sun
  };
  /// The real spherical harmonics of bands 0, 1 and 2 that are even about the plane of the sun, in the ray's
  /// direction.
  static constexpr std::size_t kMoments = 6;
  static std::array<float, kMoments> harmonics(const Place& at);

private:
  using Moments = std::array<SkyBands, kMoments>; ///< integrals of radiance times the harmonics
  static Place along(const Place& from, double distance);
  double sun_visibility(const Place& at) const;
  void moments_at(const Place& at, Moments& out) const;
  /// What the ray from `from` brings, by the moments so far, without what is scattered once if so told.
  void gather(const Place& from, int steps, bool first_scattering, SkyBands& out, AirColumns& columns) const;
  void ground_radiance(const Place& at, SkyBands& out) const;
  void once(double elevation, double azimuth_from_sun, bool with_forward, SkyBands& out) const;
  Place from_ground(double elevation, double azimuth_from_sun) const;
  Place node(int height, int angle) const;
  void iterate();

  const Atmosphere& air_;
  double sun_elevation_;
  static constexpr int kHeights = 10;
  int angles_;                      ///< a low sun changes fast with its angle
  double first_angle_, angle_step_; ///< zenith angles of the sun in the table
  std::vector<Moments> moments_;    ///< of the light that was scattered
};

} // namespace candela
