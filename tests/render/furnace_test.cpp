// Furnace tests: in a furnace of radiance 1, surfaces without absorption are invisible, and a slab's
// absorption and reflections have closed forms.

#include "render/closed_forms.h"
#include "render/render_testing.h"

namespace {

using namespace candela;
using namespace candela::test;

/// Every pixel is 1 to within 1e-3. The sampling that leaves no noise is taken: without it, this would be a
/// test of patience.
void expect_invisible(SceneMaker s) {
  s.constant_light(vec3(1));
  s.camera({0.5f, 1, 6}, {0, 0, 0}, 30);
  s.document.settings.path.light_sampling = LightSampling::bsdf;
  s.document.settings.path.rr =
      RussianRoulette::off; // some paths in glass are long, and roulette would be noise
  s.document.settings.path.max_depth = 1000000;
  s.document.settings.sampler.seed = sampler_seed(1);
  Film film = render(s.document);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(film.mean(x, y)[c], 1, 1e-3) << "pixel " << x << ", " << y << "; " << seed_note();
}

std::string note(const Material& m) {
  const float ior = has(m, "ior") ? number(m, "ior") : 0;
  return std::string(material_type_name(m)) + " " + std::to_string(ior);
}

std::vector<Material> lossless_materials() {
  std::vector<Material> all{lossless("diffuse"), lossless("mirror")};
  for (float ior : {1.0f, 1.0001f, 1.33f, 1.5f, 2.4f, 0.7f}) all.push_back(lossless("dielectric", ior));
  return all;
}

TEST(FurnaceRender, SphereIsInvisible) {
  for (const Material& m : lossless_materials()) {
    SCOPED_TRACE(note(m));
    SceneMaker s(16, 16, 16);
    s.sphere({0, 0, 0}, 1.2f, s.material(m));
    expect_invisible(s);
  }
}

TEST(FurnaceRender, FlatMeshIsInvisibleBakedOrInstanced) {
  auto small = std::make_shared<const Mesh>(sphere_mesh(12, 20, false));
  auto large = std::make_shared<const Mesh>(sphere_mesh(40, 60, false)); // too many triangles to bake twice
  for (const Material& m : lossless_materials()) {
    SCOPED_TRACE(note(m));
    SceneMaker s(16, 16, 8);
    int mat = s.material(m);
    s.mesh_shared(small, mat, glm::translate(mat4(1), {0, 1, 0}));
    for (float x : {-1.0f, 1.0f}) {
      mat4 place = glm::translate(mat4(1), {x, -0.5f, 0});
      s.mesh_shared(large, mat, glm::scale(place, {0.8f * x, 0.6f, 0.9f})); // one of them mirrored
    }
    expect_invisible(s);
  }
}

TEST(FurnaceRender, CoarseSmoothMeshesOfMirrorAndGlassAreInvisible) {
  // Interpolated normals make directions that would go through the surface; those are folded back.
  for (Integrator integrator : {Integrator::path, Integrator::whitted})
    for (const Material& m : lossless_materials()) {
      // Whitted's integrator has roulette of its own, which in glass is noise.
      const bool is_glass = material_type_name(m) == "dielectric";
      if (material_type_name(m) == "diffuse" || (is_glass && integrator == Integrator::whitted)) continue;
      SCOPED_TRACE(note(m));
      SceneMaker s(48, 48, 4);
      s.document.settings.integrator = integrator;
      s.mesh(sphere_mesh(6, 10, true), s.material(m), glm::scale(mat4(1), vec3(1.2f)));
      expect_invisible(s);
    }
}

TEST(FurnaceRender, CoarseSmoothMeshesOfGlossLoseNoMoreThanTheirLobes) {
  // Each pixel is the albedo at its cosine with the shading normal, which is little below 1 where that is not
  // near 0.
  for (LightSampling sampling : {LightSampling::bsdf, LightSampling::mis}) {
    Material m = lossless("ggx");
    number(m, "roughness") = 0.1f;
    SceneMaker s(48, 48, 64);
    s.mesh(sphere_mesh(6, 10, true), s.material(m), glm::scale(mat4(1), vec3(1.2f)));
    s.constant_light(vec3(1));
    s.camera({0.5f, 1, 6}, {0, 0, 0}, 30);
    s.document.settings.path.light_sampling = sampling;
    s.document.settings.sampler.seed = sampler_seed(5);
    const Film film = render(s.document);
    float least = 1;
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) least = std::min(least, film.mean(x, y).g);
    EXPECT_GT(least, 0.4f) << "at its very rim";
    EXPECT_GT(over_pixels(film, 1).mean(), 0.99);
    EXPECT_LT(over_pixels(film, 1).mean(), 1.001);
  }
}

TEST(FurnaceRender, SmoothDiffuseMeshLosesALittleAndGainsNothing) {
  // What Lambertian surfaces scatter to their wrong side is dropped, so light may be lost, never won. For a
  // fine mesh it is little.
  for (const Material& m : {lossless("diffuse")}) {
    SceneMaker s(16, 16, 16);
    s.mesh(sphere_mesh(48, 96, true), s.material(m), glm::scale(mat4(1), vec3(1.2f)));
    s.constant_light(vec3(1));
    s.camera({0.5f, 1, 6}, {0, 0, 0}, 30);
    s.document.settings.path.light_sampling = LightSampling::bsdf;
    s.document.settings.sampler.seed = sampler_seed(2);
    Film film = render(s.document);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) EXPECT_LE(film.mean(x, y).g, 1.001f);
    EXPECT_GT(over_pixels(film, 1).mean(), 0.98);
  }
}

