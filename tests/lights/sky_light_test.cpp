// The sun and the sky as lights.

#include "core/color_matching.h"
#include "lights/light_testing.h"
#include "lights/sun_position.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

using namespace test;

struct MadeSky {
  LightDesc desc;
  std::shared_ptr<KeptResources> kept = std::make_shared<KeptResources>();
  std::vector<Light> lights;
};
MadeSky made_sky(const SkyLightModel& model, vec3 color = vec3(1)) {
  MadeSky m;
  m.desc.model = model;
  m.desc.color = color;
  m.lights = make_lights(m.desc, m.kept->resources());
  return m;
}
SkyLightModel small_sky() { return {.resolution = 64}; }

TEST(SkyLight, IsAPanoramaAndTheSunThatTurnTogether) {
  const vec3 color(1, 2, 0.5f);
  for (float rotation : {0.0f, 70.0f})
    for (vec3 up : {vec3(0, 1, 0), vec3(0, 0, 3)}) {
      SkyLightModel model = small_sky();
      model.sun_elevation = radians(35.0f), model.sun_azimuth = radians(100.0f);
      model.rotation = radians(rotation), model.up = up;
      const MadeSky m = made_sky(model, color);
      ASSERT_EQ(m.lights.size(), 2u);
      const auto& sky = std::get<EnvironmentLight>(m.lights[0]);
      const auto& sun = std::get<SunLight>(m.lights[1]);
      // A rotation that is counter-clockwise as seen from above takes azimuths back.
      const SkyModel alone = make_sky(sky_parameters(model));
      vec3 d = sky_direction(radians(35.0), radians(100.0 - static_cast<double>(rotation)));
      if (up.z > 0) d = {d.x, -d.z, d.y}; // y to z by a quarter turn about x
      EXPECT_LT(glm::length(sun.disc.direction - d), 1e-5f);
      EXPECT_LT(glm::length(sun.disc.irradiance - color * alone.sun.irradiance),
                1e-3f * glm::length(sun.disc.irradiance));
      // The sky is brightest about its sun, to within a texel.
      auto random = fresh_random(6);
      const float at_sun = luminance(sky.radiance_from(d));
      for (int i = 0; i < 1000; ++i) {
        const vec3 other = random_direction(random);
        if (glm::dot(other, d) > std::cos(radians(12.0f))) continue;
        EXPECT_GT(at_sun, luminance(sky.radiance_from(other)));
      }
    }
}

TEST(SkyLight, KnowsWhereTheSunStandsByPlaceAndTime) {
  SkyLightModel model = small_sky();
  model.sun_by = SunPlacement::place;
  model.latitude = radians(48.2f), model.longitude = radians(16.4f);
  model.year = 2024, model.month = 6, model.day = 20, model.hour = 10.925f; // true noon in Vienna
  const SkyParameters noon = sky_parameters(model);
  EXPECT_NEAR(degrees(noon.sun_elevation), 90 - 48.2 + 23.44, 0.05);
  EXPECT_NEAR(degrees(noon.sun_azimuth), 180, 1);
  EXPECT_NEAR(noon.sun_distance, 1.0162, 1e-3) << "near its farthest";
  // The angles are not asked.
  model.sun_elevation = -1;
  EXPECT_EQ(sky_parameters(model), noon);
  // Near the horizon refraction lifts it by half a degree.
  model.hour = 18.95f;
  const SunPosition low = sun_position({2024, 6, 20, static_cast<double>(model.hour)}, {48.2, 16.4});
  EXPECT_NEAR(low.elevation, 0, radians(1.0));
  EXPECT_NEAR(static_cast<double>(sky_parameters(model).sun_elevation) - low.elevation, radians(0.48),
              radians(0.12));
  // At midnight it is dark: no sun, and hardly a sky.
  model.hour = 23;
  const MadeSky night = made_sky(model);
  ASSERT_EQ(night.lights.size(), 1u);
  EXPECT_LT(light_power(night.lights[0], 1), 1e-3f);
}

TEST(SkyLight, SunScaleIsOfTheSunAlone) {
  SkyLightModel model = small_sky();
  const MadeSky whole = made_sky(model);
  model.sun_scale = 0.25f;
  const MadeSky faint = made_sky(model);
  model.sun_scale = 0;
  EXPECT_EQ(made_sky(model).lights.size(), 1u);
  EXPECT_NEAR(light_power(faint.lights[1], 1) / light_power(whole.lights[1], 1), 0.25, 1e-5);
  EXPECT_EQ(light_power(faint.lights[0], 1), light_power(whole.lights[0], 1));
}

