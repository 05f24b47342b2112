// Images with closed forms.

#include "render/closed_forms.h"
#include "render/render_testing.h"

namespace {

using namespace candela;
using namespace candela::test;

// --- The Cornell box ---

/// Where the camera sees the plane z = z0, in double precision: the camera of scenes.h looks along +z,
/// upright, so its right is -x.
dvec3 cornell_wall_point(dvec3 eye, double fov, int size, double px, double py, double z0) {
  double pixel = 2 * std::tan(0.5 * fov) / size;
  dvec3 d(-(px - 0.5 * size) * pixel, -(py - 0.5 * size) * pixel, 1);
  return eye + d * ((z0 - eye.z) / d.z);
}

/// Mean over the pixel of albedo / pi * Le * E(Lambert) on the back wall; midpoints of 8 x 8 cells, whose
/// error is far below 1e-5 for the slowly varying E.
double cornell_exact(const Camera& camera, int size, int x, int y, double albedo, double emission) {
  const std::vector<dvec3> light{
      {213, 548.8f, 227}, {343, 548.8f, 227}, {343, 548.8f, 332}, {213, 548.8f, 332}};
  double sum = 0;
  constexpr int kCells = 8;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      dvec3 p =
          cornell_wall_point(dvec3(camera.position), static_cast<double>(camera.vertical_fov), size,
                             x + (i + 0.5) / kCells, y + (j + 0.5) / kCells, static_cast<double>(559.2f));
      sum += polygon_irradiance(p, {0, 0, -1}, light);
    }
  return albedo / kPiD * emission * sum / (kCells * kCells);
}

/// Pixels that see the back wall above both blocks (y > 340: nothing hides the light from there) but not
/// close to the ceiling, where the light is seen so edge-on that a pixel's noise is largest.
std::vector<ivec2> upper_wall_pixels(const Camera& camera, int size) {
  std::vector<ivec2> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      bool inside = true;
      for (int corner = 0; corner < 4; ++corner) {
        dvec3 p = cornell_wall_point(dvec3(camera.position), static_cast<double>(camera.vertical_fov), size,
                                     x + corner % 2, y + (corner < 2 ? 0 : 1), 559.2);
        inside &= p.x > 1 && p.x < 551 && p.y > 340 && p.y < 510;
      }
      if (inside) pixels.emplace_back(x, y);
    }
  return pixels;
}

/// Every pixel to within `tolerance`, their mean to within 0.1 %, and independent samples no farther off than
/// their variance says.
void expect_cornell(bool blocks, LightSampling light, MisHeuristic heuristic, double tolerance, int spp) {
  constexpr int kSize = 24;
  SceneMaker s = cornell_flush(kSize, kSize, spp, blocks);
  s.document.settings.path.component = PathComponent::direct;
  s.document.settings.path.light_sampling = light;
  s.document.settings.path.mis_heuristic = heuristic;
  const Camera& camera = s.document.scene.camera;
  std::vector<ivec2> pixels = upper_wall_pixels(camera, kSize);
  ASSERT_GE(pixels.size(), 30u);
  PassOptions options;
  for (ivec2 p : pixels) { // the smallest window of them all
    if (options.crop.width == 0) options.crop = {p.x, p.y, 1, 1};
    int x1 = std::max(options.crop.x + options.crop.width, p.x + 1), y1 = p.y + 1;
    options.crop.x = std::min(options.crop.x, p.x);
    options.crop.width = x1 - options.crop.x;
    options.crop.height = y1 - options.crop.y;
  }
  for (SamplerType type : {SamplerType::sobol, SamplerType::independent}) {
    s.document.settings.sampler.type = type;
    s.document.settings.stop.spp = type == SamplerType::sobol ? spp : 6144;
    s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(light) * 2 + blocks);
    Film film = render(s.document, options);
    double chi_square = 0, relative_sum = 0, relative_variance = 0;
    for (ivec2 p : pixels) {
      double exact = cornell_exact(camera, kSize, p.x, p.y, 0.725, 17);
      double mean = static_cast<double>(film.mean(p.x, p.y).r);
      double variance = static_cast<double>(film.variance_of_mean(p.x, p.y).r);
      if (type == SamplerType::sobol)
        EXPECT_NEAR(mean, exact, tolerance * exact) << p.x << " " << p.y << "; " << seed_note();
      else
        chi_square += (mean - exact) * (mean - exact) / variance;
      relative_sum += mean / exact - 1;
      relative_variance += variance / (exact * exact);
    }
    auto n = static_cast<double>(pixels.size());
    if (type == SamplerType::sobol) {
      EXPECT_NEAR(relative_sum / n, 0, 1e-3) << seed_note();
    } else {
      EXPECT_GT(chi_square_p_value(chi_square, n), sidak_threshold(2)) << seed_note();
      EXPECT_GT(normal_p_value(relative_sum / std::sqrt(relative_variance)), sidak_threshold(2))
          << "relative error " << relative_sum / n << "; " << seed_note();
      EXPECT_LT(std::sqrt(relative_variance) / n, 4e-4) << "too few samples to tell";
    }
  }
}

