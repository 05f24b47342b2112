// Point and spot lights that photometric files and pictures shape.

#include "lights/light_testing.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

using namespace test;

/// Brighter downwards, and different in all four quarters.
std::shared_ptr<const IesProfile> profile(float lowest = 0, float highest = 90) {
  auto p = std::make_shared<IesProfile>();
  p->name = "lamp.ies";
  for (float t : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f})
    p->vertical.push_back(radians(glm::mix(lowest, highest, t)));
  for (float turn : {0.0f, 90.0f, 180.0f, 270.0f, 360.0f}) p->horizontal.push_back(radians(turn));
  for (float quarter : {1.0f, 2.0f, 3.0f, 4.0f, 1.0f})
    for (float v : {500.0f, 400.0f, 250.0f, 120.0f, 60.0f}) p->candela.push_back(v * quarter);
  for (std::size_t i = 0; i < p->candela.size(); i += p->vertical.size())
    p->candela[i] = 500; // the pole is one
  return p;
}

std::shared_ptr<const Panorama> picture(int width = 64) {
  auto p = std::make_shared<Panorama>();
  p->name = "lamp.exr";
  p->image = {width, width / 2, {}};
  for (int y = 0; y < width / 2; ++y)
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      const float v = (static_cast<float>(y) + 0.5f) / (0.5f * static_cast<float>(width));
      p->image.pixels.push_back(vec3(2, 3, 1) * std::max(v - 0.25f, 0.0f) * (1.5f + std::sin(2 * kPi * u)));
    }
  return p;
}

struct Made {
  LightDesc desc;
  std::shared_ptr<KeptResources> kept = std::make_shared<KeptResources>();
  GoniometricLight light;
};
Made made(LightDescModel model, vec3 color = vec3(1)) {
  Made m;
  m.desc.model = std::move(model);
  m.desc.color = color;
  m.light = std::get<GoniometricLight>(make_lights(m.desc, m.kept->resources()).at(0));
  return m;
}

TEST(GoniometricLight, WithoutAFileLightsAreWhatTheyWere) {
  KeptResources kept;
  LightDesc light;
  EXPECT_TRUE(std::holds_alternative<PointLight>(make_lights(light, kept.resources()).at(0)));
  light.model = SpotLightModel{};
  EXPECT_TRUE(std::holds_alternative<SpotLight>(make_lights(light, kept.resources()).at(0)));
}

TEST(GoniometricLight, HangsDownwardsAndTurnsWithDirectionAndRoll) {
  const auto file = profile();
  auto towards = [](float vertical, float horizontal) { // type C of a lamp that hangs: +x, then -z
    const float v = radians(vertical), h = radians(horizontal);
    return vec3(std::sin(v) * std::cos(h), -std::cos(v), -std::sin(v) * std::sin(h));
  };
  const float watts = static_cast<float>(1 / kDaylightEfficacy);
  const Made hanging = made(PointLightModel{.profile = file}, {1, 2, 3});
  // Nodes of the file, off the poles.
  EXPECT_NEAR(hanging.light.intensity(towards(22.5f, 0)).x / (400 * watts), 1, 1e-5);
  EXPECT_NEAR(hanging.light.intensity(towards(22.5f, 90)).y / (2 * 800 * watts), 1, 1e-5);
  EXPECT_NEAR(hanging.light.intensity(towards(45, 180)).z / (3 * 750 * watts), 1, 1e-5);
  EXPECT_NEAR(hanging.light.intensity(towards(67.5f, 270)).x / (480 * watts), 1, 1e-5);
  EXPECT_NEAR(hanging.light.intensity(towards(0, 0)).x / (500 * watts), 1, 1e-5);
  EXPECT_EQ(hanging.light.intensity(towards(91, 10)), Spectrum(0)) << "nothing above the horizon";
  // A roll turns it counter-clockwise as seen from above: from +x towards -z.
  const Made rolled = made(PointLightModel{.roll = radians(90.0f), .profile = file});
  EXPECT_NEAR(rolled.light.intensity(towards(22.5f, 90)).x / (400 * watts), 1, 1e-4);
  EXPECT_NEAR(rolled.light.intensity(towards(22.5f, 180)).x / (800 * watts), 1, 1e-4);
  // Along +x by the turn about z that takes -y there: +x goes to +y, and z stays.
  const Made aside = made(PointLightModel{.direction = {3, 0, 0}, .profile = file});
  for (float h : {0.0f, 30.0f, 200.0f, 290.0f}) {
    const vec3 d = towards(40, h), turned(-d.y, d.x, d.z);
    EXPECT_NEAR(aside.light.intensity(turned).x / hanging.light.intensity(d).x, 1, 1e-4) << h;
  }
}

