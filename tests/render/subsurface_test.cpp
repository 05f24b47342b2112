// Light that leaves bodies elsewhere than where it enters, against what is known of it without tracing paths.

#include "media/diffusion_profile.h"
#include "render/film/replay.h"
#include "render/media_testing.h"
#include "support/chandrasekhar.h"

namespace candela::test {
namespace {

constexpr SubsurfaceMethod kProfiles[] = {SubsurfaceMethod::burley, SubsurfaceMethod::dipole};
constexpr LightSampling kStrategies[] = {LightSampling::mis, LightSampling::nee, LightSampling::bsdf};

Material subsurface(SubsurfaceMethod method, vec3 color, vec3 radius, float ior, float roughness = 0) {
  SubsurfaceMaterial model;
  model.color = color, model.radius = radius, model.ior = ior, model.roughness = roughness;
  model.method = static_cast<int>(method);
  Material material;
  material.model = model;
  return material;
}

/// The share of the light that leaves within the distance r.
double share_within(SubsurfaceMethod method, float albedo, float radius, float ior, float r) {
  return static_cast<double>(method == SubsurfaceMethod::burley ? BurleyProfile(albedo, radius).cdf(r)
                                                                : DipoleProfile(albedo, radius, ior).cdf(r));
}

/// Under a sky of radiance 1 a flat body shows what its interface mirrors, and its colour of the rest. Rough
/// interfaces are as exact as their tables.
TEST(SubsurfaceRender, AFlatBodyHasItsColour) {
  const vec3 color(0.9f, 0.5f, 0.1f);
  for (const SubsurfaceMethod method : kProfiles)
    for (const float ior : {1.0f, 1.5f}) {
      SceneMaker s(64, 64, 64);
      s.rectangle({0, 0, 0}, {900, 0, 0}, {0, 900, 0},
                  s.material(subsurface(method, color, {0.3f, 0.2f, 0.05f}, ior)));
      s.constant_light(vec3(1));
      s.camera({0, 3, 5}, {0, 0, 0}, 1e-3f);
      s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(method) * 8 + (ior > 1));
      const Film film = render(s.document);
      const auto mirrored = static_cast<double>(fresnel_dielectric(5 / std::sqrt(34.0f), ior));
      for (int c = 0; c < 3; ++c)
        expect_radiance(over_pixels(film, c), mirrored + (1 - mirrored) * static_cast<double>(color[c]), 4e-2,
                        12);
    }
}

/// Seen from its back an open sheet is the same.
TEST(SubsurfaceRender, ASheetHasTwoSides) {
  SceneMaker s(64, 64, 64);
  s.rectangle({0, 0, 0}, {900, 0, 0}, {0, 900, 0},
              s.material(subsurface(SubsurfaceMethod::burley, vec3(0.6f), vec3(0.3f), 1, 0.5f)));
  s.constant_light(vec3(1));
  s.camera({0, 3, -5}, {0, 0, 0}, 1e-3f);
  s.document.settings.sampler.seed = sampler_seed(20);
  expect_radiance(over_pixels(render(s.document), 1), 0.6, 3e-2, 1);
}

/// Of a sphere the surface within the chord r is pi r^2, as of a plane: it shows what leaves within its
/// diameter, whatever the strategy.
TEST(SubsurfaceRender, ABallLosesWhatWouldLeaveBeyondIt) {
  constexpr int kTests = 2 * 3 * 2 * 2;
  for (const SubsurfaceMethod method : kProfiles)
    for (const LightSampling strategy : kStrategies)
      for (const float color : {0.5f, 1.0f}) {
        const vec3 radius(0.25f, 0.25f, 0.02f);
        SceneMaker s(64, 64, 100);
        s.sphere({0, 0, 0}, 1, s.material(subsurface(method, vec3(color, color, 0.5f * color), radius, 1)));
        s.constant_light(vec3(1));
        s.camera({0, 0, 3}, {0, 0, 0}, 20);
        s.document.settings.path.light_sampling = strategy;
        s.document.settings.sampler.seed =
            sampler_seed(30 + static_cast<std::uint64_t>(method) * 16 +
                         static_cast<std::uint64_t>(strategy) * 2 + (color < 1));
        const Film film = render(s.document);
        for (const int c : {1, 2}) {
          const float own = c == 2 ? 0.5f * color : color;
          const double exact = static_cast<double>(own) * share_within(method, own, radius[c], 1, 2);
          EXPECT_LT(exact, 1);
          expect_radiance(over_pixels(film, c), exact, 4e-2, kTests);
        }
      }
}

/// A plate of the thickness d lets through what would leave a half space beyond the distance d: the integral
/// of R(sqrt(r^2 + d^2)) over the plane. A profile does not know that the body is thin, and gives that to the
/// far side on top of all that leaves on the near one.
TEST(SubsurfaceRender, AThinPlateIsLitThrough) {
  const float radius = 0.3f, thickness = 0.2f;
  for (const SubsurfaceMethod method : kProfiles) {
    SceneMaker s(64, 64, 100);
    add_slab(s, thickness, s.material(subsurface(method, vec3(0.5f), vec3(radius), 1)));
    s.constant_light(vec3(1));
    s.camera({0, 3, 5}, {0, 0, 0}, 1e-3f);
    s.document.settings.sampler.seed = sampler_seed(80 + static_cast<std::uint64_t>(method));
    const double beyond = 1 - share_within(method, 0.5f, radius, 1, thickness);
    EXPECT_GT(beyond, 0.1);
    // Where the paths are that pass through 500 units of either side nothing is missing.
    expect_radiance(over_pixels(render(s.document), 1), 0.5 * (1 + beyond), 4e-2, 2);
  }
}

/// Another body of the same material is no part of this one: neither is one of another material.
TEST(SubsurfaceRender, LightLeavesTheBodyThatItEntered) {
  SceneMaker s(64, 64, 100);
  const int body = s.material(subsurface(SubsurfaceMethod::burley, vec3(0.5f), vec3(0.3f), 1));
  add_slab(s, 900, body);
  Instance other = s.document.scene.instances.back();
  other.materials = {s.material(subsurface(SubsurfaceMethod::burley, vec3(0.5f), vec3(0.4f), 1))};
  other.world_from_object = glm::translate(mat4(1), {0, 0, -0.1f}) * other.world_from_object;
  s.document.scene.instances.push_back(other);
  s.constant_light(vec3(1));
  s.camera({0, 3, 5}, {0, 0, 0}, 1e-3f);
  s.document.settings.sampler.seed = sampler_seed(90);
  expect_radiance(over_pixels(render(s.document), 1), 0.5, 4e-2, 1);
}

/// With Lambertian crossings the half space of the random walk has the albedo of Chandrasekhar's solution for
/// diffuse light, from wherever it is seen; that is the colour but for the error of the inversion.
void expect_walk_has_color(int spp, double tolerance, std::uint64_t salt) {
  const vec3 color(0.8f, 0.5f, 0.2f);
  SceneMaker s(64, 64, spp);
  add_slab(s, 300, s.material(subsurface(SubsurfaceMethod::random_walk, color, vec3(1, 0.7f, 0.5f), 1)));
  s.constant_light(vec3(1));
  s.camera({0, 30, 50}, {0, 0, 0}, 1e-3f);
  s.document.settings.path.max_depth = -1;
  s.document.settings.sampler.seed = sampler_seed(salt);
  const Film film = render(s.document);
  for (int c = 0; c < 3; ++c) {
    const double albedo = static_cast<double>(single_scattering_albedo(color[c]));
    const double exact = ChandrasekharH(albedo).mean_albedo();
    EXPECT_NEAR(exact, color[c], 2.2e-3);
    expect_radiance(over_pixels(film, c), exact, tolerance, 3);
  }
}
TEST(SubsurfaceRender, ARandomWalkHasTheColour) { expect_walk_has_color(64, 4e-2, 100); }
TEST(SubsurfaceHeavy, ARandomWalkHasTheColour) { expect_walk_has_color(4096, 5e-3, 101); }

/// Below an interface the light is not quite as diffuse as the inversion takes it to be: dark colours come
/// out darker still.
TEST(SubsurfaceRender, ARandomWalkBelowAnInterfaceHasAboutTheColour) {
  const vec3 color(0.8f, 0.5f, 0.2f);
  SceneMaker s(64, 64, 128);
  add_slab(s, 300, s.material(subsurface(SubsurfaceMethod::random_walk, color, vec3(1), 1.4f)));
  s.constant_light(vec3(1));
  s.camera({0, 30, 50}, {0, 0, 0}, 1e-3f);
  s.document.settings.path.max_depth = -1;
  s.document.settings.sampler.seed = sampler_seed(102);
  const Film film = render(s.document);
  const auto mirrored = static_cast<double>(fresnel_dielectric(5 / std::sqrt(34.0f), 1.4f));
  for (int c = 0; c < 3; ++c) {
    const double seen = (over_pixels(film, c).mean() - mirrored) / (1 - mirrored);
    EXPECT_NEAR(seen, color[c], 0.05) << c;
    RecordProperty("seen", std::to_string(seen));
  }
}

/// The random walk is the medium that its colour stands for in a body of rough glass.
TEST(SubsurfaceRender, ARandomWalkIsThatOfTheMedium) {
  const vec3 color(0.8f, 0.5f, 0.2f), radius(0.3f, 0.2f, 0.1f);
  auto lit_ball = [&](bool explicitly) {
    SceneMaker s(64, 64, 64);
    Material m = subsurface(SubsurfaceMethod::random_walk, color, radius, 1.4f, 0.6f);
    if (explicitly) {
      vec3 albedo;
      for (int c = 0; c < 3; ++c)
        albedo[c] = single_scattering_albedo(albedo_below_interface(color[c], 1.4f));
      m.model = RoughDielectricMaterial{.ior = 1.4f, .roughness = 0.6f};
      m.medium = add_medium(s, 1.0f / radius, albedo);
    }
    s.sphere({0, 0, 0}, 1, s.material(m));
    s.constant_light(vec3(0.5f));
    s.sphere({0, 3, 1}, 0.5f, s.diffuse(vec3(0), vec3(9)));
    s.camera({0, 0, 3}, {0, 0, 0}, 36);
    s.document.settings.sampler.type = SamplerType::independent;
    s.document.settings.path.max_depth = -1;
    s.document.settings.sampler.seed = sampler_seed(110 + (explicitly ? 1 : 0));
    return render(s.document);
  };
  const Film walk = lit_ball(false), medium = lit_ball(true);
  for (int c = 0; c < 3; ++c) {
    double difference = 0, variance = 0, sum = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        sum += static_cast<double>(walk.mean(x, y)[c]);
        difference += static_cast<double>(walk.mean(x, y)[c] - medium.mean(x, y)[c]);
        variance += static_cast<double>(walk.variance_of_mean(x, y)[c] + medium.variance_of_mean(x, y)[c]);
      }
    EXPECT_LT(std::sqrt(variance), 0.01 * sum) << "too few samples to tell";
    EXPECT_GT(normal_p_value(difference / std::sqrt(variance)), sidak_threshold(3)) << seed_note();
  }
}

