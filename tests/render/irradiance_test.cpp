// Direct light on a diffuse plane against closed forms: radiance = albedo / pi * irradiance.

#include "render/closed_forms.h"
#include "render/render_testing.h"

namespace {

using namespace candela;
using namespace candela::test;

constexpr double kAlbedo = 0.6;

/// A plane y = 0 of diffuse reflectance kAlbedo, seen at the origin through so narrow a camera that all
/// pixels see one point; what shines is added by the test. Direct light only.
SceneMaker plane_scene(int spp, vec3 eye = {3, 2, 4}) {
  SceneMaker s(32, 16, spp);
  int plane = s.diffuse(vec3(static_cast<float>(kAlbedo)));
  s.rectangle({0, 0, 0}, {0, 0, 20}, {20, 0, 0}, plane);
  s.camera(eye, {0, 0, 0}, 0.002f);
  s.document.settings.path.max_depth = 2;
  return s;
}

struct Strategy {
  const char* name;
  LightSampling light;
  MisHeuristic heuristic;
  DirectionSampling direction;
  int light_samples;
  int spp_factor; ///< what chance needs more of
  double tolerance;
};

constexpr Strategy kStrategies[] = {
    {"nee", LightSampling::nee, MisHeuristic::power, DirectionSampling::bsdf, 1, 1, 1e-3},
    {"nee, 3 light samples", LightSampling::nee, MisHeuristic::power, DirectionSampling::bsdf, 3, 1, 1e-3},
    {"mis, power", LightSampling::mis, MisHeuristic::power, DirectionSampling::bsdf, 1, 1, 1e-3},
    {"mis, balance, uniform, 2 light samples", LightSampling::mis, MisHeuristic::balance,
     DirectionSampling::uniform, 2, 1, 1e-3},
    {"bsdf", LightSampling::bsdf, MisHeuristic::power, DirectionSampling::bsdf, 1, 1, 1e-2},
};

/// Every strategy that can find the light gives the irradiance; `slack` multiplies the tolerances where the
/// noise asks for it.
void expect_irradiance(const SceneMaker& scene, dvec3 irradiance, bool by_chance = true, double slack = 1) {
  int salt = 0;
  for (const Strategy& strategy : kStrategies) {
    if (strategy.light == LightSampling::bsdf && !by_chance) continue;
    SCOPED_TRACE(strategy.name);
    Document d = scene.document;
    d.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(++salt));
    d.settings.path.light_sampling = strategy.light;
    d.settings.path.mis_heuristic = strategy.heuristic;
    d.settings.path.direction_sampling = strategy.direction;
    d.settings.path.light_samples = strategy.light_samples;
    d.settings.path.rr = RussianRoulette::off; // its noise has tests of its own
    d.settings.stop.spp *= strategy.spp_factor;
    Film film = render(d);
    for (int c = 0; c < 3; ++c) {
      SCOPED_TRACE(c);
      double exact = kAlbedo / kPiD * irradiance[c];
      expect_radiance(over_pixels(film, c), exact, slack * strategy.tolerance, 15);
    }
  }
}

/// The plane's camera pixels are black, whatever the strategy.
void expect_dark(const SceneMaker& scene) {
  for (const Strategy& strategy : kStrategies) {
    SCOPED_TRACE(strategy.name);
    Document d = scene.document;
    d.settings.path.light_sampling = strategy.light;
    Film film = render(d);
    EXPECT_EQ(over_pixels(film, 1).mean(), 0);
  }
}

const vec3 kEmitted{3, 2, 1};

TEST(ClosedFormRender, SphereLightIrradianceIsTheConesCosineIntegral) {
  SceneMaker s = plane_scene(256);
  s.sphere({-1, 2.5f, 1}, 1.5f, s.diffuse(vec3(0), kEmitted));
  double distance = std::sqrt(1 + 2.5 * 2.5 + 1);
  expect_irradiance(s, dvec3(kEmitted) * sphere_irradiance(1.5, distance, 2.5 / distance));
}

