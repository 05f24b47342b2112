// Blends, two-sided and invisible materials in pictures.

#include "render/integrators/ao_integrator.h"
#include "render/render_testing.h"
#include "support/textures.h"

namespace candela::test {
namespace {

int blend(SceneMaker& s, int first, int second, NumberParameter weight) {
  Material m;
  m.model = BlendMaterial{first, second, weight};
  return s.material(m);
}
int two_sided(SceneMaker& s, int front, int back) {
  Material m;
  m.model = TwoSidedMaterial{front, back};
  return s.material(m);
}
int null(SceneMaker& s, vec3 absorption = vec3(0)) {
  Material m;
  m.model = NullMaterial{absorption};
  return s.material(m);
}
int mirror(SceneMaker& s, vec3 specular) {
  Material m;
  m.model = MirrorMaterial{specular, vec3(0)};
  return s.material(m);
}
int ggx(SceneMaker& s, vec3 specular, float roughness) {
  Material m = material_of_type("ggx");
  color(m, "specular") = specular;
  number(m, "roughness") = roughness;
  set_if_there(m, "diffuse", vec3(0));
  return s.material(m);
}

/// A wall in z = 0, whose front looks to +z, under a white sky; all of the film sees the middle.
SceneMaker wall(int spp = 16) {
  SceneMaker s(8, 1, spp);
  s.constant_light(vec3(1));
  s.document.settings.sampler.seed = sampler_seed(1);
  return s;
}
void look_at_centre(SceneMaker& s, vec3 from) { s.camera(from, {0, 0, 0}, 0.01f, {1, 0.3f, 0}); }

void expect_uniform(const Document& document, vec3 exact, float tolerance = 2e-5f) {
  for (Integrator integrator : {Integrator::path, Integrator::whitted}) {
    Document d = document;
    d.settings.integrator = integrator;
    d.settings.path.max_depth = 2;
    if (integrator == Integrator::path) d.settings.path.light_sampling = LightSampling::bsdf;
    d.settings.path.split = 1;
    d.settings.path.rr = RussianRoulette::off;
    const Film film = render(d);
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(film.mean(x, 0)[c], exact[c], tolerance * std::max(exact[c], 1.0f))
            << c << ", " << static_cast<int>(integrator);
  }
}

TEST(TwoSidedRender, EachSideHasItsMaterial) {
  SceneMaker s = wall();
  const vec3 red(0.75f, 0.25f, 0), blue(0, 0.125f, 0.5f);
  // Two_sided comes first, so that it names materials behind it.
  const int leaf = two_sided(s, 1, 2);
  const int front = mirror(s, red), back = mirror(s, blue);
  ASSERT_EQ(front, 1);
  ASSERT_EQ(back, 2);
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, leaf);
  look_at_centre(s, {0, 0, 3});
  expect_uniform(s.document, red);
  look_at_centre(s, {0.5f, 0, -3});
  expect_uniform(s.document, blue);
  s.document.settings.view = View::albedo;
  EXPECT_EQ(render(s.document).mean(0, 0), blue);
  look_at_centre(s, {0.5f, 0, 3});
  EXPECT_EQ(render(s.document).mean(0, 0), red);
}

TEST(TwoSidedRender, ASideWithoutAMaterialIsBlack) {
  SceneMaker s = wall();
  const int grey = mirror(s, vec3(0.5f));
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, two_sided(s, -1, grey));
  look_at_centre(s, {0, 0, 3});
  expect_uniform(s.document, vec3(0));
  look_at_centre(s, {0, 0, -3});
  expect_uniform(s.document, vec3(0.5f));
}

TEST(TwoSidedRender, MeshesAndTexturesOfEitherSide) {
  SceneMaker s = wall();
  s.document.scene.textures = {picture_texture(1, 1, {255, 0, 0}), picture_texture(1, 1, {0, 255, 0})};
  Material red = material_of_type("mirror"), green = red;
  set_if_there(red, "specular", vec3(1));
  set_if_there(green, "specular", vec3(1));
  use_of(red, "specular").texture = 0;
  use_of(green, "specular").texture = 1;
  const int r = s.material(red), g = s.material(green);
  Mesh square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  s.mesh(square, two_sided(s, r, g));
  look_at_centre(s, {0.1f, 0.2f, 3});
  expect_uniform(s.document, vec3(1, 0, 0));
  look_at_centre(s, {0.1f, 0.2f, -3});
  expect_uniform(s.document, vec3(0, 1, 0));
}

TEST(TwoSidedRender, EmissionAndOpacityAreItsOwn) {
  SceneMaker s = wall();
  const int part = s.diffuse(vec3(0), vec3(7)); // shines only where it is a surface's material
  const int whole = two_sided(s, part, part);
  s.document.scene.materials[static_cast<std::size_t>(whole)].emission = vec3(2);
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, whole);
  look_at_centre(s, {0, 0, 3});
  expect_uniform(s.document, vec3(2));
  look_at_centre(s, {0, 0, -3});
  expect_uniform(s.document, vec3(0));
  s.document.scene.materials[static_cast<std::size_t>(whole)].two_sided_emission = true;
  expect_uniform(s.document, vec3(2));
  s.document.scene.materials[static_cast<std::size_t>(whole)].opacity = 0.0f;
  expect_uniform(s.document, vec3(1)); // the sky behind it
}

