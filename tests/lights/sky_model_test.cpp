// A clear sky against published irradiances, and the sun's disc.

#include "core/color.h"
#include "lights/environment_map.h"
#include "lights/sky_model.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

SkyModel sky(float elevation, float turbidity = 2, float albedo = 0.2f, float azimuth = 180) {
  return make_sky({.sun_elevation = radians(elevation),
                   .sun_azimuth = radians(azimuth),
                   .turbidity = turbidity,
                   .ground_albedo = albedo,
                   .width = 128});
}
double lux(Spectrum s) { return static_cast<double>(luminance(s)) * kDaylightEfficacy; }

TEST(SkyModel, ClearSkiesHavePublishedIrradiances) {
  // Outside of the atmosphere: 133.3 klx (Darula, Kittler and Gueymard 2005).
  const SkyModel high = sky(60), clean = sky(60, 1);
  // Direct normal some 900 to 1000 W/m^2 and diffuse 60 to 150 W/m^2 under a clear high sun (WMO; Duffie and
  // Beckman 2013), 90 to 110 klx and 8 to 17 klx (IESNA).
  EXPECT_GT(luminance(high.sun.irradiance), 880);
  EXPECT_LT(luminance(high.sun.irradiance), 1000);
  EXPECT_GT(luminance(sky_irradiance(high.sky->image)), 60);
  EXPECT_LT(luminance(sky_irradiance(high.sky->image)), 160);
  EXPECT_NEAR(lux(high.sun.irradiance) / 103e3, 1, 0.1);
  EXPECT_LT(lux(clean.sun.irradiance), 133.3e3);
  EXPECT_GT(lux(clean.sun.irradiance), 110e3);
  // The end of civil twilight, at -6 degrees: 3.4 lx (Seidelmann 1992).
  const double dusk = lux(sky_irradiance(sky(-6).sky->image));
  EXPECT_GT(dusk, 1.5);
  EXPECT_LT(dusk, 8);
  // Sunset: 400 to 900 lx (the same).
  const double sunset = lux(sky_irradiance(sky(-0.8f).sky->image));
  EXPECT_GT(sunset, 300);
  EXPECT_LT(sunset, 1200);
}

TEST(SkyModel, EnergyIsConserved) {
  for (float turbidity : {1.0f, 3.0f, 10.0f})
    for (float elevation : {70.0f, 10.0f}) {
      const SkyModel dark = sky(elevation, turbidity, 0), bright = sky(elevation, turbidity, 1);
      const double sine = std::sin(static_cast<double>(radians(elevation)));
      const double outside = 133.3e3 / kDaylightEfficacy * sine;
      const double level = static_cast<double>(luminance(sky_irradiance(dark.sky->image))) +
                           static_cast<double>(luminance(dark.sun.irradiance)) * sine;
      EXPECT_LT(level, 0.97 * outside) << turbidity << ' ' << elevation;
      EXPECT_GT(level, (turbidity < 4 ? 0.4 : 0.1) * outside) << turbidity << ' ' << elevation;
      EXPECT_EQ(dark.sun.irradiance, bright.sun.irradiance);
      EXPECT_GT(luminance(sky_irradiance(bright.sky->image)),
                1.03f * luminance(sky_irradiance(dark.sky->image)))
          << "a bright ground lights the sky";
    }
}

TEST(SkyModel, IsBlueAtNoonAndRedAtDusk) {
  const SkyModel noon = sky(50), dusk = sky(1);
  const Image& day = noon.sky->image;
  const Spectrum zenith = day.at(10, 0), anti = day.at(0, day.height / 4);
  EXPECT_GT(zenith.z, 1.5f * zenith.x);
  EXPECT_GT(anti.z, 1.8f * anti.x);
  EXPECT_LT(day.at(0, day.height / 2 - 1).z / day.at(0, day.height / 2 - 1).x, anti.z / anti.x)
      << "paler at the horizon";
  EXPECT_LT(noon.sun.irradiance.z / noon.sun.irradiance.x, 0.8f) << "a yellowish sun";
  EXPECT_GT(dusk.sun.irradiance.x, 5 * dusk.sun.irradiance.y) << "a red sun";
  const Image& late = dusk.sky->image;
  const Spectrum below_sun = late.at(late.width / 2, late.height / 2 - 3), above = late.at(0, 0);
  EXPECT_GT(below_sun.x, 1.5f * below_sun.z) << "a red horizon";
  EXPECT_GT(above.z, 1.5f * above.x) << "under a blue zenith";
  // Hazier: whiter and brighter sky, dimmer and redder sun.
  const SkyModel haze = sky(50, 6);
  EXPECT_GT(luminance(sky_irradiance(haze.sky->image)), 1.5f * luminance(sky_irradiance(day)));
  EXPECT_LT(luminance(haze.sun.irradiance), 0.8f * luminance(noon.sun.irradiance));
  EXPECT_LT(sky_irradiance(haze.sky->image).z / sky_irradiance(haze.sky->image).x,
            sky_irradiance(day).z / sky_irradiance(day).x);
}