TEST(ClosedFormRender, SmallFarSphereLightKeepsItsPrecision) {
  SceneMaker s = plane_scene(64);
  s.sphere({0, 500, 0}, 1, s.diffuse(vec3(0), 1e5f * kEmitted));
  expect_irradiance(s, 1e5 * dvec3(kEmitted) * sphere_irradiance(1, 500, 1), false);
}

TEST(ClosedFormRender, InsideATwoSidedSphereThereIsItsRadianceAllAround) {
  for (bool two_sided : {true, false}) {
    SceneMaker s = plane_scene(256, {0.3f, 0.2f, 0.4f});
    s.document.scene.instances.clear();
    s.rectangle({0, 0, 0}, {0, 0, 0.5f}, {0.5f, 0, 0}, 0);
    Material m;
    color(m, "diffuse") = vec3(0);
    m.emission = kEmitted;
    m.two_sided_emission = two_sided;
    s.sphere({0.5f, 0.25f, 0}, 2, s.material(m));
    if (two_sided)
      expect_irradiance(s, kPiD * dvec3(kEmitted));
    else
      expect_dark(s);
  }
}

TEST(ClosedFormRender, DiscLightOnItsAxis) {
  for (bool turned : {false, true}) { // away from the plane: it must be two-sided to shine there
    SceneMaker s = plane_scene(256);
    Material m;
    color(m, "diffuse") = vec3(0);
    m.emission = kEmitted;
    m.two_sided_emission = turned;
    vec3 x(1, 0, 0), z(0, 0, 1);
    s.disc({0, 1.25f, 0}, 1.5f, turned ? z : x, turned ? x : z, s.material(m));
    expect_irradiance(s, dvec3(kEmitted) * disc_irradiance(1.5, 1.25));
    if (turned) {
      s.document.scene.materials.back().two_sided_emission = false;
      expect_dark(s);
    }
  }
}

TEST(ClosedFormRender, ParallelRectangleLight) {
  for (bool turned : {false, true}) {
    SceneMaker s = plane_scene(256);
    Material m;
    color(m, "diffuse") = vec3(0);
    m.emission = kEmitted;
    m.two_sided_emission = turned;
    vec3 x(0.75f, 0, 0), z(0, 0, 1);
    s.rectangle({-0.75f, 1.5f, -1}, turned ? z : x, turned ? x : z, s.material(m));
    double factor = parallel_rectangle_factor(1.5, 2, 1.5);
    std::vector<dvec3> corners{{0, 1.5, 0}, {-1.5, 1.5, 0}, {-1.5, 1.5, -2}, {0, 1.5, -2}};
    EXPECT_NEAR(kPiD * factor, polygon_irradiance({0, 0, 0}, {0, 1, 0}, corners), 1e-12);
    expect_irradiance(s, kPiD * factor * dvec3(kEmitted));
    if (turned) {
      s.document.scene.materials.back().two_sided_emission = false;
      expect_dark(s);
    }
  }
}

TEST(ClosedFormRender, PerpendicularRectangleLight) {
  SceneMaker s = plane_scene(256);
  // In the plane x = -1 from its meeting line with the ground upwards: z from 0 to 2, y from 0 to 3; normal
  // +x.
  s.rectangle({-1, 1.5f, 1}, {0, 1.5f, 0}, {0, 0, 1}, s.diffuse(vec3(0), kEmitted));
  double factor = perpendicular_rectangle_factor(3, 2, 1);
  std::vector<dvec3> corners{{-1, 0, 0}, {-1, 3, 0}, {-1, 3, 2}, {-1, 0, 2}};
  EXPECT_NEAR(kPiD * factor, polygon_irradiance({0, 0, 0}, {0, 1, 0}, corners), 1e-12);
  expect_irradiance(s, kPiD * factor * dvec3(kEmitted));
}