TEST(FurnaceRender, ConcaveMeetingsOfDiffuseSurfacesAreInvisible) {
  SceneMaker s(16, 16, 16);
  int white = s.material(lossless("diffuse"));
  s.rectangle({0, -1, 0}, {0, 0, 3}, {3, 0, 0}, white);
  s.sphere({0, 0, 0}, 1, white);
  s.disc({-1.5f, 0, 0}, 1, {0, 1, 0}, {0, 0, 1}, white);
  s.document.settings.path.rr = RussianRoulette::off;
  expect_invisible(s);
}

TEST(FurnaceRender, LensAndFilterChangeNothing) {
  SceneMaker s(16, 16, 16);
  s.sphere({0, 0, 0}, 1.2f, s.material(lossless("diffuse")));
  s.document.scene.camera.aperture_radius = 0.3f;
  s.document.scene.camera.focus_distance = 4;
  s.document.settings.film.filter = FilterType::gaussian;
  s.document.settings.film.filter_radius = 2;
  expect_invisible(s);
}

TEST(FurnaceRender, MisAndAimingGiveOneInTheMean) {
  for (LightSampling light : {LightSampling::nee, LightSampling::mis})
    for (std::string_view type : {"diffuse", "mirror"}) {
      SceneMaker s(16, 16, 64);
      Material m = lossless(type);
      if (type == "mirror") color(m, "specular") = vec3(0.5f), color(m, "diffuse") = vec3(0.5f);
      s.sphere({0, 0, 0}, 50, s.material(m));
      s.constant_light(vec3(1));
      s.camera({0, 0, 200}, {0, 0, 0}, 10);
      s.document.settings.path.light_sampling = light;
      s.document.settings.path.mis_heuristic = MisHeuristic::balance;
      s.document.settings.path.direction_sampling = DirectionSampling::uniform;
      s.document.settings.sampler.seed = sampler_seed(3);
      expect_radiance(over_pixels(render(s.document), 1), 1, 1e-2, 4);
    }
}

/// A slab of thickness 0.5 between z = 0 and -0.5, seen along its normal.
SceneMaker slab(float ior, vec3 absorption, int spp) {
  SceneMaker s(32, 16, spp);
  Material m = lossless("dielectric", ior);
  color(m, "absorption") = absorption;
  int glass = s.material(m);
  s.rectangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, glass);
  s.rectangle({0, 0, -0.5f}, {0, 9, 0}, {9, 0, 0}, glass);
  s.camera({0, 0, 4}, {0, 0, 0}, 0.01f);
  s.document.settings.sampler.seed = sampler_seed(4);
  return s;
}
const vec3 kSigma(0.2f, 1, 3);

TEST(FurnaceRender, AbsorptionFollowsBeerAndLambert) {
  SceneMaker s = slab(1, kSigma, 2);
  s.constant_light({1, 2, 3});
  s.document.settings.path.rr = RussianRoulette::off;
  Film film = render(s.document);
  for (int c = 0; c < 3; ++c) {
    double exact = (1 + c) * std::exp(-0.5 * static_cast<double>(kSigma[c]));
    for (int x = 0; x < 32; ++x) EXPECT_NEAR(film.mean(x, 3)[c], exact, 1e-4 * exact);
  }
}

TEST(FurnaceRender, SlabSumsItsInternalReflections) {
  double r = normal_reflectance(1.5);
  for (RussianRoulette rr : {RussianRoulette::off, RussianRoulette::throughput}) {
    // Light from everywhere shows transmission and reflection, a light behind the slab transmission alone.
    SceneMaker everywhere = slab(1.5f, kSigma, 256), behind = slab(1.5f, kSigma, 256);
    everywhere.constant_light(vec3(1));
    behind.rectangle({0, 0, -3}, {9, 0, 0}, {0, 9, 0}, behind.diffuse(vec3(0), vec3(1)));
    everywhere.document.settings.path.rr = behind.document.settings.path.rr = rr;
    Film both = render(everywhere.document), transmitted = render(behind.document);
    for (int c = 0; c < 3; ++c) {
      SCOPED_TRACE(c);
      double a = std::exp(-0.5 * static_cast<double>(kSigma[c]));
      double t = slab_transmission(r, a);
      expect_radiance(over_pixels(transmitted, c), t, 3e-2, 12);
      expect_radiance(over_pixels(both, c), t + slab_reflection(r, a), 3e-2, 12);
    }
  }
}

TEST(FurnaceRender, TintActsAtEachCrossing) {
  SceneMaker s = slab(1, vec3(0), 2);
  color(s.document.scene.materials[0], "transmittance") = {0.5f, 0.9f, 1};
  s.constant_light(vec3(1));
  s.document.settings.path.rr = RussianRoulette::off;
  Film film = render(s.document);
  EXPECT_NEAR(film.mean(5, 5).r, 0.25f, 1e-5f);
  EXPECT_NEAR(film.mean(5, 5).g, 0.81f, 1e-5f);
  EXPECT_NEAR(film.mean(5, 5).b, 1, 1e-5f);
}

} // namespace