/// A body of a profile under a lamp, a sky and the sun, near a wall: every strategy and number of branches
/// has the same expectation.
TEST(SubsurfaceStatistical, StrategiesAgree) {
  struct Variation {
    const char* name;
    std::function<void(PathSettings&)> apply;
  };
  const Variation variations[] = {
      {"mis", [](PathSettings&) {}},
      {"nee", [](PathSettings& p) { p.light_sampling = LightSampling::nee; }},
      {"bsdf", [](PathSettings& p) { p.light_sampling = LightSampling::bsdf; }},
      {"four paths", [](PathSettings& p) { p.split = 4; }},
      {"four shadow rays", [](PathSettings& p) { p.light_samples = 4; }},
      {"fixed roulette", [](PathSettings& p) { p.rr = RussianRoulette::fixed, p.rr_probability = 0.8f; }},
      {"uniform directions", [](PathSettings& p) { p.direction_sampling = DirectionSampling::uniform; }},
  };
  const auto count = static_cast<int>(std::size(variations));
  for (const SubsurfaceMethod method : kProfiles) {
    SceneMaker s(16, 16, 400);
    s.rectangle({0, 0, -1.2f}, {3, 0, 0}, {0, 3, 0}, s.diffuse(vec3(0.6f)));
    s.sphere({0, 0, 0}, 1, s.material(subsurface(method, {0.9f, 0.6f, 0.3f}, vec3(0.3f), 1.4f, 0.5f)));
    s.rectangle({1.5f, 1.5f, 2}, {0, 0.4f, -0.4f}, {-0.4f, 0.4f, 0}, s.diffuse(vec3(0), vec3(20)));
    s.constant_light(vec3(0.3f));
    add_directional(s, {-1, -1, -1}, vec3(1));
    s.camera({0, 0, 4}, {0, 0, 0}, 40);
    s.document.settings.sampler.type = SamplerType::independent;
    s.document.settings.path.max_depth = 6;
    std::vector<RenderedSum> sums;
    for (const Variation& v : variations) {
      Document document = s.document;
      v.apply(document.settings.path);
      document.settings.sampler.seed =
          sampler_seed(200 + sums.size() + 50 * static_cast<std::uint64_t>(method));
      sums.push_back(sum_of(document));
      const RenderedSum &own = sums.back(), &first = sums.front();
      const double deviation = std::sqrt(own.variance.y + first.variance.y);
      EXPECT_LT(deviation, 0.03 * own.value.y) << v.name << ": too few samples to tell";
      EXPECT_GT(normal_p_value((own.value.y - first.value.y) / deviation), sidak_threshold(2 * count))
          << v.name << ": " << own.value.y << " against " << first.value.y << ", " << deviation << "; "
          << seed_note();
    }
  }
}