TEST(GoniometricLight, SendsItsIntensityOverTheSquareOfTheDistance) {
  auto random = fresh_random(1);
  SCOPED_TRACE(seed_note());
  for (vec3 attenuation : {vec3(0, 0, 1), vec3(1, 0.5f, 2)}) {
    const Made m =
        made(PointLightModel{.position = {1, 2, 3}, .attenuation = attenuation, .profile = profile()});
    for (int i = 0; i < 100; ++i) {
      const vec3 d = random_direction(random);
      const float r = 0.5f + static_cast<float>(i) * 0.1f;
      LightSamplingContext ctx;
      ctx.position = m.light.position + r * d;
      const auto s = m.light.sample(ctx, vec2(0));
      const Spectrum sent = m.light.intensity(d);
      ASSERT_EQ(s.has_value(), !is_black(sent));
      if (!s) continue;
      EXPECT_TRUE(s->delta);
      EXPECT_EQ(s->pdf, 1);
      EXPECT_NEAR(glm::dot(s->direction, d), -1, 1e-5f);
      const float by = attenuation.x + attenuation.y * r + attenuation.z * r * r;
      EXPECT_NEAR(s->radiance.x * by / sent.x, 1, 2e-3f) << "rounding moves the angle";
    }
    LightSamplingContext on_it;
    on_it.position = m.light.position;
    EXPECT_FALSE(m.light.sample(on_it, vec2(0)));
  }
}

/// All kinds with what their files give.
std::vector<std::pair<const char*, Made>> kinds(ProfileStrength strength) {
  const vec3 color(0.5f, 2, 1), direction(1, -2, 0.5f);
  std::vector<std::pair<const char*, Made>> all;
  all.emplace_back(
      "point",
      made(PointLightModel{.direction = direction, .roll = 1, .strength = strength, .profile = profile()},
           color));
  all.emplace_back("point, all around",
                   made(PointLightModel{.strength = strength, .profile = profile(0, 180)}, color));
  all.emplace_back("spot", made(SpotLightModel{.direction = direction,
                                               .cutoff_angle = radians(50.0f),
                                               .beam_width = radians(20.0f),
                                               .roll = 2,
                                               .strength = strength,
                                               .profile = profile()},
                                color));
  all.emplace_back("spot, sharp and wide", made(SpotLightModel{.cutoff_angle = radians(120.0f),
                                                               .beam_width = radians(130.0f),
                                                               .strength = strength,
                                                               .profile = profile(0, 180)},
                                                color));
  all.emplace_back(
      "picture",
      made(PointLightModel{.direction = direction, .strength = strength, .panorama = picture(256)}, color));
  return all;
}

TEST(GoniometricLight, ItsPowerIsTheIntegralOfItsIntensity) {
  for (ProfileStrength strength : {ProfileStrength::file, ProfileStrength::peak, ProfileStrength::power})
    for (const auto& [name, m] : kinds(strength)) {
      SCOPED_TRACE(name);
      const double power =
          integral_over_sphere([&, &m = m](vec3 d) { return m.light.intensity(d); }, -m.light.up);
      // Of pictures the sum over texels; luminances of products are those of the factors here.
      double gray = luminance(m.light.factor) > 0 ? power : 0;
      if (m.light.map !=
          nullptr) { // a coloured picture under a coloured factor: the factor alone is compared
        Made white = m;
        white.light.factor = Spectrum(luminance(m.light.factor));
        gray = integral_over_sphere([&](vec3 d) { return white.light.intensity(d); }, -m.light.up);
      }
      EXPECT_NEAR(static_cast<double>(m.light.power(1)) / gray, 1, 1e-3);
    }
}