TEST(ClosedFormRender, CornellWallByAimingAtTheLight) {
  expect_cornell(false, LightSampling::nee, MisHeuristic::power, 1e-3, 16384);
}
TEST(ClosedFormRender, CornellWallByMis) {
  expect_cornell(true, LightSampling::mis, MisHeuristic::power, 5e-3, 16384);
}
TEST(ClosedFormRender, CornellWallByMisWithTheBalanceHeuristic) {
  expect_cornell(false, LightSampling::mis, MisHeuristic::balance, 5e-3, 16384);
}
TEST(ClosedFormRender, CornellWallWithBlocksByAimingAtTheLight) {
  expect_cornell(true, LightSampling::nee, MisHeuristic::power, 1e-3, 16384);
}

TEST(ClosedFormRender, CornellWallByChance) {
  constexpr int kSize = 24;
  SceneMaker s = cornell_flush(kSize, kSize, 2048, true);
  s.document.settings.path.component = PathComponent::direct;
  s.document.settings.path.light_sampling = LightSampling::bsdf;
  s.document.settings.sampler.seed = sampler_seed(9);
  std::vector<ivec2> pixels = upper_wall_pixels(s.document.scene.camera, kSize);
  PassOptions options;
  options.crop = {0, 0, kSize, pixels.back().y + 1};
  Film film = render(s.document, options);
  double sum = 0, variance = 0;
  for (ivec2 p : pixels) {
    double exact = cornell_exact(s.document.scene.camera, kSize, p.x, p.y, 0.725, 17);
    sum += static_cast<double>(film.mean(p.x, p.y).r) - exact;
    variance += static_cast<double>(film.variance_of_mean(p.x, p.y).r);
  }
  // Sobol' samples spread better than the variance of independent ones says, which is on the safe side.
  EXPECT_GT(normal_p_value(sum / std::sqrt(variance)), kFalseAlarm) << seed_note();
}

// --- The closed box: walls of reflectance rho that all shine with Le. Radiance after k segments is
//     Le (1 + rho + ... + rho^(k-1)), Le / (1 - rho) without end. ---

const dvec3 kRho(0.5, 0.25, 0.75), kLe(1, 2, 0.5);

SceneMaker shining_box(int width, int height, int spp) {
  SceneMaker s(width, height, spp);
  s.closed_box({-1, -1.5f, -2}, {1, 1.5f, 2}, s.diffuse(vec3(kRho), vec3(kLe)));
  s.camera({0.3f, 0.2f, 1}, {-0.5f, 0, -1}, 70);
  return s;
}

TEST(ClosedFormRender, ClosedBoxSumsTheGeometricSeries) {
  struct Roulette {
    RussianRoulette how;
    int depth;
    float probability;
  };
  int salt = 20;
  for (LightSampling light : {LightSampling::nee, LightSampling::mis, LightSampling::bsdf})
    for (Roulette rr :
         {Roulette{RussianRoulette::throughput, 3, 0}, Roulette{RussianRoulette::throughput, 0, 0},
          Roulette{RussianRoulette::fixed, 5, 0.9f}, Roulette{RussianRoulette::fixed, 1, 0.8f}}) {
      SCOPED_TRACE(static_cast<int>(light));
      SCOPED_TRACE(rr.depth);
      SceneMaker s = shining_box(16, 16, light == LightSampling::nee ? 256 : 128);
      PathSettings& path = s.document.settings.path;
      path.light_sampling = light;
      path.rr = rr.how;
      path.rr_depth = rr.depth;
      path.rr_probability = rr.probability;
      s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(++salt));
      Film film = render(s.document);
      for (int c = 0; c < 3; ++c) expect_radiance(over_pixels(film, c), kLe[c] / (1 - kRho[c]), 5e-2, 36);
    }
}

