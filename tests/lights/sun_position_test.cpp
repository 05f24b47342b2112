// The sun's place against almanacs and the example of NREL's algorithm.

#include "lights/sun_position.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

TEST(SunPosition, CountsDays) {
  EXPECT_EQ(days_since_2000({2000, 1, 1, 12}), 0);
  // Julian days of Meeus 1998, "Astronomical Algorithms", chapter 7.
  EXPECT_EQ(days_since_2000({1987, 1, 27, 0}) + 2451545, 2446822.5);
  EXPECT_EQ(days_since_2000({1988, 6, 19, 12}) + 2451545, 2447332.0);
  EXPECT_EQ(days_since_2000({1900, 1, 1, 0}) + 2451545, 2415020.5);
  EXPECT_EQ(days_since_2000({2000, 2, 29, 36}), days_since_2000({2000, 3, 1, 12}));
}

TEST(SunPosition, IsThatOfTheExampleOfNrel) {
  // Reda and Andreas 2004, "Solar Position Algorithm for Solar Radiation Applications", table A5.1: Golden,
  // Colorado, 17 October 2003, 12:30:30 at UT - 7 hours.
  const SunPosition sun = sun_position({2003, 10, 17, 12.508333 + 7}, {39.742476, -105.1786});
  EXPECT_NEAR(sun.right_ascension / kRadiansPerDegree, 202.22704, 0.02);
  EXPECT_NEAR(sun.declination / kRadiansPerDegree, -9.31434, 0.01);
  EXPECT_NEAR(sun.azimuth / kRadiansPerDegree, 194.34024, 0.02);
  EXPECT_NEAR(sun.elevation / kRadiansPerDegree, 39.872046, 0.01);
  EXPECT_NEAR((sun.elevation + atmospheric_refraction(sun.elevation)) / kRadiansPerDegree, 39.888378, 0.01);
  EXPECT_NEAR(sun.distance, 0.9965423, 1e-4);
}

TEST(SunPosition, IsThatOfAlmanacs) {
  // Meeus 1998, example 25.a: 13 October 1992, 0 h.
  const SunPosition meeus = sun_position({1992, 10, 13, 0}, {});
  EXPECT_NEAR(meeus.right_ascension / kRadiansPerDegree, 198.38083, 0.01);
  EXPECT_NEAR(meeus.declination / kRadiansPerDegree, -7.78507, 0.01);
  EXPECT_NEAR(meeus.distance, 0.99766, 1e-4);
  // Equinox and solstices of 2024 (US Naval Observatory): 20 March 3:06, 20 June 20:51, 21 December 9:21.
  EXPECT_NEAR(sun_position({2024, 3, 20, 3.1}, {}).declination / kRadiansPerDegree, 0, 0.01);
  EXPECT_NEAR(sun_position({2024, 6, 20, 20.85}, {}).declination / kRadiansPerDegree, 23.437, 0.01);
  EXPECT_NEAR(sun_position({2024, 6, 20, 20.85}, {}).right_ascension / kRadiansPerDegree, 90, 0.02);
  EXPECT_NEAR(sun_position({2024, 12, 21, 9.35}, {}).declination / kRadiansPerDegree, -23.437, 0.01);
  // Perihelion 3 January 2024, aphelion 5 July 2024.
  EXPECT_NEAR(sun_position({2024, 1, 3, 1}, {}).distance, 0.98331, 1e-4);
  EXPECT_NEAR(sun_position({2024, 7, 5, 5}, {}).distance, 1.01673, 1e-4);
}

TEST(SunPosition, OfDaysAndPlaces) {
  // Greenwich: the equation of time is -14.2 minutes in mid February and 16.4 at the start of November.
  for (auto [month, day, minutes] : {std::tuple{2, 11, -14.2}, {11, 3, 16.45}, {4, 15, 0.0}, {6, 13, 0.0}}) {
    const double noon = 12 - minutes / 60;
    const SunPosition sun = sun_position({2024, month, day, noon}, {51.48, 0});
    EXPECT_NEAR(sun.azimuth / kRadiansPerDegree, 180, 0.15) << month;
    EXPECT_NEAR(sun.elevation, 90 * kRadiansPerDegree - 51.48 * kRadiansPerDegree + sun.declination, 1e-4)
        << month;
  }
  // Mornings are in the east, evenings in the west, on both sides of the equator; at noon the sun is in the
  // north of Sydney.
  for (double latitude : {50.0, -33.87}) {
    EXPECT_NEAR(sun_position({2024, 3, 20, 6.1}, {latitude, 0}).azimuth / kRadiansPerDegree, 90, 1.5);
    EXPECT_NEAR(sun_position({2024, 3, 20, 18.1}, {latitude, 0}).azimuth / kRadiansPerDegree, 270, 1.5);
  }
  EXPECT_NEAR(std::cos(sun_position({2024, 3, 20, 12.12 - 151.2 / 15}, {-33.87, 151.2}).azimuth), 1, 1e-3);
  // The pole: as high as the declination, all day.
  for (double hour : {0.0, 6.0, 17.0})
    EXPECT_NEAR(sun_position({2024, 6, 20, hour}, {90, 0}).elevation / kRadiansPerDegree, 23.436, 0.01);
}

TEST(SunPosition, Refraction) {
  // Bennett's and Saemundsson's values: 28.98' at the true horizon, 1.0' at 45 degrees, none in the zenith.
  EXPECT_NEAR(atmospheric_refraction(0) / kRadiansPerDegree * 60, 28.98, 0.2);
  EXPECT_NEAR(atmospheric_refraction(45 * kRadiansPerDegree) / kRadiansPerDegree * 60, 1.0, 0.03);
  EXPECT_NEAR(atmospheric_refraction(90 * kRadiansPerDegree) / kRadiansPerDegree * 60, 0, 0.02);
}

TEST(SunPosition, DirectionsOfTheWorld) {
  auto near = [](vec3 a, vec3 b) { return glm::length(a - b) < 1e-6f; };
  EXPECT_PRED2(near, sky_direction(0, 0), vec3(0, 0, -1)) << "north";
  EXPECT_PRED2(near, sky_direction(0, 90 * kRadiansPerDegree), vec3(1, 0, 0)) << "east";
  EXPECT_PRED2(near, sky_direction(90 * kRadiansPerDegree, 1), vec3(0, 1, 0)) << "up";
}

} // namespace
} // namespace candela