TEST(GoniometricLight, StrengthIsOfTheFileThePeakOrThePower) {
  const vec3 color(0.5f, 2, 1);
  for (const auto& [name, m] : kinds(ProfileStrength::power))
    if (m.light.map == nullptr) {
      const double power =
          integral_over_sphere([&, &m = m](vec3 d) { return m.light.intensity(d); }, -m.light.up);
      EXPECT_NEAR(power / static_cast<double>(luminance(color)), 1, 1e-3) << name;
    }
  const Made peak = made(PointLightModel{.strength = ProfileStrength::peak, .profile = profile()}, color);
  float most = 0;
  auto random = fresh_random(2);
  for (int i = 0; i < 200000; ++i) most = std::max(most, peak.light.intensity(random_direction(random)).y);
  EXPECT_LE(most, 2 * (1 + 1e-5f));
  EXPECT_GT(most, 2 * 0.98f) << seed_note();
  const Made raw = made(PointLightModel{.panorama = picture()}, color);
  // The last row's centre is near the nadir; its columns are at azimuths of their own.
  const Image& image =
      raw.desc.model.index() == 0 ? std::get<PointLightModel>(raw.desc.model).panorama->image : Image{};
  const int x = 11, y = 25;
  const float u = (static_cast<float>(x) + 0.5f) / 64, v = (static_cast<float>(y) + 0.5f) / 32;
  const vec3 d(std::sin(kPi * v) * std::sin(2 * kPi * u), std::cos(kPi * v),
               -std::sin(kPi * v) * std::cos(2 * kPi * u));
  const Spectrum seen = raw.light.intensity(d), expected = color * image.at(x, y);
  EXPECT_NEAR(seen.x / expected.x, 1, 1e-3);
  EXPECT_NEAR(seen.z / expected.z, 1, 1e-3);
}

TEST(GoniometricLight, TheFluxOfTheFileIsItsLumens) {
  // A disc that emits by Lambert's law: of 1000 lm it sends 1000 / pi candela along its axis.
  auto p = std::make_shared<IesProfile>();
  for (int i = 0; i <= 90; ++i) {
    p->vertical.push_back(radians(static_cast<float>(i)));
    p->candela.push_back(1000 * kInvPi * std::cos(p->vertical.back()));
  }
  p->horizontal = {0};
  const Made m = made(PointLightModel{.profile = p});
  EXPECT_NEAR(static_cast<double>(m.light.power(1)) * kDaylightEfficacy, 1000, 0.2);
  // Cut to 30 degrees it keeps the square of the sine of it.
  const Made cut =
      made(SpotLightModel{.cutoff_angle = radians(30.0f), .beam_width = radians(30.0f), .profile = p});
  EXPECT_NEAR(static_cast<double>(cut.light.power(1)) * kDaylightEfficacy, 250, 0.2);
}

TEST(GoniometricLight, BoundsHoldAllItsLight) {
  auto random = fresh_random(3);
  SCOPED_TRACE(seed_note());
  auto fading = std::make_shared<IesProfile>();
  fading->vertical = {0, radians(30.0f), radians(60.0f)}, fading->horizontal = {0},
  fading->candela = {500, 200, 0};
  auto all = kinds(ProfileStrength::file);
  all.emplace_back("to nothing", made(PointLightModel{.profile = fading}));
  for (const auto& [name, m] : all) {
    SCOPED_TRACE(name);
    const auto b = m.light.bounds();
    ASSERT_TRUE(b);
    EXPECT_LE(b->theta_e, kPi / 3 + 1e-5f)
        << "the cosine that the tree expects vanishes where there is light";
    for (int i = 0; i < 20000; ++i) {
      const vec3 d = random_direction(random);
      const Spectrum sent = m.light.intensity(d);
      if (is_black(sent)) continue;
      ASSERT_TRUE(bounds_reach(*b, d)) << d.x << ' ' << d.y << ' ' << d.z;
      if (m.light.map != nullptr) continue; // luminances of products of colours differ
      ASSERT_LE(static_cast<double>(luminance(sent)), b->intensity * (1 + 1e-5));
    }
  }
  EXPECT_LT(made(SpotLightModel{.profile = profile()}).light.bounds()->theta_o, radians(25.0f))
      << "not all around";
  EXPECT_FALSE(made(PointLightModel{.attenuation = {1, 0, 0}, .profile = profile()}).light.bounds());
}

TEST(GoniometricLight, DarkFilesAreDark) {
  auto p = std::make_shared<IesProfile>(*profile());
  std::ranges::fill(p->candela, 0.0f);
  for (ProfileStrength strength : {ProfileStrength::file, ProfileStrength::peak, ProfileStrength::power}) {
    const Made m = made(PointLightModel{.strength = strength, .profile = p});
    EXPECT_EQ(m.light.intensity({0, -1, 0}), Spectrum(0));
    EXPECT_EQ(m.light.power(1), 0);
    EXPECT_EQ(m.light.typical_irradiance(), 0);
  }
}

} // namespace
} // namespace candela
