// Beer and Lambert's law in bodies that light goes through: what a ray is inside of absorbs, whatever the ray
// ends on.

#include "render/integrators/media_at.h"
#include "render/render_testing.h"

namespace candela::test {
namespace {

const vec3 kSigma(1, 0.5f, 0);

int glass(SceneMaker& s, vec3 absorption, float ior = 1, float opacity = 1) {
  Material m;
  m.model = DielectricMaterial{ior, vec3(1), absorption};
  m.opacity = opacity;
  return s.material(m);
}

/// All of the film sees what the middle does.
void look_from(SceneMaker& s, vec3 from) {
  s.camera(from, {0, 0, 0}, 0.01f, {1, 0.3f, 0});
  s.document.settings.sampler.seed = sampler_seed(1);
}

void expect_attenuated(const Document& document, glm::dvec3 depth, double lamp = 1) {
  for (Integrator integrator : {Integrator::path, Integrator::whitted}) {
    Document d = document;
    d.settings.integrator = integrator;
    const Film film = render(d);
    for (int c = 0; c < 3; ++c) {
      const double exact = lamp * std::exp(-depth[c]);
      for (int x = 0; x < film.width(); ++x)
        EXPECT_NEAR(static_cast<double>(film.mean(x, 0)[c]), exact, 2e-4 * exact)
            << c << ", " << static_cast<int>(integrator);
    }
  }
}

/// A lamp of radius 0.1 in the middle of a ball of glass of radius 1.
SceneMaker lamp_in_glass(float opacity = 1) {
  SceneMaker s(8, 1, 4);
  s.sphere({0, 0, 0}, 1, glass(s, kSigma, 1, opacity));
  s.sphere({0, 0, 0}, 0.1f, s.diffuse(vec3(0), vec3(1)));
  return s;
}

TEST(AbsorptionRender, ABodyInsideOfGlassIsAttenuated) {
  SceneMaker s = lamp_in_glass();
  look_from(s, {0, 0, 5});
  expect_attenuated(s.document, 0.9 * glm::dvec3(kSigma));
}

TEST(AbsorptionRender, TheWayOfACameraInGlassBeginsAtTheCamera) {
  SceneMaker s = lamp_in_glass();
  look_from(s, {0, 0, 0.6f});
  expect_attenuated(s.document, 0.5 * glm::dvec3(kSigma));
  SceneMaker far(8, 1, 4); // from inside to the outside
  far.sphere({0, 0, 0}, 1, glass(far, kSigma));
  far.constant_light(vec3(1));
  look_from(far, {0, 0, 0.25f}); // towards -z: 1.25 to the surface
  expect_attenuated(far.document, 1.25 * glm::dvec3(kSigma));
}

TEST(AbsorptionRender, SurfacesThatAreLookedThroughAreCrossed) {
  SceneMaker s = lamp_in_glass(0); // the surface itself does nothing
  look_from(s, {0, 0, 5});
  expect_attenuated(s.document, 0.9 * glm::dvec3(kSigma));
}

TEST(AbsorptionRender, TheInnermostBodyAbsorbs) {
  SceneMaker s(8, 1, 4);
  s.sphere({0, 0, 0}, 1, glass(s, kSigma));
  s.sphere({0, 0, 0}, 0.6f, glass(s, vec3(0)));             // a bubble
  s.sphere({0, 0, 0}, 0.4f, glass(s, vec3(0.1f, 2, 0.3f))); // and other glass in it
  s.sphere({0, 0, 0}, 0.1f, s.diffuse(vec3(0), vec3(1)));
  const glm::dvec3 inner = 0.3 * glm::dvec3(0.1, 2, 0.3);
  for (float z : {5.0f, 0.5f, 0.8f}) {
    look_from(s, {0, 0, z});
    expect_attenuated(
        s.document,
        std::min(static_cast<double>(z) - 0.6, 0.4) * (z > 0.6f ? 1.0 : 0.0) * glm::dvec3(kSigma) + inner);
  }
}

TEST(AbsorptionRender, ALensMayStandOnBothSidesOfASurface) {
  // The camera in glass, half of its lens outside: rays of either side end on the lamp.
  SceneMaker s(64, 4, 256);
  s.rectangle({0, 0, 0}, {0, 50, 0}, {0, 0, 50}, glass(s, vec3(1))); // the inside is x < 0
  s.rectangle({-50, 0, 0}, {0, 0, 50}, {0, 50, 0}, 0);               // closed far away
  s.disc({0, 0, -4}, 40, {1, 0, 0}, {0, 1, 0}, s.diffuse(vec3(0), vec3(1)));
  s.camera({-1e-4f, 0, 0}, {-1e-4f, 0, -4}, 1e-4f);
  s.document.scene.camera.aperture_radius = 0.01f;
  s.document.scene.camera.focus_distance = 1e6f; // rays are parallel
  s.document.settings.sampler.seed = sampler_seed(2);
  // The share of the lens that is outside, less a strip; rays that cross the surface on their way are too few
  // to matter.
  const double outside = 0.5 - 2 * 1e-4 / (std::numbers::pi * 0.01);
  EXPECT_NEAR(over_pixels(render(s.document), 1).mean(), outside + (1 - outside) * std::exp(-4.0), 2e-3);
}

/// Light from a lamp in glass to a diffuse wall in the same glass: light sampling must see the glass between,
/// too.
TEST(AbsorptionStatistical, StrategiesAgreeInsideOfGlass) {
  for (float opacity : {1.0f, 0.5f}) {
    SceneMaker s(8, 8, 512);
    s.sphere({0, 0, 0}, 3, glass(s, kSigma, 1, opacity));
    s.rectangle({0, -1, 0}, {0, 0, 1}, {1, 0, 0}, s.diffuse(vec3(0.8f)));
    s.rectangle({0, 1, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, s.diffuse(vec3(0), vec3(5)));
    LightDesc point;
    point.model = PointLightModel{.position = {0.5f, 0.3f, 0}};
    point.color = vec3(1);
    s.document.scene.lights.push_back(point);
    s.camera({0, 0, 2}, {0, -1, 0}, 25);
    s.document.settings.sampler.type = SamplerType::independent;
    /// Sum over the pixels, and its variance.
    struct Sum {
      glm::dvec3 value{0}, variance{0};
    };
    Sum sums[3];
    for (int k = 0; k < 3; ++k) {
      s.document.settings.path.light_sampling = static_cast<LightSampling>(k);
      s.document.settings.sampler.seed = sampler_seed(10 + static_cast<std::uint64_t>(k));
      const Film film = render(s.document);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
          sums[k].value += glm::dvec3(film.mean(x, y));
          sums[k].variance += glm::dvec3(film.variance_of_mean(x, y));
        }
      for (int c = 0; c < 3; ++c) {
        const double deviation = std::sqrt(sums[0].variance[c] + sums[k].variance[c]);
        EXPECT_LE(std::abs(sums[k].value[c] - sums[0].value[c]), 5.5 * deviation)
            << "strategy " << k << ", channel " << c << "; " << seed_note();
        EXPECT_LT(deviation, 0.02 * sums[k].value[c]) << "too few samples to tell";
      }
    }
  }
}

/// A facing plane at the distance d of a point light of intensity 1 in glass: irradiance exp(-sigma d) / d^2.
TEST(AbsorptionRender, APointLightInGlassFades) {
  SceneMaker s(4, 1, 1);
  s.sphere({0, 0, 0}, 9, glass(s, kSigma));
  s.rectangle({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, s.diffuse(vec3(1)));
  LightDesc point;
  point.model = PointLightModel{.position = {0, 0, 2}};
  point.color = vec3(1);
  s.document.scene.lights.push_back(point);
  s.document.settings.path.max_depth = 2;
  look_from(s, {0, 0, 1.5f});
  const Film film = render(s.document);
  for (int c = 0; c < 3; ++c) {
    const double exact = std::exp(-(2 + 1.5) * static_cast<double>(kSigma[c])) / (4 * std::numbers::pi);
    EXPECT_NEAR(static_cast<double>(film.mean(1, 0)[c]), exact, 1e-4 * exact);
  }
}

/// Light that a rough surface lets out or in has passed through the glass on its own side alone.
TEST(AbsorptionStatistical, StrategiesAgreeThroughARoughSurface) {
  for (const bool inside : {false, true}) {
    SceneMaker s(8, 8, 4096);
    Material rough;
    rough.model = RoughDielectricMaterial{.ior = 1.3f, .roughness = 0.7f, .absorption = {1.5f, 0.7f, 0}};
    s.sphere({0, 0, 0}, 1, s.material(rough));
    s.rectangle({0, 0, inside ? -0.4f : -2}, {0.3f, 0, 0}, {0, 0.3f, 0}, s.diffuse(vec3(0), vec3(5)));
    s.camera({0, 0, 3}, {0, 0, 0}, 25);
    s.document.settings.sampler.type = SamplerType::independent;
    glm::dvec3 value[2] = {}, variance[2] = {};
    for (int k = 0; k < 2; ++k) {
      s.document.settings.path.light_sampling = k == 0 ? LightSampling::bsdf : LightSampling::mis;
      s.document.settings.sampler.seed = sampler_seed(20 + static_cast<std::uint64_t>(k));
      const Film film = render(s.document);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
          value[k] += glm::dvec3(film.mean(x, y));
          variance[k] += glm::dvec3(film.variance_of_mean(x, y));
        }
    }
    for (int c = 0; c < 3; ++c) {
      const double deviation = std::sqrt(variance[0][c] + variance[1][c]);
      EXPECT_GT(normal_p_value((value[0][c] - value[1][c]) / deviation), sidak_threshold(6))
          << value[0][c] << " against " << value[1][c] << "; " << seed_note();
      EXPECT_LT(deviation, 0.01 * value[1][c]) << "too few samples to tell";
    }
  }
}

Spectrum sigma_a(const RenderScene& scene, MediumId medium) {
  return std::get<HomogeneousMedium>(scene.medium(medium)).sigma_a;
}

TEST(Absorption, WhatAPointLiesIn) {
  SceneMaker s(1, 1, 1);
  s.sphere({0, 0, 0}, 2, glass(s, {1, 0, 0}));
  s.sphere({0, 0, 0}, 1, glass(s, {2, 0, 0}));
  s.sphere({0.2f, 0, 0}, 0.5f, glass(s, vec3(0)));
  s.sphere({5, 0, 0}, 1, s.diffuse(vec3(1)));
  s.mesh(sphere_mesh(5, 7, false), glass(s, {3, 0, 0}), glm::translate(mat4(1), {0, 9, 0}));
  s.rectangle({0, 0, -20}, {3, 0, 0}, {0, 3, 0}, glass(s, {4, 0, 0})); // bounds no body
  const auto scene = RenderScene::build(s.document);
  auto absorbs = [&](vec3 p) {
    const MediumId medium = media_at(*scene, p).current();
    return medium ? sigma_a(*scene, medium).x : -1.0f;
  };
  EXPECT_EQ(absorbs({0, 0, 3}), -1);
  EXPECT_EQ(absorbs({0, 0, 1.5f}), 1);
  EXPECT_EQ(absorbs({-0.6f, 0, 0}), 2);
  EXPECT_EQ(absorbs({0.2f, 0, 0.1f}), 0);
  EXPECT_EQ(absorbs({5, 0, 0}), -1);
  EXPECT_EQ(absorbs({0.1f, 9.1f, 0}), 3);
  EXPECT_EQ(absorbs({0, 0, -22}), -1);
  MediumStack way = media_at(*scene, {0, 0, 3});
  move_between(*scene, {0, 0, 3}, {-0.6f, 0, 0}, way);
  EXPECT_EQ(sigma_a(*scene, way.current()).x, 2);
  move_between(*scene, {-0.6f, 0, 0}, {-3, 0, 0}, way);
  EXPECT_TRUE(way.empty());
}

} // namespace
} // namespace candela::test
