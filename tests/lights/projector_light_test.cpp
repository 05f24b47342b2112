// A point that throws a picture.

#include "lights/light_testing.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

using namespace test;

std::shared_ptr<const Panorama> slide() {
  auto p = std::make_shared<Panorama>();
  p->name = "slide.exr";
  p->image = {
      3,
      2,
      {{.1f, .2f, .3f}, {.4f, .9f, .1f}, {.7f, .2f, .6f}, {1, .5f, .25f}, {.05f, .6f, .8f}, {.3f, .3f, .9f}}};
  return p;
}

ProjectorLight made(const ProjectorLightModel& model, Spectrum color = Spectrum(1)) {
  return light_of(model, color, LightResources{});
}

TEST(ProjectorLight, ThrowsAsInMitsuba) {
  // Mitsuba 3.9.1, scalar_rgb: projector with look_at((1, 2, 3), (0.2, 0.5, -1)), fov 40 about y, scale 2,
  // the slide as a raw bitmap with clamped edges: the weight of sample_direction(). There the slide is the
  // radiance of a white screen at the distance 1, here its irradiance: pi times less.
  struct Seen {
    vec3 at;
    glm::dvec3 weight;
  };
  const Seen cases[] = {
      {{0.2f, 0.5f, -1}, {0.07483945786952972, 0.24946483969688416, 0.14967887103557587}},
      {{0.5f, 0.9f, -1}, {0.1330648958683014, 0.25836628675460815, 0.1327671855688095}},
      {{-0.9f, 0.3f, -2}, {0.07167964428663254, 0.12021582573652267, 0.06890010833740234}},
      {{0.6f, 1.9f, -1.2f}, {0.2068874090909958, 0.29212453961372375, 0.10530960559844971}},
      {{1.0f, 0.1f, -1.5f}, {0.08563458919525146, 0.1341886818408966, 0.18789036571979523}},
      {{0.1f, 1.2f, 0.5f}, {0.279433935880661, 0.5095322728157043, 0.2686344385147095}},
      {{-0.5f, -0.6f, -2.2f}, {0.04787561297416687, 0.1105361133813858, 0.09962065517902374}}};
  const auto picture = slide();
  const ProjectorLight light = made({.position = {1, 2, 3},
                                     .direction = vec3(0.2f, 0.5f, -1) - vec3(1, 2, 3),
                                     .vertical_fov = radians(40.0f),
                                     .panorama = picture},
                                    Spectrum(2));
  for (const Seen& seen : cases) {
    LightSamplingContext ctx;
    ctx.position = seen.at;
    const auto s = light.sample(ctx, vec2(0));
    ASSERT_TRUE(s);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(s->radiance[c]) * std::numbers::pi / seen.weight[c], 1, 1e-4) << c;
  }
  LightSamplingContext behind;
  behind.position = {1.8f, 3.5f, 7};
  EXPECT_FALSE(light.sample(behind, vec2(0)));
  behind.position = {3, 2, 2.5f};
  EXPECT_FALSE(light.sample(behind, vec2(0))) << "beside the picture";
}

TEST(ProjectorLight, IsUprightAndRollsClockwise) {
  const auto picture = slide();
  const vec3 top_right(0.6f, 0.4f, -2), top_left(-0.6f, 0.4f, -2);
  ProjectorLightModel model{.vertical_fov = radians(50.0f), .panorama = picture};
  // Texel centres lie at thirds of the width and halves of the height: here beyond the outermost, so their
  // own.
  EXPECT_NEAR(made(model).intensity_towards(vec3(1.2f, 0.85f, -2)).x /
                  made(model).intensity_towards(vec3(0, 0, -1)).x,
              (0.7f * std::pow(glm::length(vec3(1.2f, 0.85f, -2)) / 2, 3.0f)) / 0.225f, 1e-3);
  auto relative = [&](vec3 d) {
    const Spectrum seen = made(model).intensity_towards(d);
    return seen / glm::length(seen);
  };
  const vec3 upright = relative(top_right);
  model.roll = radians(180.0f);
  EXPECT_LT(glm::length(relative({-0.6f, -0.4f, -2}) - upright), 1e-4f);
  model.roll = radians(90.0f); // the upper right comes to the lower right
  EXPECT_LT(glm::length(relative({0.4f, -0.6f, -2}) - upright), 1e-4f);
  EXPECT_GT(glm::length(relative(top_left) - upright), 1e-2f);
  // Straight down, the top is towards -z.
  model.roll = 0, model.direction = {0, -1, 0};
  EXPECT_LT(glm::length(relative({0.6f, -2, -0.4f}) - upright), 1e-4f);
}

TEST(ProjectorLight, LightsAScreenEvenly) {
  const ProjectorLight light = made({.vertical_fov = radians(100.0f)}, Spectrum(3, 2, 1));
  auto random = fresh_random(4);
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> place(-1.1f, 1.1f);
  for (int i = 0; i < 100; ++i) {
    LightSamplingContext ctx;
    ctx.position = {place(random), place(random), -1};
    const auto s = light.sample(ctx, vec2(0));
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->radiance.x * s->direction.z, 3, 1e-4) << "irradiance of the screen";
  }
}

TEST(ProjectorLight, ItsPowerIsTheIntegralOfItsIntensity) {
  const auto picture = slide();
  for (float fov : {10.0f, 60.0f, 120.0f})
    for (bool with_picture : {true, false}) {
      const ProjectorLight light = made({.direction = {1, 2, 3},
                                         .roll = 1,
                                         .vertical_fov = radians(fov),
                                         .panorama = with_picture ? picture : nullptr},
                                        Spectrum(0.7f));
      const double power =
          integral_over_sphere([&](vec3 d) { return light.intensity_towards(d); }, light.axis(), 40000, 720);
      EXPECT_NEAR(static_cast<double>(light.power(1)) / power, 1, 4e-3) << fov;
    }
}

TEST(ProjectorLight, BoundsHoldAllItsLight) {
  const auto picture = slide();
  auto random = fresh_random(5);
  SCOPED_TRACE(seed_note());
  const ProjectorLight light =
      made({.direction = {1, 2, 3}, .vertical_fov = radians(70.0f), .panorama = picture});
  const LightBounds b = light.bounds().value();
  int lit = 0;
  for (int i = 0; i < 100000; ++i) {
    const vec3 d = random_direction(random);
    const Spectrum sent = light.intensity_towards(d);
    if (is_black(sent)) continue;
    ++lit;
    ASSERT_TRUE(bounds_reach(b, d));
    ASSERT_LE(static_cast<double>(luminance(sent)), b.intensity * (1 + 1e-5));
  }
  EXPECT_GT(lit, 1000);
}

} // namespace
} // namespace candela