TEST(ClosedFormRender, ClosedBoxWithoutRouletteIsExactInEveryPixel) {
  // By chance alone and with the BSDF's own directions no path differs from another: there is no noise.
  SceneMaker s = shining_box(16, 8, 2);
  s.document.settings.path.rr = RussianRoulette::off;
  s.document.settings.path.light_sampling = LightSampling::bsdf;
  Film film = render(s.document);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) {
        double exact = kLe[c] / (1 - kRho[c]);
        EXPECT_NEAR(film.mean(x, y)[c], exact, 2e-5 * exact);
      }
}

TEST(ClosedFormRender, ClosedBoxByMisIsRightToATenthOfAPercent) {
  SceneMaker s = shining_box(32, 16, 384);
  s.document.settings.path.rr = RussianRoulette::fixed;
  s.document.settings.path.rr_depth = 6;
  s.document.settings.sampler.seed = sampler_seed(19);
  Film film = render(s.document);
  for (int c = 0; c < 3; ++c) {
    double exact = kLe[c] / (1 - kRho[c]);
    EXPECT_NEAR(over_pixels(film, c).mean(), exact, 1e-3 * exact) << seed_note();
    EXPECT_LT(std::sqrt(over_pixels(film, c).variance_of_mean()), 2.5e-4 * exact)
        << "too few samples to tell";
  }
}

TEST(ClosedFormRender, DepthCountsSegmentsAndComponentsArePartsOfTheSum) {
  struct Case {
    PathComponent component;
    int max_depth;
    int first, last; ///< powers of rho in the sum
  };
  int salt = 40;
  for (Case k : {Case{PathComponent::all, 0, 0, -1}, Case{PathComponent::all, 1, 0, 0},
                 Case{PathComponent::all, 2, 0, 1}, Case{PathComponent::all, 3, 0, 2},
                 Case{PathComponent::all, 7, 0, 6}, Case{PathComponent::emitted, 5, 0, 0},
                 Case{PathComponent::emitted, -1, 0, 0}, Case{PathComponent::direct, 5, 1, 1},
                 Case{PathComponent::direct, -1, 1, 1}, Case{PathComponent::direct, 1, 1, 0},
                 Case{PathComponent::indirect, 2, 2, 1}, Case{PathComponent::indirect, 3, 2, 2},
                 Case{PathComponent::indirect, 5, 2, 4}}) {
    SCOPED_TRACE(static_cast<int>(k.component));
    SCOPED_TRACE(k.max_depth);
    for (LightSampling light : {LightSampling::bsdf, LightSampling::mis}) {
      SceneMaker s = shining_box(16, 8, light == LightSampling::bsdf ? 2 : 64);
      PathSettings& path = s.document.settings.path;
      path.rr = RussianRoulette::off;
      path.light_sampling = light;
      path.component = k.component;
      path.max_depth = k.max_depth;
      s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(++salt));
      Film film = render(s.document);
      for (int c = 0; c < 3; ++c) {
        double exact = 0;
        for (int i = k.first; i <= k.last; ++i) exact += kLe[c] * std::pow(kRho[c], i);
        RunningStatistics pixels = over_pixels(film, c);
        if (exact == 0)
          EXPECT_EQ(pixels.mean(), 0);
        else if (light == LightSampling::bsdf)
          EXPECT_NEAR(pixels.mean(), exact, 1e-5 * exact);
        else
          expect_radiance(pixels, exact, 5e-2, 36);
      }
    }
  }
}