TEST(ClosedFormRender, SmallFarRectangleLightIsSampledByArea) {
  SceneMaker s = plane_scene(64);
  s.rectangle({0, 100, 0}, {0.05f, 0, 0}, {0, 0, 0.05f}, s.diffuse(vec3(0), 1e6f * kEmitted));
  double e = kPiD * 4 * parallel_rectangle_factor(0.05, 0.05, 100);
  expect_irradiance(s, 1e6 * e * dvec3(kEmitted), false);
}

TEST(ClosedFormRender, ShearedRectangleLightIsAParallelogram) {
  SceneMaker s = plane_scene(2048);
  s.rectangle({-0.5f, 2.5f, 0}, {0.75f, 0, 0}, {0.5f, 0.25f, 1}, s.diffuse(vec3(0), kEmitted));
  dvec3 c(-0.5, 2.5, 0), x(0.75, 0, 0), y(0.5, 0.25, 1);
  std::vector<dvec3> corners{c - x - y, c + x - y, c + x + y, c - x + y};
  expect_irradiance(s, polygon_irradiance({0, 0, 0}, {0, 1, 0}, corners) * dvec3(kEmitted));
}

TEST(ClosedFormRender, TriangleMeshLight) {
  Mesh mesh;
  mesh.positions = {{-1, 1, -1}, {1, 1.5f, -1}, {1, 2, 1}, {-1, 1.5f, 1}}; // planar: y = 1.5 + x/4 + z/4
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};                                 // normal down
  std::vector<dvec3> corners(mesh.positions.begin(), mesh.positions.end());
  double e = polygon_irradiance({0, 0, 0}, {0, 1, 0}, corners);
  auto shared = std::make_shared<const Mesh>(mesh);
  SceneMaker once = plane_scene(1024);
  once.mesh_shared(shared, once.diffuse(vec3(0), kEmitted));
  expect_irradiance(once, e * dvec3(kEmitted));
  // Mirrored in the middle plane x = z it is itself with its winding turned over, and still shines downwards.
  SceneMaker mirrored = plane_scene(1024);
  mat4 swap(vec4(0, 0, 1, 0), vec4(0, 1, 0, 0), vec4(1, 0, 0, 0), vec4(0, 0, 0, 1));
  mirrored.mesh_shared(shared, mirrored.diffuse(vec3(0), kEmitted), swap);
  expect_irradiance(mirrored, e * dvec3(kEmitted));
}

TEST(ClosedFormRender, PointLightFallsOffWithTheSquare) {
  SceneMaker s = plane_scene(4);
  LightDesc l;
  l.model = PointLightModel{.position = {1, 2, -2}};
  l.color = kEmitted;
  l.scale = 5;
  s.document.scene.lights.push_back(l);
  expect_irradiance(s, 5.0 * dvec3(kEmitted) * (2.0 / 3) / 9.0); // at distance 3, under the cosine 2/3
}

TEST(ClosedFormRender, ProfilesShapePointsAndSpots) {
  auto profile = std::make_shared<IesProfile>();
  profile->vertical = {0, 0.5f * kPi}, profile->horizontal = {0}, profile->candela = {900, 0};
  const double angle = std::acos(2.0 / 3), candela = 900 * (1 - angle / (0.5 * kPiD));
  for (const LightDescModel& model :
       {LightDescModel(PointLightModel{.position = {1, 2, -2}, .profile = profile}),
        LightDescModel(SpotLightModel{
            .position = {1, 2, -2}, .cutoff_angle = 1.2f, .beam_width = 1, .profile = profile})}) {
    SceneMaker s = plane_scene(4);
    LightDesc l;
    l.model = model;
    l.color = kEmitted;
    s.document.scene.lights.push_back(l);
    expect_irradiance(s, candela / kDaylightEfficacy * dvec3(kEmitted) * (2.0 / 3) / 9.0);
  }
}