TEST(BlendRender, MixesMirrorsExactly) {
  SceneMaker s = wall();
  const vec3 red(0.75f, 0.25f, 0), blue(0, 0.125f, 0.5f);
  const int a = mirror(s, red), b = mirror(s, blue);
  for (float weight : {0.0f, 0.25f, 1.0f}) {
    SceneMaker t = s;
    t.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, blend(t, a, b, weight));
    look_at_centre(t, {0.3f, 0, 3});
    t.document.settings.integrator = Integrator::whitted; // every lobe is followed
    t.document.settings.path.rr = RussianRoulette::off;
    const vec3 seen = render(t.document).mean(0, 0), exact = glm::mix(red, blue, weight);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], exact[c], 1e-6f) << weight;
  }
}

TEST(BlendRender, ATexturesWeightChoosesTheMaterial) {
  SceneMaker s = wall();
  s.document.scene.textures = {picture_texture(2, 1, {0, 255}, 1)}; // left 0, right 1
  const vec3 red(0.75f, 0.25f, 0), blue(0, 0.125f, 0.5f);
  NumberParameter weight = 1.0f;
  weight.use.texture = 0;
  weight.use.filter = TextureFilter::nearest;
  const int a = mirror(s, red), b = mirror(s, blue);
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, blend(s, a, b, weight));
  s.camera({-0.5f, 0, 3}, {-0.5f, 0, 0}, 0.01f);
  expect_uniform(s.document, red);
  s.camera({0.5f, 0, 3}, {0.5f, 0, 0}, 0.01f);
  expect_uniform(s.document, blue);
}

TEST(BlendRender, BlendsOfTwoSidedMaterialsHaveSides) {
  SceneMaker s = wall();
  const vec3 red(0.75f, 0.25f, 0), blue(0, 0.125f, 0.5f), green(0, 0.5f, 0);
  const int a = mirror(s, red), b = mirror(s, blue), c = mirror(s, green);
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, blend(s, two_sided(s, a, b), c, 0.5f));
  s.document.settings.view = View::albedo;
  look_at_centre(s, {0, 0, 3});
  EXPECT_EQ(render(s.document).mean(0, 0), 0.5f * (red + green));
  look_at_centre(s, {0, 0, -3});
  EXPECT_EQ(render(s.document).mean(0, 0), 0.5f * (blue + green));
}

/// Direct light is linear in the BSDF: the picture of a blend is the mixture of the pictures, whichever way
/// light is found.
TEST(BlendRender, DirectLightIsTheMixtureOfThePartsOwn) {
  auto scene = [](int spp) {
    SceneMaker s(32, 32, spp);
    s.diffuse({0.6f, 0.3f, 0.1f});
    ggx(s, vec3(0.9f, 0.8f, 0.7f), 0.4f);
    mirror(s, {0.9f, 0.5f, 0.9f});
    s.rectangle({0, 1.5f, 0}, {0.6f, 0, 0}, {0, 0, 0.6f}, s.diffuse(vec3(0), {9, 8, 7}));
    s.constant_light(vec3(0.3f));
    s.camera({0, 1.2f, 2.5f}, {0, 0, 0}, 40);
    s.document.settings.path.max_depth = 2;
    s.document.settings.sampler.type = SamplerType::independent;
    return s;
  };
  auto picture = [&](int material, LightSampling how, int salt, int spp) {
    SceneMaker s = scene(spp);
    const int inner = blend(s, 1, 2, 0.25f); // ggx and mirror
    const int outer = blend(s, 0, inner, 0.6f);
    s.rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, material < 0 ? outer : material);
    s.document.settings.path.light_sampling = how;
    s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(salt));
    return render(s.document);
  };
  constexpr float kShares[] = {0.4f, 0.6f * 0.75f, 0.6f * 0.25f};
  const Film parts[] = {picture(0, LightSampling::mis, 2, 1024), picture(1, LightSampling::mis, 3, 1024),
                        picture(2, LightSampling::mis, 4, 1024)};
  int salt = 5;
  for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis}) {
    const Film mixed = picture(-1, how, salt++, 1024);
    RunningStatistics difference[3];
    double mean[3] = {0, 0, 0};
    for (int y = 0; y < mixed.height(); ++y)
      for (int x = 0; x < mixed.width(); ++x)
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int k = 0; k < 3; ++k)
            sum += static_cast<double>(kShares[k]) * static_cast<double>(parts[k].mean(x, y)[c]);
          difference[c].add(static_cast<double>(mixed.mean(x, y)[c]) - sum);
          mean[c] += sum / (mixed.width() * mixed.height());
        }
    for (int c = 0; c < 3; ++c) {
      EXPECT_GT(z_test(difference[c], 0, 1e-5 * mean[c]), sidak_threshold(9))
          << static_cast<int>(how) << ": off by " << difference[c].mean() << " of " << mean[c] << "; "
          << seed_note();
      EXPECT_LT(6 * std::sqrt(difference[c].variance_of_mean()), 0.02 * mean[c]) << "too few samples to tell";
    }
  }
}