TEST(ClosedFormRender, ComponentsOfOneSampleAddUpToAll) {
  SceneMaker s = cornell_flush(8, 8, 1, true);
  s.document.settings.sampler.seed = sampler_seed(60);
  auto scene = RenderScene::build(s.document);
  int lit = 0;
  for (unsigned i = 0; i < 512; ++i) {
    uvec2 pixel(i % 8, i / 8 % 8);
    auto sample = [&](PathComponent component) {
      Document d = s.document;
      d.settings.path.component = component;
      return replay_sample(*scene, d, pixel, i / 64);
    };
    vec3 all = sample(PathComponent::all);
    vec3 parts =
        sample(PathComponent::emitted) + sample(PathComponent::direct) + sample(PathComponent::indirect);
    lit += !is_black(sample(PathComponent::indirect));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(parts[c], all[c], 1e-5f * all[c] + 1e-7f);
  }
  EXPECT_GT(lit, 100);
}

// --- Opacity ---

TEST(ClosedFormRender, HalfTransparentPlanesPassPowersOfTheRest) {
  for (int planes : {1, 2, 5}) {
    SceneMaker s(32, 16, 256);
    s.constant_light({1, 2, 3});
    Material m;
    color(m, "diffuse") = vec3(0);
    m.opacity = 0.3f;
    int mat = s.material(m);
    for (int i = 0; i < planes; ++i) s.rectangle({0, 0, -static_cast<float>(i)}, {9, 0, 0}, {0, 9, 0}, mat);
    s.camera({0, 0, 5}, {0, 0, 0}, 30);
    s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(70 + planes));
    Film film = render(s.document);
    for (int c = 0; c < 3; ++c)
      expect_radiance(over_pixels(film, c), (1 + c) * std::pow(1 - 0.3, planes), 4e-2, 9);
  }
}

TEST(ClosedFormRender, ShadowRaysAreWeakenedByTransparentPlanes) {
  // A sun and a rectangle light through three planes, far from the origin so that positions round; the planes
  // lie askew so that nothing is exact by luck.
  for (bool sun : {true, false})
    for (LightSampling light : {LightSampling::nee, LightSampling::mis}) {
      SCOPED_TRACE(sun);
      vec3 o(3000, 1000, -2000);
      SceneMaker s(32, 16, sun ? 4 : 256);
      s.rectangle(o, {0, 0, 30}, {30, 0, 0}, s.diffuse(vec3(0.6f)));
      Material m;
      color(m, "diffuse") = vec3(0);
      m.opacity = 0.25f;
      int mat = s.material(m);
      for (float h : {1.0f, 1.5f, 2.0f}) s.rectangle(o + vec3(0, h, 0), {5, 0.1f, 0}, {0, 0.05f, 5}, mat);
      double exact = 0.6 / kPiD;
      if (sun) {
        LightDesc l;
        l.model = DirectionalLightModel{};
        s.document.scene.lights.push_back(l);
      } else {
        s.rectangle(o + vec3(0, 4, 0), {1, 0, 0}, {0, 0, 1}, s.diffuse(vec3(0), vec3(1)));
        exact *= kPiD * 4 * parallel_rectangle_factor(1, 1, 4);
      }
      s.camera(o + vec3(3, 0.5f, 4), o, 0.002f); // below the planes
      s.document.settings.path.max_depth = 2;
      s.document.settings.path.light_sampling = light;
      s.document.settings.sampler.seed = sampler_seed(80 + sun);
      expect_radiance(over_pixels(render(s.document), 0), exact * std::pow(0.75, 3), sun ? 1e-3 : 5e-3, 4);
    }
}

TEST(ClosedFormRender, AHalfTransparentLightShinesHalf) {
  for (LightSampling light : {LightSampling::nee, LightSampling::mis, LightSampling::bsdf}) {
    SCOPED_TRACE(static_cast<int>(light));
    SceneMaker s(32, 16, 512);
    s.rectangle({0, 0, 0}, {0, 0, 20}, {20, 0, 0}, s.diffuse(vec3(0.6f)));
    Material m;
    color(m, "diffuse") = vec3(0);
    m.emission = vec3(2);
    m.opacity = 0.4f;
    s.rectangle({0, 2, 0}, {2, 0, 0}, {0, 0, 2}, s.material(m));
    s.camera({3, 1, 4}, {0, 0, 0}, 0.002f);
    s.document.settings.path.max_depth = 2;
    s.document.settings.path.light_sampling = light;
    s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(light) + 90);
    double exact = 0.6 * 2 * 0.4 * 4 * parallel_rectangle_factor(2, 2, 2);
    expect_radiance(over_pixels(render(s.document), 1), exact, 2e-2, 3);
  }
}

} // namespace
