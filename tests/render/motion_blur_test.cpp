// Motion blur with closed forms.

#include "render/motion_testing.h"

namespace {

using namespace candela;
using namespace candela::test;

/// Share of the interval [lo, hi] and of the times of the open shutter that a bar covers, which lies over
/// [left, right] at time 0 and moves by `way` until time 1.
double covered(double lo, double hi, double left, double right, double way, double open, double close) {
  constexpr int kTimes = 20000; // of piecewise linear overlaps: exact to 1e-8
  double sum = 0;
  for (int i = 0; i < kTimes; ++i) {
    const double shift = way * (open + (close - open) * (i + 0.5) / kTimes);
    sum += std::max(std::min(hi, right + shift) - std::max(lo, left + shift), 0.0);
  }
  return sum / kTimes / (hi - lo);
}

/// Columns of the film, whose pixels are alike and of which a sample is 0 or 1, against the expected means:
/// by the binomial distribution, or a looser bound where so few samples are of one kind that it is not
/// normal.
template <class Expected>
void expect_columns(const Film& film, Expected expected) {
  int between = 0;
  for (int x = 0; x < film.width(); ++x) {
    double mean = 0;
    for (int y = 0; y < film.height(); ++y) mean += static_cast<double>(film.mean(x, y).x) / film.height();
    const double exact = expected(x), n = static_cast<double>(film.height() * film.count(x, 0)),
                 variance = n * exact * (1 - exact), off = std::abs(mean - exact) * n - 1e-4 * n; // rounding
    const double limit = variance > 50 ? 6.5 * std::sqrt(variance) : 8 * std::sqrt(variance) + 25;
    EXPECT_LT(off, limit) << "column " << x << ": " << mean << ", exact " << exact << "; " << seed_note();
    between += exact > 0.05 && exact < 0.95 ? 1 : 0;
  }
  EXPECT_GT(between, 4) << "there is a ramp";
}

constexpr int kColumns = 32, kRows = 24, kSpp = 64;
constexpr float kExtent = 3; ///< scene units of the film's height
/// Where a column of the film begins.
double column_begin(int x) { return kExtent / kRows * (x - 0.5 * kColumns); }

/// A bright bar, in front of nothing, that passes: each pixel shows its share of the shutter's time.
TEST(MotionBlurRender, ABarThatPassesIsARamp) {
  for (SamplerType type : {SamplerType::independent, SamplerType::sobol})
    for (auto [open, close] : {std::pair(0.0f, 1.0f), {0.25f, 0.625f}, {1.0f, 0.5f}}) {
      SceneMaker s(kColumns, kRows, kSpp);
      look_down(s, kExtent);
      s.rectangle({-1, 0, 0}, {0.4f, 0, 0}, {0, 9, 0}, s.diffuse(vec3(0), vec3(1)));
      s.document.scene.instances[0].motion = translation({2, 0, 0});
      open_shutter(s.document, open, close);
      s.document.settings.sampler.type = type;
      s.document.settings.sampler.seed = sampler_seed(1);
      expect_columns(render(s.document), [&, o = open, c = close](int x) {
        return covered(column_begin(x), column_begin(x + 1), -1.4, -0.6, 2, static_cast<double>(o),
                       static_cast<double>(c));
      });
    }
}

/// The same of a mesh whose vertices move, stretching: its left edge half as fast.
TEST(MotionBlurRender, AMeshThatStretchesIsARampOnEitherSide) {
  SceneMaker s(kColumns, kRows, kSpp);
  look_down(s, kExtent);
  Mesh mesh;
  mesh.positions = {{-1.4f, -9, 0}, {-0.6f, -9, 0}, {-0.6f, 9, 0}, {-1.4f, 9, 0}};
  mesh.positions_end = mesh.positions;
  for (vec3& p : mesh.positions_end) p.x += p.x < -1 ? 1.0f : 2.0f;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  s.mesh(std::move(mesh), s.diffuse(vec3(0), vec3(1)));
  open_shutter(s.document, 0, 1);
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.sampler.seed = sampler_seed(2);
  expect_columns(render(s.document), [&](int x) {
    const double lo = column_begin(x), hi = column_begin(x + 1);
    // Right of the left edge and left of the right edge, at all times.
    return covered(lo, hi, -1.4, 99, 1, 0, 1) - covered(lo, hi, -0.6, 99, 2, 0, 1);
  });
}

/// The shadow of a plate that passes, under parallel light: what is not told the time of the camera's ray
/// throws it elsewhere.
TEST(MotionBlurRender, TheShadowOfAPlateIsARamp) {
  for (Integrator integrator : {Integrator::path, Integrator::whitted}) {
    SceneMaker s(kColumns, kRows, kSpp);
    look_down(s, kExtent, 1);
    const int white = s.diffuse(vec3(1)), black = s.diffuse(vec3(0));
    s.rectangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, white);
    s.rectangle({-1, 0, 2}, {0.4f, 0, 0}, {0, 99, 0}, black); // behind the camera
    s.document.scene.instances[1].motion = translation({2, 0, 0});
    LightDesc sun;
    sun.model = DirectionalLightModel{};
    std::get<DirectionalLightModel>(sun.model).direction = {0, 0, -1};
    sun.color = vec3(kPi);
    s.document.scene.lights.push_back(sun);
    open_shutter(s.document, 0.25f, 1);
    s.document.settings.integrator = integrator;
    s.document.settings.path.max_depth = 2;
    s.document.settings.sampler.type = SamplerType::independent;
    s.document.settings.sampler.seed = sampler_seed(3);
    expect_columns(render(s.document), [&](int x) {
      return 1 - covered(column_begin(x), column_begin(x + 1), -1.4, -0.6, 2, 0.25, 1);
    });
  }
}