/// A material that shows it on one side is a flat body there.
TEST(SubsurfaceRender, OneSideOfATwoSidedMaterialMayHaveIt) {
  SceneMaker s(64, 64, 64);
  TwoSidedMaterial sides;
  sides.front = s.material(subsurface(SubsurfaceMethod::burley, vec3(0.6f), vec3(0.3f), 1));
  sides.back = s.diffuse(vec3(0.2f));
  Material both;
  both.model = sides;
  s.rectangle({0, 0, 0}, {900, 0, 0}, {0, 900, 0}, s.material(both));
  s.constant_light(vec3(1));
  s.camera({0, 3, 5}, {0, 0, 0}, 1e-3f);
  s.document.settings.sampler.seed = sampler_seed(300);
  expect_radiance(over_pixels(render(s.document), 1), 0.6, 4e-2, 1);
}

/// A sample alone is what it is among others, and the lengths of its paths add up to it, however they split.
TEST(SubsurfaceRender, ASampleReplaysAlone) {
  SceneMaker s(24, 24, 1);
  s.rectangle({0, 0, -1.2f}, {3, 0, 0}, {0, 3, 0}, s.diffuse(vec3(0.6f)));
  s.sphere({0, 0, 0}, 1,
           s.material(subsurface(SubsurfaceMethod::dipole, vec3(0.9f), vec3(0.3f), 1.4f, 0.5f)));
  s.constant_light(vec3(1));
  s.camera({0, 0, 4}, {0, 0, 0}, 40);
  Document d = s.document;
  d.settings.path.split = 3;
  d.settings.path.max_depth = 4;
  const auto scene = RenderScene::build(d);
  Film film(24, 24);
  std::atomic<bool> stop{false};
  render_pass(*scene, d, {5, 6}, film, stop);
  for (unsigned y = 0; y < 24; ++y)
    for (unsigned x = 0; x < 24; ++x) {
      const vec3 whole = replay_sample(*scene, d, {x, y}, 5);
      ASSERT_EQ(whole, film.mean(static_cast<int>(x), static_cast<int>(y)));
      vec3 sum(0);
      Document part = d;
      for (part.settings.path.only_depth = 1; part.settings.path.only_depth <= 4;
           ++part.settings.path.only_depth)
        sum += replay_sample(*scene, part, {x, y}, 5);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole[c], 2e-5f * std::max(whole[c], 1e-3f));
    }
}

} // namespace
} // namespace candela::test