TEST(ClosedFormRender, AProjectorSendsItsPicture) {
  auto slide = std::make_shared<Panorama>();
  slide->image = {2, 1, {vec3(0.2f), vec3(0.8f)}};
  SceneMaker s = plane_scene(4);
  LightDesc l;
  l.model = ProjectorLightModel{.position = {1, 2, -2}, .direction = {-1, -2, 2}, .panorama = slide};
  l.color = 18.0f * kEmitted;
  s.document.scene.lights.push_back(l);
  expect_irradiance(s, dvec3(kEmitted) * 0.5 * 18.0 * (2.0 / 3) / 9.0); // between both texels
}

TEST(ClosedFormRender, SunAndSkyGiveWhatTheirRadianceIntegratesTo) {
  SceneMaker s = plane_scene(512);
  LightDesc l;
  l.model = SkyLightModel{.sun_elevation = radians(30.0f), .resolution = 64};
  l.color = 0.01f * kEmitted;
  s.document.scene.lights.push_back(l);
  const auto scene = RenderScene::build(s.document);
  dvec3 irradiance(0);
  constexpr int kRings = 300, kTurns = 600;
  for (int i = 0; i < kRings; ++i) // uniform in the square of the sine: by the cosine
    for (int k = 0; k < kTurns; ++k) {
      const double sine = std::sqrt((i + 0.5) / kRings), phi = 2 * kPiD * (k + 0.5) / kTurns;
      const vec3 d(dvec3(sine * std::cos(phi), std::sqrt(1 - sine * sine), sine * std::sin(phi)));
      irradiance += dvec3(std::get<EnvironmentLight>(scene->lights().at(0)).radiance_from(d));
    }
  irradiance *= kPiD / (kRings * kTurns);
  const SunDisc& sun = std::get<SunLight>(scene->lights().at(1)).disc;
  irradiance += dvec3(sun.irradiance) * static_cast<double>(sun.direction.y);
  expect_irradiance(s, irradiance, false, 2);
}

TEST(ClosedFormRender, DirectionalLightHasTheCosine) {
  SceneMaker s = plane_scene(4);
  LightDesc l;
  l.model = DirectionalLightModel{{2, -4, 4}}; // any length
  l.color = kEmitted;
  s.document.scene.lights.push_back(l);
  expect_irradiance(s, dvec3(kEmitted) * (2.0 / 3));
  s.document.scene.lights.back().model = DirectionalLightModel{{2, 4, 4}}; // from below
  expect_dark(s);
}

TEST(ClosedFormRender, ConstantLightGivesPiTimesItsRadiance) {
  SceneMaker s = plane_scene(64);
  s.constant_light(kEmitted);
  expect_irradiance(s, kPiD * dvec3(kEmitted));
}

TEST(ClosedFormRender, LightsOfAllKindsAdd) {
  SceneMaker s = plane_scene(512);
  s.sphere({-3, 2, 0}, 1, s.diffuse(vec3(0), kEmitted));
  double distance = std::sqrt(13.0);
  dvec3 e = dvec3(kEmitted) * sphere_irradiance(1, distance, 2 / distance);
  s.disc({0, 2, 0}, 1, {1, 0, 0}, {0, 0, 1}, s.diffuse(vec3(0), kEmitted));
  e += dvec3(kEmitted) * disc_irradiance(1, 2);
  LightDesc sun;
  sun.model = DirectionalLightModel{{-1, -1, 0}};
  sun.color = {0.5f, 1, 2};
  s.document.scene.lights.push_back(sun);
  e += dvec3(0.5, 1, 2) / std::numbers::sqrt2;
  LightDesc lamp;
  lamp.model = PointLightModel{.position = {0, 1, -1}};
  lamp.color = {1, 2, 1};
  s.document.scene.lights.push_back(lamp);
  e += dvec3(1, 2, 1) / (2 * std::numbers::sqrt2);
  expect_irradiance(s, e, true, 25);
}

} // namespace