TEST(SunLight, SamplesItsDiscWithItsDensity) {
  const MadeSky m = made_sky(small_sky());
  const auto& sun = std::get<SunLight>(m.lights[1]);
  auto random = fresh_random(7);
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> uniform(0, 1);
  LightSamplingContext ctx;
  RunningStatistics irradiance, half;
  // Directions about the sun, uniform in a cone twice as wide: pdf and radiance integrate to 1 and the
  // irradiance there.
  RunningStatistics density, brute;
  const float wide = 4 * SunDisc::one_minus_cos_max();
  const vec3 z = sun.disc.direction, x = glm::normalize(glm::cross(z, vec3(0, 1, 0))), y = glm::cross(z, x);
  for (int i = 0; i < 200000; ++i) {
    const auto s = sun.sample(
        ctx, {std::min(uniform(random), kOneMinusEpsilon), std::min(uniform(random), kOneMinusEpsilon)});
    ASSERT_TRUE(s && s->infinite && !s->delta);
    const float down_here = 0.5f * length_squared(s->direction - sun.disc.direction);
    const bool at_the_rim = down_here > 0.999f * SunDisc::one_minus_cos_max(); // rounding takes some out
    ASSERT_EQ(at_the_rim ? s->pdf : sun.pdf(ctx, {}, s->direction), s->pdf);
    irradiance.add(static_cast<double>(s->radiance.y / s->pdf));
    half.add(glm::dot(s->direction, x) > 0 ? 1 : 0);
    const float down = wide * uniform(random), phi = 2 * kPi * uniform(random);
    const float sine = std::sqrt(down * (2 - down));
    const vec3 d = glm::normalize((1 - down) * z + sine * (std::cos(phi) * x + std::sin(phi) * y));
    const double solid_angle = 2 * std::numbers::pi * static_cast<double>(wide);
    density.add(solid_angle * static_cast<double>(sun.pdf(ctx, {}, d)));
    brute.add(solid_angle * static_cast<double>(sun.radiance_from(d).y));
  }
  const double expected = static_cast<double>(sun.disc.irradiance.y), threshold = sidak_threshold(4);
  EXPECT_GT(z_test(irradiance, expected), threshold);
  EXPECT_GT(z_test(brute, expected), threshold);
  EXPECT_GT(z_test(density, 1), threshold);
  EXPECT_GT(z_test(half, 0.5), threshold);
  EXPECT_NEAR(sun.mean_irradiance(EnvironmentDensity::full),
              0.25 * static_cast<double>(luminance(sun.disc.irradiance)), 1e-3);
}

TEST(SkyLight, SharesTheLightBetweenSunAndSkyAsMitsubaDoes) {
  // Mitsuba 3.9.1, scalar_rgb: sunsky (Hosek and Wilkie 2012 and 2013) of turbidity 2 and albedo 0.2, what
  // sun and sky send to a level plane; and the red and the blue of the sun's disc over its luminance. Its
  // colours come from spectra of other years and observers than ours.
  struct Case {
    float elevation;
    double ratio, red, blue, tolerance;
  };
  for (const Case& c :
       {Case{60, 5.37, 1.164, 0.751, 0.06}, {30, 3.24, 1.227, 0.644, 0.09}, {10, 1.07, 1.503, 0.326, 0.25}}) {
    SCOPED_TRACE(c.elevation);
    const SkyModel sky = make_sky(
        {.sun_elevation = radians(c.elevation), .turbidity = 2, .ground_albedo = 0.2f, .width = 128});
    const double sine = std::sin(static_cast<double>(radians(c.elevation)));
    const double sun = static_cast<double>(luminance(sky.sun.irradiance));
    const double ratio = sun * sine / static_cast<double>(luminance(sky_irradiance(sky.sky->image)));
    EXPECT_NEAR(ratio / c.ratio, 1, c.tolerance);
    EXPECT_NEAR(static_cast<double>(sky.sun.irradiance.x) / sun / c.red, 1, c.tolerance);
    EXPECT_NEAR(static_cast<double>(sky.sun.irradiance.z) / sun / c.blue, 1, c.tolerance);
  }
}

TEST(Temperatures, ColourLightsAtTheirLuminance) {
  LightDesc light;
  light.color = vec3(1), light.scale = 2;
  const Spectrum white = light_color(light);
  EXPECT_EQ(white, vec3(2));
  light.temperature = 2856; // CIE standard illuminant A: x = 0.44758, y = 0.40745
  const Spectrum warm = light_color(light);
  EXPECT_NEAR(luminance(warm), 2, 1e-5);
  const glm::dvec3 xyz(0.44758 / 0.40745, 1, (1 - 0.44758 - 0.40745) / 0.40745);
  const glm::dvec3 expected = 2.0 * rec709_from_xyz(xyz);
  // The colour matching functions are a fit, to 2e-3 in x and y.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(warm[c]), expected[c], 0.02 * 2) << c;
  light.temperature = 6504; // near D65's white
  const Spectrum day = light_color(light);
  EXPECT_NEAR(day.x / day.z, 1, 0.05);
  light.temperature = 100;
  const Spectrum cold = light_color(light);
  light.temperature = 800;
  EXPECT_EQ(cold, light_color(light));
}

} // namespace
} // namespace candela