TEST(BlendRender, WhittedFollowsTheRefractionsOfAllParts) {
  // A pane of two glasses over a sky: all that is not reflected comes through.
  SceneMaker s = wall();
  Material glass = lossless("dielectric", 1.5f), diamond = lossless("dielectric", 2.4f);
  s.sphere({0, 0, 0}, 1, blend(s, s.material(glass), s.material(diamond), 0.5f));
  look_at_centre(s, {0.4f, 0.2f, 3});
  s.document.settings.path.max_depth = 3; // reflection, and refraction with one more surface
  s.document.settings.path.rr = RussianRoulette::off;
  s.document.settings.stop.spp = 4096;
  s.document.settings.path.split = 1;
  s.document.settings.sampler.type = SamplerType::independent;
  const Film by_paths = render(s.document);
  s.document.settings.integrator = Integrator::whitted;
  s.document.settings.stop.spp = 1;
  const double exact = static_cast<double>(render(s.document).mean(0, 0).x);
  EXPECT_GT(z_test(over_pixels(by_paths, 0), exact, 1e-4), sidak_threshold(1)) << seed_note();
}

/// A floor under a lamp, and a ball of that material between them and before the camera.
Document floor_under_lamp(const std::function<int(SceneMaker&)>& make) {
  SceneMaker s(16, 16, 16);
  s.rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, s.diffuse(vec3(0.5f)));
  s.rectangle({0, 3, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, s.diffuse(vec3(0), vec3(9)));
  s.constant_light(vec3(0.3f));
  if (make) {
    s.sphere({0, 1.5f, 0}, 1, make(s));
    s.sphere({0, 2, 3}, 0.5f, static_cast<int>(s.document.scene.materials.size()) - 1);
  }
  s.camera({0, 2, 4}, {0, 0, 0}, 40);
  s.document.settings.sampler.seed = 11;
  return s.document;
}

TEST(NullRender, IsNotThere) {
  const Document without = floor_under_lamp({});
  const Document with = floor_under_lamp([](SceneMaker& s) { return null(s); });
  for (Integrator integrator : {Integrator::path, Integrator::direct, Integrator::whitted, Integrator::ao}) {
    Document a = without, b = with;
    a.settings.integrator = b.settings.integrator = integrator;
    const Film x = render(a), y = render(b);
    for (int i = 0; i < 16 * 16; ++i) {
      const vec3 expected = x.mean(i % 16, i / 16), seen = y.mean(i % 16, i / 16);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], expected[c], 1e-6f * std::max(expected[c], 1.0f) * 16)
            << i << ", " << static_cast<int>(integrator);
    }
  }
}

TEST(NullRender, IsNotThereForShadowRaysAndLampsBehindIt) {
  SceneMaker s(4, 1, 4);
  s.rectangle({0, 0, -1}, {3, 0, 0}, {0, 3, 0}, s.diffuse(vec3(0), vec3(2, 3, 4)));
  const int air = null(s);
  for (int i = 0; i < 20; ++i) s.rectangle({0, 0, 0.1f * static_cast<float>(i)}, {1, 0, 0}, {0, 1, 0}, air);
  look_at_centre(s, {0, 0, 5});
  for (Integrator integrator : {Integrator::path, Integrator::whitted}) {
    s.document.settings.integrator = integrator;
    EXPECT_EQ(render(s.document).mean(1, 0), vec3(2, 3, 4));
  }
}

TEST(NullRender, CarriesABodyThatAbsorbs) {
  SceneMaker s(8, 1, 4);
  const vec3 sigma(1, 0.5f, 0);
  s.sphere({0, 0, 0}, 1, null(s, sigma));
  s.sphere({0, 0, 0}, 0.1f, s.diffuse(vec3(0), vec3(1)));
  look_at_centre(s, {0, 0, 5});
  const vec3 seen = render(s.document).mean(0, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], std::exp(-0.9f * sigma[c]), 2e-4f);
}

TEST(NullRender, StaysInvisibleUnderTheOverrideAndWhateverItsRowsSay) {
  SceneMaker s(4, 1, 4);
  const int air = null(s);
  Material& m = s.document.scene.materials[static_cast<std::size_t>(air)];
  m.opacity = 1.0f;
  m.emission = vec3(5);
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, air);
  s.constant_light(vec3(0.25f));
  look_at_centre(s, {0, 0, 5});
  apply_setting(s.document, "override.brdf=diffuse");
  EXPECT_EQ(render(s.document).mean(0, 0), vec3(0.25f));
}

} // namespace
} // namespace candela::test
