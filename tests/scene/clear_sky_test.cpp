#include "scene/clear_sky.h"

#include <gtest/gtest.h>

#include <numbers>

namespace candela {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

double luminance_of(vec3 c) { return glm::dot(glm::dvec3(c), glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// Elevation and azimuth to the right of the middle of a pixel's centre, radians.
glm::dvec2 angles(const Image& image, int x, int y) {
  return {(0.5 - (y + 0.5) / image.height) * std::numbers::pi, ((x + 0.5) / image.width - 0.5) * kTau};
}

double solid_angle(const Image& image, int y) {
  return kTau / image.width *
         (std::sin(angles(image, 0, y).x + 0.5 * std::numbers::pi / image.height) -
          std::sin(angles(image, 0, y).x - 0.5 * std::numbers::pi / image.height));
}

TEST(ClearSky, IsFiniteAndOfLuminanceOneAtTheZenith) {
  const Image image = clear_sky_panorama({}, 256, 128, 2);
  ASSERT_EQ(image.pixels.size(), 256u * 128);
  for (vec3 p : image.pixels) ASSERT_TRUE(is_finite(p) && min_component(p) >= 0);
  for (int x = 0; x < image.width; x += 16) EXPECT_NEAR(luminance_of(image.at(x, 0)), 1, 0.02);
}

TEST(ClearSky, TheSunIsWhereItWasPutAndSendsAsMuchWhateverItsSize) {
  for (const auto& [elevation, azimuth, radius] : {std::array{0.4, -1.1, 0.02}, std::array{0.9, 2.0, 0.05}}) {
    ClearSky sky;
    sky.sun_elevation = elevation;
    sky.sun_azimuth = azimuth;
    sky.sun_radius = radius;
    const Image image = clear_sky_panorama(sky, 1024, 512, 3);
    double power = 0;
    glm::dvec2 center(0);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double l = luminance_of(image.at(x, y));
        if (l < 100) continue; // the sky alone is much darker
        power += l * solid_angle(image, y);
        center += angles(image, x, y) * l * solid_angle(image, y);
      }
    EXPECT_NEAR(power, 21, 0.8); // as much as 21 sr of the zenith's luminance
    EXPECT_NEAR(center.x / power, elevation, 0.003);
    EXPECT_NEAR(center.y / power, azimuth, 0.003);
  }
}

TEST(ClearSky, GroundLiesBelowTheHorizon) {
  ClearSky sky;
  sky.ground = {0.5, 0.25, 0.125};
  const Image image = clear_sky_panorama(sky, 64, 32, 1);
  for (int x = 0; x < 64; ++x)
    for (int y = 16; y < 32; ++y) {
      const vec3 p = image.at(x, y);
      EXPECT_NEAR(p.x, 2 * p.y, 1e-6);
      EXPECT_NEAR(p.y, 2 * p.z, 1e-6);
      EXPECT_LE(p.x, 0.5f);
    }
}

} // namespace
} // namespace candela
