#pragma once
// Where the sun stands.

#include "core/math.h"

namespace candela {

/// A moment in universal time, by the Gregorian calendar.
struct CalendarTime {
  int year = 2000, month = 1, day = 1; ///< from 1
  double hour = 12;                    ///< UT, with its fraction; may leave the day
};

/// Degrees: northern latitudes and eastern longitudes are positive.
struct GeographicPlace {
  double latitude = 0, longitude = 0;
};

struct SunPosition {
  double elevation = 0;       ///< radians above the horizon, of its middle, without refraction
  double azimuth = 0;         ///< radians from north, clockwise (east is a quarter turn), in [0, 2 pi)
  double right_ascension = 0; ///< radians, in [0, 2 pi)
  double declination = 0;     ///< radians
  double distance = 1;        ///< astronomical units
};

/// Days since the noon of 1 January 2000, UT.
inline double days_since_2000(const CalendarTime& t) {
  // The day number of the Gregorian calendar (Fliegel and van Flandern 1968).
  const int a = (14 - t.month) / 12, y = t.year + 4800 - a, m = t.month + 12 * a - 3;
  const int julian = t.day + (153 * m + 2) / 5 + 365 * y + y / 4 - y / 100 + y / 400 - 32045;
  return julian - 2451545 + (t.hour - 12) / 24;
}

/// By the short formulas of the Astronomical Almanac (Michalsky 1988, "The Astronomical Almanac's Algorithm
/// for Approximate Solar Position"): to 0.01 degrees from 1950 to 2050.
inline SunPosition sun_position(const CalendarTime& time, const GeographicPlace& place) {
  constexpr double kDegree = std::numbers::pi / 180, kTurn = 2 * std::numbers::pi;
  auto in_turn = [](double x) { return x - kTurn * std::floor(x / kTurn); };
  const double n = days_since_2000(time);
  const double mean_longitude = 280.460 + 0.9856474 * n, anomaly = (357.528 + 0.9856003 * n) * kDegree;
  const double longitude =
      (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * kDegree;
  const double obliquity = (23.439 - 4e-7 * n) * kDegree;

  SunPosition sun;
  sun.right_ascension = in_turn(std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)));
  sun.declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  sun.distance = 1.00014 - 0.01671 * std::cos(anomaly) - 0.00014 * std::cos(2 * anomaly);

  // Greenwich mean sidereal time: a day longer a year.
  const double sidereal = (280.460618 + 360.98564737 * n) * kDegree;
  const double hour_angle = sidereal + place.longitude * kDegree - sun.right_ascension;
  const double latitude = place.latitude * kDegree;
  const double east = -std::cos(sun.declination) * std::sin(hour_angle);
  const double north = std::sin(sun.declination) * std::cos(latitude) -
                       std::cos(sun.declination) * std::sin(latitude) * std::cos(hour_angle);
  const double up = std::sin(sun.declination) * std::sin(latitude) +
                    std::cos(sun.declination) * std::cos(latitude) * std::cos(hour_angle);
  sun.elevation = std::atan2(up, std::hypot(east, north));
  sun.azimuth = in_turn(std::atan2(east, north));
  return sun;
}

/// How much higher a body is seen than it stands, radians, at sea level and 10 degrees centigrade
/// (Saemundsson 1986, "Atmospheric Refraction"). For elevations from -1 degree.
inline double atmospheric_refraction(double elevation) {
  const double h = std::max(elevation * 180 / std::numbers::pi, -1.0);
  const double minutes = 1.02 / std::tan((h + 10.3 / (h + 5.11)) * std::numbers::pi / 180);
  return std::max(minutes, 0.0) / 60 * std::numbers::pi / 180;
}

/// Towards an azimuth and an elevation in the world: +y is up, -z north, +x east.
inline vec3 sky_direction(double elevation, double azimuth) {
  return vec3(glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                         -std::cos(elevation) * std::cos(azimuth)));
}

} // namespace candela