TEST(SkyModel, IsBrightestAroundTheSunAndEvenAboutIt) {
  for (float azimuth : {0.0f, 90.0f, 180.0f, 303.75f}) {
    const SkyModel model = sky(35, 2, 0.2f, azimuth);
    const Image& image = model.sky->image;
    int best_x = 0, best_y = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        EXPECT_TRUE(is_finite(image.at(x, y)) && min_component(image.at(x, y)) >= 0);
        if (luminance(image.at(x, y)) > luminance(image.at(best_x, best_y))) best_x = x, best_y = y;
      }
    auto panorama = std::make_shared<Panorama>(*model.sky);
    const EnvironmentMap map(panorama, EnvironmentMapping::latlong);
    const double u = (best_x + 0.5) / image.width, v = (best_y + 0.5) / image.height;
    const vec3 brightest = vec3(glm::dvec3(
        std::sin(std::numbers::pi * v) * std::sin(2 * std::numbers::pi * u), std::cos(std::numbers::pi * v),
        -std::sin(std::numbers::pi * v) * std::cos(2 * std::numbers::pi * u)));
    EXPECT_LT(glm::length(map.radiance(brightest) - image.at(best_x, best_y)),
              1e-3f * image.at(best_x, best_y).x);
    EXPECT_GT(glm::dot(brightest, model.sun.direction), std::cos(radians(4.0f))) << azimuth;
    // Mirror images about the plane of the sun.
    const vec3 sun_level = glm::normalize(vec3(model.sun.direction.x, 0, model.sun.direction.z));
    const vec3 side = glm::cross(sun_level, vec3(0, 1, 0));
    for (vec3 w : {vec3(0.3f, 0.5f, 0.6f), vec3(-0.7f, 0.1f, 0.2f), vec3(0.1f, 0.9f, -0.3f)}) {
      w = glm::normalize(w);
      const vec3 mirrored = w - 2 * glm::dot(w, side) * side;
      EXPECT_LT(glm::length(map.radiance(w) - map.radiance(mirrored)), 0.02f * glm::length(map.radiance(w)));
    }
  }
}

TEST(SkyModel, GroundReflectsSunAndSky) {
  const SkyModel model = sky(30, 2, 0.5f);
  const Image& image = model.sky->image;
  const Spectrum level = sky_irradiance(image) + model.sun.irradiance * model.sun.direction.y;
  const Spectrum expected = 0.5f * kInvPi * level;
  for (int y = image.height / 2; y < image.height; ++y)
    EXPECT_LT(glm::length(image.at(y, y) - expected), 1e-4f * glm::length(expected));
  Image even{8, 4, std::vector<vec3>(32, vec3(1, 2, 3))};
  EXPECT_LT(glm::length(sky_irradiance(even) - kPi * vec3(1, 2, 3)), 1e-5f);
}

TEST(SkyModel, SunSetsAndItsDistanceCounts) {
  EXPECT_EQ(sky(-1).sun.irradiance, Spectrum(0));
  EXPECT_LT(luminance(sky(-20).sky->image.at(0, 0)), 1e-4f);
  const SkyModel near = make_sky({.sun_distance = 0.5f, .width = 32}),
                 far = make_sky({.sun_distance = 1, .width = 32});
  EXPECT_LT(glm::length(near.sun.irradiance - 4.0f * far.sun.irradiance), 1e-3f * near.sun.irradiance.x);
  EXPECT_LT(glm::length(near.sky->image.at(3, 3) - 4.0f * far.sky->image.at(3, 3)),
            1e-3f * near.sky->image.at(3, 3).z);
  for (float bad : {NAN, INFINITY, -INFINITY, -1e9f, 1e9f}) {
    const SkyModel model = make_sky({bad, bad, bad, bad, bad, bad, 8});
    for (vec3 pixel : model.sky->image.pixels)
      EXPECT_TRUE(is_finite(pixel) && min_component(pixel) >= 0) << bad;
    EXPECT_TRUE(is_finite(model.sun.irradiance) && is_finite(model.sun.direction)) << bad;
  }
  Progress progress;
  progress.cancel();
  EXPECT_THROW(make_sky({}, &progress), Cancelled);
}

TEST(SunDisc, RadianceAddsUpToTheIrradiance) {
  SCOPED_TRACE(test::seed_note());
  SunDisc sun{glm::normalize(vec3(0.3f, 0.5f, -0.4f)), {900, 850, 700}};
  std::mt19937_64 random(test::fresh_seed());
  std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
  glm::dvec3 sum(0);
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const float u = uniform(random);
    const auto s = sun.sample({u, uniform(random)});
    sum += glm::dvec3(s.radiance) / static_cast<double>(s.pdf) / static_cast<double>(n);
    if (i % 100 == 0) {
      EXPECT_NEAR(glm::length(s.direction), 1, 1e-6);
      const float off_middle = glm::length(s.direction - sun.direction);
      EXPECT_LT(off_middle, 1.001f * radians(0.265f));
      if (off_middle < 0.99f * radians(0.265f)) {
        EXPECT_FLOAT_EQ(sun.pdf(s.direction), s.pdf);
        EXPECT_LT(glm::length(sun.radiance(s.direction) - s.radiance), 0.02f * s.radiance.x);
      }
    }
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / static_cast<double>(sun.irradiance[c]), 1, 3e-3) << c;
  // The solid angle is 6.7e-5 sr; the limb is darker and redder (Cox 2000, "Allen's Astrophysical
  // Quantities", section 14.7: about 0.54 of the middle at 550 nm where the cosine is 0.3).
  EXPECT_NEAR(1 / uniform_cone_pdf(SunDisc::one_minus_cos_max()), 6.72e-5, 1e-6);
  const vec3 side = glm::normalize(glm::cross(sun.direction, vec3(0, 1, 0)));
  auto at = [&](float radii) {
    return sun.radiance(glm::normalize(sun.direction + radii * radians(0.265f) * side));
  };
  EXPECT_NEAR(at(std::sqrt(1 - 0.09f)).y / at(0).y, 0.54, 0.03);
  EXPECT_LT(at(0.95f).z / at(0.95f).x, 0.9f * at(0).z / at(0).x);
  EXPECT_EQ(at(1.01f), Spectrum(0));
  EXPECT_EQ(sun.pdf(glm::normalize(sun.direction + 1.01f * radians(0.265f) * side)), 0);
}

} // namespace
} // namespace candela