/// A bright blade of half width w that turns about the middle of the film once: at a distance r from there it
/// is seen for 4 asin(w / r) / 2 pi of the time.
TEST(MotionBlurRender, ABladeThatTurnsIsSeenForItsAngle) {
  constexpr int kSize = 32;
  SceneMaker s(kSize, kSize, 256);
  look_down(s, 2);
  s.rectangle({0, 0, 0}, {2, 0, 0}, {0, 0.1f, 0}, s.diffuse(vec3(0), vec3(1)));
  s.document.scene.instances[0].motion = rotation(radians(360.0f), {0, 0, 1});
  open_shutter(s.document, 0, 1);
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.sampler.seed = sampler_seed(4);
  const Film film = render(s.document);
  int pixels = 0;
  double difference = 0, variance = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      double exact = 0;
      for (int k = 0; k < 64; ++k) {
        const int column = k % 8, row = k / 8;
        const double px = (x + (column + 0.5) / 8 - 0.5 * kSize) * 2 / kSize,
                     py = (y + (row + 0.5) / 8 - 0.5 * kSize) * 2 / kSize;
        exact += 4 * std::asin(std::min(static_cast<double>(0.1f) / std::hypot(px, py), 1.0)) /
                 (2 * std::numbers::pi) / 64;
      }
      if (exact > 0.9) continue; // the hub, which midpoints are too coarse for
      ++pixels;
      const double p = static_cast<double>(film.mean(x, y).x);
      difference += p - exact, variance += exact * (1 - exact) / 256;
      // Of one pixel, by the normal approximation of 256 trials, far out, and what midpoints leave.
      EXPECT_NEAR(p, exact, 7.5 * std::sqrt(exact * (1 - exact) / 256) + 0.01) << x << ", " << y;
    }
  EXPECT_GT(pixels, 900);
  EXPECT_GT(normal_p_value(difference / std::sqrt(variance)), sidak_threshold(1)) << seed_note();
}

/// Lossless surfaces stay invisible in a furnace, however they and the camera move.
TEST(MotionBlurRender, TheWhiteFurnaceStaysWhite) {
  SceneMaker s(24, 24, 16);
  s.constant_light(vec3(1));
  s.camera({0.5f, 1, 6}, {0, 0, 0}, 40);
  const int diffuse = s.material(lossless("diffuse")), mirror = s.material(lossless("mirror")),
            glass = s.material(lossless("dielectric"));
  s.sphere({-1, 0, 0}, 0.7f, diffuse);
  s.sphere({1, 0, 0.5f}, 0.6f, glass);
  s.rectangle({0, -0.8f, 0}, {2, 0, 0}, {0, 0, -2}, mirror);
  Mesh sheet = deforming_sheet(8);
  sheet.normals.clear(), sheet.normals_end.clear(); // smooth ones lose what they would send below the surface
  s.mesh(std::move(sheet), diffuse, glm::translate(mat4(1), {0, 1, -1}));
  s.mesh(sphere_mesh(10, 14, false), glass, glm::translate(mat4(1), {0, 0.2f, 1}));
  auto& instances = s.document.scene.instances;
  instances[0].motion = translation({1, 0.5f, 0});
  instances[1].motion = rotation(2, {0, 0, 1}, {0.5f, 0.5f, 0});
  instances[1].motion.scale = {1.5f, 1, 0.7f};
  instances[2].motion = rotation(0.3f, {1, 0, 0});
  instances[3].motion = translation({0, 0, 1});
  instances[4].motion = rotation(7, {1, 1, 0});
  Camera& camera = s.document.scene.camera;
  camera.motion_position = {0.5f, 0, -0.5f}, camera.motion_target = {0, 0.3f, 0}, camera.motion_fov = 0.2f;
  open_shutter(s.document, 0, 1);
  s.document.settings.path.light_sampling = LightSampling::bsdf;
  s.document.settings.path.rr = RussianRoulette::off;
  s.document.settings.path.max_depth = 1000000;
  s.document.settings.sampler.seed = sampler_seed(5);
  const Film film = render(s.document);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(film.mean(x, y)[c], 1, 1e-3) << "pixel " << x << ", " << y << "; " << seed_note();
}

} // namespace
