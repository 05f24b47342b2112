// The predicate LightSamplingContext::accepts determines the directions from which light may come. Light
// selection, samples and the pdf for MIS must agree with it, also for transmitting surfaces and points in a
// medium.

#include "render/integrators/direct_light.h"
#include "render/render_testing.h"

#include <fmt/format.h>

#include <random>

namespace candela::test {
namespace {

struct Case {
  const char* name;
  SceneMaker scene;
};

/// Around the origin, whose normal is +y: what lies behind it is below.
std::vector<Case> cases() {
  auto lamp = [](SceneMaker& s, vec3 at, float half) { // faces the origin
    const vec3 n = -glm::normalize(at), x = glm::normalize(glm::cross(n, vec3(0.3f, 0.2f, 0.9f)));
    s.rectangle(at, x * half, glm::cross(n, x) * half, s.diffuse(vec3(0), vec3(3)));
  };
  std::vector<Case> all;
  auto add = [&](const char* name) -> SceneMaker& {
    return all.emplace_back(Case{name, SceneMaker(1, 1, 1)}).scene;
  };
  lamp(add("a lamp across the horizon"), {2, 0.2f, 0}, 1);
  lamp(add("a lamp behind"), {0.5f, -2, 0}, 0.8f);
  add("a sky").constant_light(vec3(1));
  LightDesc sky;
  sky.model = SkyLightModel{.sun_scale = 0, .resolution = 32};
  add("a computed sky").document.scene.lights.push_back(sky);
  LightDesc portal;
  portal.model = PortalLightModel{{0.5f, 0.4f, -2}, {0, 0, 1}, 0.2f, 2, 1.6f};
  SceneMaker& window = add("a sky through a portal across the horizon");
  window.document.scene.lights = {sky, portal};
  window.constant_light(vec3(0.02f));
  SceneMaker& neon = add("a tube and a ribbon");
  for (CurveForm form : {CurveForm::round, CurveForm::ribbon}) {
    Strands strands;
    strands.points = {{-2, 1, -1}, {-1, 1.5f, -1}, {0, 0.8f, -1.5f}, {1, -0.4f, -1}, {2, -1, -1}};
    if (form == CurveForm::ribbon)
      for (vec3& p : strands.points) p = {p.x, p.y + 0.8f, -p.z};
    strands.counts = {5}, strands.widths = {0.4f, 0.2f};
    CurvesShape shape;
    shape.strands = std::make_shared<const Strands>(strands), shape.form = static_cast<int>(form);
    neon.document.scene.instances.push_back({"", shape, mat4(1), {neon.diffuse(vec3(0), vec3(2))}});
  }
  SceneMaker& several = add("lamps before and behind, a ball and a sky");
  lamp(several, {1, 2, 0}, 0.7f);
  lamp(several, {0, -2, 1}, 0.9f);
  several.sphere({-2, 0.3f, 0}, 0.6f, several.diffuse(vec3(0), vec3(2)));
  several.constant_light(vec3(0.5f));
  return all;
}

TEST(LightAcceptanceStatistical, WhatIsSampledIsWhatMisIsTold) {
  constexpr int kSamples = 400000;
  std::mt19937_64 random(fresh_seed());
  auto number = [&] { return std::uniform_real_distribution<float>(0, kOneMinusEpsilon)(random); };
  for (const Case& c : cases())
    for (ScatteringDomain domain :
         {ScatteringDomain::hemisphere, ScatteringDomain::sphere, ScatteringDomain::volume}) {
      SCOPED_TRACE(fmt::format("{}, domain {}", c.name, static_cast<int>(domain)));
      const auto scene = RenderScene::build(c.scene.document);
      LightSamplingContext ctx;
      ctx.domain = domain;
      ctx.normal = {0, 1, 0};
      if (domain == ScatteringDomain::volume) ctx = LightSamplingContext::in_volume(ctx.position);
      // By sampling: the chance of a sample that is accepted and seen, and that of one from behind.
      RunningStatistics sampled[2], told[2];
      for (int i = 0; i < kSamples; ++i) {
        const auto choice = scene->all_lights().choose(ctx, number());
        const vec2 u(number(), number());
        const auto s = choice ? sample_light(scene->lights()[choice->light], ctx, u) : std::nullopt;
        bool seen = s && ctx.accepts(s->direction);
        if (seen) {
          const auto hit = scene->geometry().accel().intersect(Ray{ctx.position, 0, s->direction, kInfinity});
          seen = s->infinite ? !hit : hit && std::abs(hit->t - glm::length(s->point)) < 1e-3f;
        }
        const bool behind = seen && s->direction.y < 0;
        sampled[0].add(seen && !behind ? 1 : 0);
        sampled[1].add(behind ? 1 : 0);
      }
      // By the density, over directions of all around.
      for (int i = 0; i < kSamples; ++i) {
        const vec3 d = sample_uniform_sphere({number(), number()});
        const Ray ray{ctx.position, 0, d, kInfinity};
        double density = 0;
        if (const auto hit = scene->geometry().accel().intersect(ray)) {
          const SurfaceInteraction surface = scene->geometry().surface(ray, *hit);
          const std::uint32_t light = scene->light_of(surface.emitter);
          ASSERT_NE(light, kNoLight);
          density = static_cast<double>(light_sampling_pdf(
              *scene, ctx, light, light_pdf(scene->lights()[light], ctx, surface.position, d), d));
        } else {
          for (std::uint32_t light : scene->infinite_lights())
            density += static_cast<double>(
                light_sampling_pdf(*scene, ctx, light, light_pdf(scene->lights()[light], ctx, {}, d), d));
        }
        const double value = density * 4 * std::numbers::pi;
        told[0].add(d.y >= 0 ? value : 0);
        told[1].add(d.y < 0 ? value : 0);
      }
      for (int side = 0; side < 2; ++side)
        EXPECT_GT(z_test(sampled[side], told[side], 1e-5), sidak_threshold(42))
            << (side == 0 ? "before" : "behind") << ": " << sampled[side].mean() << ", told "
            << told[side].mean() << "; " << seed_note();
      if (domain != ScatteringDomain::hemisphere) {
        EXPECT_GT(sampled[0].mean() + sampled[1].mean(), 0.5) << "it shows nothing";
      }
      if (domain == ScatteringDomain::hemisphere) { EXPECT_EQ(told[1].mean(), 0); }
    }
}

} // namespace
} // namespace candela::test
