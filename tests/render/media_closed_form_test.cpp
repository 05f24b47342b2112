// Light in media against what can be known of it without tracing paths.

#include "render/media_testing.h"
#include "support/chandrasekhar.h"

namespace candela::test {
namespace {

const vec3 kGrey(1);

/// One direction of view for all pixels.
void look_into_slab(SceneMaker& s, float from = 3) { s.camera({0, 0, from}, {0, 0, 0}, 1e-3f); }

/// Beer and Lambert: whatever a medium does with the light that it takes, what comes straight through is the
/// same, and where paths end there it is known without any variance.
TEST(MediaRender, TransmittanceHasNoVariance) {
  for (const vec3 albedo : {vec3(0), vec3(0.9f, 0.5f, 0), vec3(1)}) {
    SceneMaker s(8, 2, 16);
    const vec3 sigma(0.3f, 1, 2.5f);
    add_slab(s, 1.5f, boundary(s, add_medium(s, sigma, albedo, HenyeyGreensteinPhase{0.5f})));
    s.constant_light(vec3(2, 3, 4));
    look_into_slab(s);
    s.document.settings.path.max_depth = 1;
    s.document.settings.sampler.seed = sampler_seed();
    const Film film = render(s.document);
    for (int c = 0; c < 3; ++c) {
      const double exact = (2.0 + c) * std::exp(-1.5 * static_cast<double>(sigma[c]));
      for (int x = 0; x < 8; ++x) {
        EXPECT_NEAR(static_cast<double>(film.mean(x, 1)[c]), exact, 2e-6 * exact);
        EXPECT_LT(static_cast<double>(film.variance_of_mean(x, 1)[c]), 1e-12);
      }
    }
  }
}

/// Of a body that only absorbs nothing is left to chance, whatever the depth.
TEST(MediaRender, WhatOnlyAbsorbsHasNoVariance) {
  SceneMaker s(8, 2, 16);
  add_slab(s, 1, boundary(s, add_medium(s, {0.3f, 1, 2.5f}, vec3(0))));
  s.constant_light(vec3(1));
  look_into_slab(s);
  const Film film = render(s.document);
  EXPECT_NEAR(film.mean(3, 0).y, std::exp(-1.0f), 2e-6f);
  EXPECT_LT(film.variance_of_mean(3, 0).y, 1e-12f);
}

/// Emission of what also absorbs: (1 - exp(-sigma_a d)) x emission; a lossless medium has none.
TEST(MediaRender, EmissionIsThatOfTheFormula) {
  SceneMaker s(8, 2, 4);
  add_slab(s, 2, boundary(s, add_medium(s, {0.3f, 1, 0}, vec3(0))));
  s.document.scene.media[0].emission = {3, 5, 7};
  look_into_slab(s);
  const Film film = render(s.document);
  EXPECT_NEAR(film.mean(1, 1).x, 3 * (1 - std::exp(-0.6f)), 1e-5f);
  EXPECT_NEAR(film.mean(1, 1).y, 5 * (1 - std::exp(-2.0f)), 1e-5f);
  EXPECT_EQ(film.mean(1, 1).z, 0);
  EXPECT_LT(film.variance_of_mean(1, 1).y, 1e-12f);
}

/// Where it scatters, too, what it sends out is scattered on: the inside of an endless one has the radiance
/// of the emission everywhere.
TEST(MediaRender, AnEndlessGlowIsUniform) {
  SceneMaker s(32, 32, 64);
  s.document.scene.medium = add_medium(s, vec3(1), vec3(0.6f), HenyeyGreensteinPhase{0.3f});
  s.document.scene.media[0].emission = vec3(2);
  s.document.settings.sampler.seed = sampler_seed(1);
  look_into_slab(s);
  expect_radiance(over_pixels(render(s.document), 0), 2, 4e-3, 1);
}

/// Light scattered once in a slab of optical depth 1 with an albedo of 0.9, seen and lit along the normal:
///     back:    omega / (4 pi) mu0 / (mu0 + mu) (1 - exp(-tau (1 / mu0 + 1 / mu))),
///     forward: omega / (4 pi) tau exp(-tau),
/// times the irradiance on a facing plane (Chandrasekhar 1960, "Radiative Transfer", section 60).
void expect_single_scattering(vec3 light_direction, double exact, std::uint64_t salt) {
  for (const MediumSampling how : {MediumSampling::mis, MediumSampling::distance}) {
    SceneMaker s(64, 64, 64);
    add_slab(s, 1, boundary(s, add_medium(s, kGrey, vec3(0.9f))));
    add_directional(s, light_direction, vec3(1));
    look_into_slab(s);
    s.document.settings.path.max_depth = 2;
    s.document.settings.path.medium_sampling = how;
    s.document.settings.sampler.seed = sampler_seed(salt + static_cast<std::uint64_t>(how));
    expect_radiance(over_pixels(render(s.document), 1), exact, 5e-4, 4);
  }
}
TEST(MediaClosedFormRender, SingleScatteringBackIsChandrasekhars) {
  expect_single_scattering({0, 0, -1}, 0.030964, 10);
}
TEST(MediaClosedFormRender, SingleScatteringForwardIsChandrasekhars) {
  expect_single_scattering({0, 0, 1}, 0.026347, 20);
}

/// The same with a lamp so far away that from there all of the slab seems to be one point.
TEST(MediaClosedFormRender, ADistantLampIsAsASun) {
  for (const MediumSampling how : {MediumSampling::mis, MediumSampling::equiangular}) {
    SceneMaker s(64, 64, 64);
    add_slab(s, 1, boundary(s, add_medium(s, kGrey, vec3(0.9f))));
    constexpr float kFar = 1e8f;
    LightDesc lamp;
    lamp.model = PointLightModel{.position = {0.1f * kFar, 0, kFar}};
    lamp.color = vec3(1.01f * kFar * kFar); // irradiance 1
    s.document.scene.lights.push_back(lamp);
    look_into_slab(s);
    s.document.settings.path.max_depth = 2;
    s.document.settings.path.medium_sampling = how;
    s.document.settings.sampler.seed = sampler_seed(28 + static_cast<std::uint64_t>(how));
    const double mu0 = 1 / std::sqrt(1.01);
    const double exact = 0.9 / (4 * std::numbers::pi) * mu0 / (mu0 + 1) * (1 - std::exp(-(1 / mu0 + 1)));
    expect_radiance(over_pixels(render(s.document), 1), exact, 5e-4, 2);
  }
}

/// A point light in fog that fills everything, seen along a ray that passes it at the distance h: with an
/// absorbing albedo of almost 0 the light scattered once is, of an isotropic phase function,
///     sigma_s / (4 pi) integral of exp(-sigma_t (t + r)) / r^2 dt, r^2 = h^2 + (t - t0)^2,
/// by quadrature.
TEST(MediaClosedFormRender, APointLightInFogIsThatOfTheIntegral) {
  const double sigma = 0.4, omega = 0.8, height = 0.25, t0 = 3;
  double exact = 0;
  const int n = 400000;
  for (int i = 0; i < n; ++i) {
    // By the angle at the light, as equiangular sampling does.
    const double begin = std::atan2(-t0, height),
                 angle = begin + (i + 0.5) / n * (std::numbers::pi / 2 - begin);
    const double t = t0 + height * std::tan(angle), r = height / std::cos(angle);
    exact += std::exp(-sigma * (t + r)) / height * (std::numbers::pi / 2 - begin) / n;
  }
  exact *= sigma * omega / (4 * std::numbers::pi);
  for (const MediumSampling how :
       {MediumSampling::mis, MediumSampling::distance, MediumSampling::equiangular}) {
    SceneMaker s(64, 64, how == MediumSampling::distance ? 1024 : 64);
    s.document.scene.medium = add_medium(s, vec3(static_cast<float>(sigma)), vec3(static_cast<float>(omega)));
    LightDesc lamp;
    lamp.model = PointLightModel{.position = {static_cast<float>(height), 0, 0}};
    lamp.color = vec3(1);
    s.document.scene.lights.push_back(lamp);
    look_into_slab(s, static_cast<float>(t0));
    s.document.settings.path.max_depth = 2;
    s.document.settings.sampler.seed = sampler_seed(30 + static_cast<std::uint64_t>(how));
    s.document.settings.path.medium_sampling = how;
    expect_radiance(over_pixels(render(s.document), 1), exact, 2e-3, 3);
  }
}

TEST(ChandrasekharH, IsThatOfTheTables) {
  EXPECT_NEAR(ChandrasekharH(1)(1), 2.9078, 1e-3) << "table XI";
  EXPECT_NEAR(ChandrasekharH(0.5)(0), 1, 1e-6) << "of grazing light all that returns was scattered once";
}

/// By reciprocity a half space under light of radiance 1 from everywhere shows, at the cosine mu, the share
/// that it reflects of light from there.
void expect_half_space(double omega, double mu, int spp, double tolerance) {
  SceneMaker s(64, 64, spp);
  add_slab(s, 300, boundary(s, add_medium(s, kGrey, vec3(static_cast<float>(omega)))));
  s.constant_light(vec3(1));
  s.camera({30 * static_cast<float>(std::sqrt(1 - mu * mu)), 0, 30 * static_cast<float>(mu)}, {0, 0, 0},
           1e-3f, {0, 1, 0});
  s.document.settings.sampler.seed = sampler_seed(40 + static_cast<std::uint64_t>(1000 * omega + 10 * mu));
  expect_radiance(over_pixels(render(s.document), 1), ChandrasekharH(omega).albedo(mu), tolerance, 6);
}
TEST(MediaClosedFormRender, AHalfSpaceReflectsWhatChandrasekharHas) {
  for (const double mu : {1.0, 0.3}) {
    expect_half_space(0.5, mu, 64, 8e-3);
    expect_half_space(0.9, mu, 32, 1e-2);
  }
}
TEST(MediaClosedFormHeavy, AHalfSpaceReflectsWhatChandrasekharHas) {
  for (const double mu : {1.0, 0.3}) {
    expect_half_space(0.5, mu, 4096, 1e-3);
    expect_half_space(0.9, mu, 2048, 1e-3);
    expect_half_space(0.99, mu, 2048, 1e-3);
  }
}

/// A grid of one density is the half space, too.
TEST(MediaClosedFormRender, AUniformGridIsAHalfSpace) {
  SceneMaker s(64, 64, 128);
  VolumeGrid grid = random_grid({30, 30, 20}, 1);
  std::ranges::fill(grid.density, 2.0f);
  add_slab(
      s, 300,
      boundary(s, add_grid(s, std::move(grid), {0, 0, -150}, {1000, 1000, 300}, vec3(0.5f), vec3(0.5f))));
  s.constant_light(vec3(1));
  look_into_slab(s);
  s.document.settings.sampler.seed = sampler_seed(60);
  expect_radiance(over_pixels(render(s.document), 1), ChandrasekharH(0.5).albedo(1), 8e-3, 1);
}

struct Furnace {
  const char* name;
  PhaseModel phase;
  std::function<int(SceneMaker&, const std::string&)> surface;
};

/// What loses nothing has the radiance of its surroundings.
TEST(MediaFurnaceRender, WhatLosesNothingIsNotSeen) {
  auto glass = [](float ior) {
    return [ior](SceneMaker& s, const std::string& medium) {
      Material m;
      m.model = DielectricMaterial{.ior = ior};
      m.medium = medium;
      return s.material(m);
    };
  };
  // Instead of the medium, a grid that fills the ball unevenly.
  auto uneven = [](auto surface) {
    return [surface](SceneMaker& s, const std::string&) {
      MediumDesc& medium = s.document.scene.media.back();
      GridMediumModel model;
      model.sigma_t = std::get<HomogeneousMediumModel>(medium.model).sigma_t, model.albedo = vec3(1);
      model.grid = std::make_shared<const VolumeGrid>(wavy_grid({32, 21, 40}));
      medium.model = model;
      return surface(s, medium.name);
    };
  };
  const Furnace cases[] = {
      {"isotropic", IsotropicPhase{}, boundary},
      {"forward", HenyeyGreensteinPhase{0.8f}, boundary},
      {"backward", HenyeyGreensteinPhase{-0.5f}, boundary},
      {"rayleigh", RayleighPhase{}, boundary},
      {"droplets", DropletsPhase{20}, boundary},
      {"glass", IsotropicPhase{}, glass(1.5f)},
      {"bubble", IsotropicPhase{}, glass(0.7f)},
      {"grid", HenyeyGreensteinPhase{0.6f}, uneven(boundary)},
      {"grid in glass", IsotropicPhase{}, uneven(glass(1.5f))},
  };
  for (const Furnace& c : cases)
    for (const bool mis : {false, true}) {
      SceneMaker s(32, 32, 100);
      // Without light sampling every path of a grey medium returns 1.
      const vec3 sigma = mis ? vec3(2, 0.7f, 5) : vec3(3);
      s.sphere({0, 0, 0}, 1, c.surface(s, add_medium(s, sigma, vec3(1), c.phase)));
      s.constant_light(vec3(1));
      s.camera({0, 0, 3}, {0, 0, 0}, 36); // the film lies within the ball
      s.document.settings.sampler.seed = sampler_seed(100 + static_cast<std::uint64_t>(&c - cases));
      if (!mis) s.document.settings.path.light_sampling = LightSampling::bsdf;
      SCOPED_TRACE(c.name);
      const Film film = render(s.document);
      for (int channel = 0; channel < 3; ++channel)
        expect_radiance(over_pixels(film, channel), 1, mis ? 2e-2 : 1e-3,
                        static_cast<int>(6 * std::size(cases)));
    }
}

} // namespace
} // namespace candela::test
