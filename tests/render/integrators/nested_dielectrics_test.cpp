// Bodies that overlap and rank by priority, against closed forms and against scenes whose interfaces are
// modelled one by one.

#include "materials/bsdf.h"
#include "render/denoise/feature_film.h"
#include "render/film/replay.h"
#include "render/integrators/media_at.h"
#include "render/render_testing.h"

namespace candela::test {
namespace {

constexpr float kWater = 1.33f, kGlass = 1.5f, kIce = 1.31f;
const vec3 kWaterAbsorbs(0.9f, 0.3f, 0), kGlassAbsorbs(0.1f, 0.4f, 0.2f);

int body(SceneMaker& s, float ior, int priority, vec3 absorption = vec3(0)) {
  Material m;
  m.model = DielectricMaterial{.ior = ior, .absorption = absorption, .priority = priority};
  return s.material(m);
}

int lamp(SceneMaker& s, float radiance = 1) { return s.diffuse(vec3(0), vec3(radiance)); }

/// A box from z = lo to hi. No wider than need be: rays start off surfaces by their rounding.
void slab(SceneMaker& s, float lo, float hi, int material) {
  const mat4 m =
      glm::translate(mat4(1), {0, 0, 0.5f * (lo + hi)}) * glm::scale(mat4(1), {8, 8, 0.5f * (hi - lo)});
  s.document.scene.instances.push_back({"", CubeShape{}, m, {material}});
}

/// Share of unpolarised light that goes through an interface, and the sine behind it.
struct Crossing {
  double transmitted, sine;
};
Crossing cross(double ior_from, double ior_to, double sine) {
  const double behind = sine * ior_from / ior_to, c = std::sqrt(1 - sine * sine),
               d = std::sqrt(1 - behind * behind);
  const double s = (ior_from * c - ior_to * d) / (ior_from * c + ior_to * d),
               p = (ior_to * c - ior_from * d) / (ior_to * c + ior_from * d);
  return {1 - 0.5 * (s * s + p * p), behind};
}

/// What comes straight through layers of these refractive indices and depths, from vacuum to vacuum.
struct Layer {
  double ior, depth;
  glm::dvec3 absorption;
};
glm::dvec3 straight_through(std::initializer_list<Layer> layers, double sine) {
  glm::dvec3 through(1);
  double ior = 1;
  for (const Layer& layer : layers) {
    const Crossing c = cross(ior, layer.ior, sine);
    sine = c.sine, ior = layer.ior;
    through *= c.transmitted * glm::exp(-layer.absorption * (layer.depth / std::sqrt(1 - sine * sine)));
  }
  return through * cross(ior, 1, sine).transmitted;
}

/// Whitted's method follows reflections and refractions alike: its values are exact.
void look(SceneMaker& s, vec3 from, vec3 at, int segments) {
  s.camera(from, at, 1e-3f, {0, 1, 0});
  s.document.settings.integrator = Integrator::whitted;
  s.document.settings.path.only_depth = segments;
  s.document.settings.sampler.seed = sampler_seed();
}

void expect_color(const Document& document, glm::dvec3 exact, double tolerance = 2e-4) {
  const Film film = render(document);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(static_cast<double>(film.mean(0, 0)[c]), exact[c], tolerance * exact[c] + 1e-9) << c;
}

/// Water from 0 to 1.2 and glass from 1 to 2.
SceneMaker water_on_glass(int water_priority, int glass_priority, vec3 water = kWaterAbsorbs,
                          vec3 glass = kGlassAbsorbs) {
  SceneMaker s(1, 1, 1);
  slab(s, 0, 1.2f, body(s, kWater, water_priority, water));
  slab(s, 1, 2, body(s, kGlass, glass_priority, glass));
  return s;
}
/// A wide lamp in z that shines towards -z, or towards +z.
void wide_lamp(SceneMaker& s, float z, bool towards_positive = false, float radiance = 1) {
  s.rectangle({0, 0, z}, {200, 0, 0}, {0, towards_positive ? 200.0f : -200.0f, 0}, lamp(s, radiance));
}

TEST(NestedDielectrics, OverlappingSlabsTransmitAsTheInterfacesOfWhatFillsThem) {
  struct Order {
    int water, glass;
    double interface; ///< where water ends and glass begins
  };
  const glm::dvec3 water(kWaterAbsorbs), glass(kGlassAbsorbs);
  for (const Order& order : {Order{1, 2, 1.0}, {2, 1, 1.2}, {7, 3, 1.2}})
    for (double sine : {0.0, 0.5, 0.9}) {
      const double slope = sine / std::sqrt(1 - sine * sine);
      const Layer in_water{kWater, order.interface, water}, in_glass{kGlass, 2 - order.interface, glass};
      SceneMaker through_water = water_on_glass(order.water, order.glass);
      wide_lamp(through_water, 30);
      look(through_water, {-10 * slope, 0, -10}, {0, 0, 0}, 4); // three interfaces, and the lamp
      expect_color(through_water.document, straight_through({in_water, in_glass}, sine));
      SceneMaker through_glass = water_on_glass(order.water, order.glass);
      wide_lamp(through_glass, -30, true);
      look(through_glass, {-10 * slope, 0, 12}, {0, 0, 2}, 4);
      expect_color(through_glass.document, straight_through({in_glass, in_water}, sine));
    }
}

TEST(NestedDielectrics, BodiesInsideOfHigherOnesAreNotThere) {
  SceneMaker s = water_on_glass(1, 2);
  slab(s, 1.3f, 1.6f, body(s, 2.0f, 1, vec3(9)));
  wide_lamp(s, 30);
  look(s, {0, 0, -10}, {0, 0, 0}, 4);
  expect_color(
      s.document,
      straight_through({{kWater, 1, glm::dvec3(kWaterAbsorbs)}, {kGlass, 1, glm::dvec3(kGlassAbsorbs)}}, 0));
}

TEST(NestedDielectrics, EqualIndicesAreNoInterface) {
  SceneMaker s(1, 1, 1);
  slab(s, 0, 1.2f, body(s, kGlass, 1));
  slab(s, 1, 2, body(s, kGlass, 2, kGlassAbsorbs));
  s.rectangle({0, 0, 30}, {20000, 0, 0}, {0, -200, 0}, lamp(s));
  const double sine = 0.999, slope = sine / std::sqrt(1 - sine * sine);
  look(s, {static_cast<float>(-10 * slope), 0, -10}, {0, 0, 0}, 4);
  const glm::dvec3 none(0);
  expect_color(s.document,
               straight_through({{kGlass, 1, none}, {kGlass, 1, glm::dvec3(kGlassAbsorbs)}}, sine), 1e-3);
  // What the middle reflects would come to a lamp in front by as many segments.
  s.document.scene.instances.back().world_from_object[3][2] = -30;
  s.document.scene.materials.back().two_sided_emission = true;
  expect_color(s.document, none);
  s.document.settings.path.only_depth = 2; // the front does
  expect_color(s.document, glm::dvec3(1 - cross(1, kGlass, sine).transmitted), 1e-3);
}

/// From glass to water light is reflected totally beyond asin(1.33 / 1.5), 62.5 degrees; never the other way.
TEST(NestedDielectrics, GlassReflectsTotallyTowardsWater) {
  const double critical = std::asin(static_cast<double>(kWater) / static_cast<double>(kGlass));
  for (double angle : {critical - 0.02, critical + 0.02}) {
    SceneMaker s = water_on_glass(1, 2, vec3(0), vec3(0));
    const auto sine = static_cast<float>(std::sin(angle)), cosine = static_cast<float>(std::cos(angle));
    // A lamp in the water, behind the interface, as seen from within the glass, and the other way.
    wide_lamp(s, 0.5f, true, 3);
    look(s, {-0.5f * sine / cosine, 0, 1.5f}, {0, 0, 1}, 2);
    const double squeezed = (kGlass / kWater) * (kGlass / kWater);
    expect_color(s.document,
                 angle > critical
                     ? glm::dvec3(0)
                     : glm::dvec3(3 * squeezed * cross(kGlass, kWater, std::sin(angle)).transmitted),
                 5e-3);
  }
  SceneMaker s = water_on_glass(1, 2, vec3(0), vec3(0));
  wide_lamp(s, 1.5f, false, 3);
  const double sine = 0.95;
  look(s, {static_cast<float>(-0.5 * sine / std::sqrt(1 - sine * sine)), 0, 0.5f}, {0, 0, 1}, 2);
  const double squeezed = (kWater / kGlass) * (kWater / kGlass);
  expect_color(s.document, glm::dvec3(3 * squeezed * cross(kWater, kGlass, sine).transmitted), 1e-3);
}

TEST(NestedDielectrics, BodiesWithoutPriorityAreAllThere) {
  // A bubble in glass, by its own ratio, is seen as the same bubble in glass without priority.
  double seen[2];
  for (int priority : {0, 1}) {
    SceneMaker s(1, 1, 1);
    slab(s, 0, 3, body(s, kGlass, priority));
    slab(s, 1, 2, body(s, 1 / kGlass, 0));
    wide_lamp(s, 30);
    look(s, {-6, 0, -10}, {0, 0, 0}, 5);
    seen[priority] = static_cast<double>(render(s.document).mean(0, 0).x);
  }
  EXPECT_GT(seen[0], 0.5);
  EXPECT_FLOAT_EQ(static_cast<float>(seen[0]), static_cast<float>(seen[1]));
}

TEST(NestedDielectrics, SurfacesThatEmitHaveNoPriority) {
  SceneMaker s(1, 1, 1);
  Material m;
  m.model = DielectricMaterial{.ior = 1.2f, .priority = 3};
  m.emission = vec3(1);
  const int emitter = s.material(m);
  slab(s, 0, 1, emitter);
  const auto scene = RenderScene::build(s.document);
  EXPECT_FALSE(scene->has_priorities());
  EXPECT_FALSE(scene->has_media());
}

TEST(NestedDielectrics, ClearBodiesThatRankHaveAMediumAndKnowTheirIndex) {
  SceneMaker s(1, 1, 1);
  slab(s, 0, 1.2f, body(s, kWater, 1));
  slab(s, 1, 2, body(s, kGlass, 2));
  const auto scene = RenderScene::build(s.document);
  ASSERT_TRUE(scene->has_priorities());
  auto ior = [&](float z) { return scene->ior(media_at(*scene, {0.1f, 0.2f, z}).current()); };
  EXPECT_EQ(ior(-1), 1);
  EXPECT_EQ(ior(0.5f), kWater);
  EXPECT_EQ(ior(1.1f), kGlass);
  EXPECT_EQ(ior(1.9f), kGlass);
  EXPECT_EQ(ior(3), 1);
}

// The drink: ice in water in a glass ball with a hollow.

Mesh ball(float radius, bool inside_out = false) {
  Mesh mesh = sphere_mesh(24, 48, true);
  for (vec3& p : mesh.positions) p *= radius;
  if (!inside_out) return mesh;
  for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  for (vec3& n : mesh.normals) n = -n;
  return mesh;
}

const vec3 kIceCenter(0.2f, -0.1f, 0.1f);
constexpr float kHollow = 0.8f, kIceRadius = 0.4f;
const vec3 kIceAbsorbs(0.2f, 0.1f, 0.05f);

void light_drink(SceneMaker& s) {
  s.constant_light(vec3(0.2f, 0.4f, 0.8f));
  s.sphere({3, 3, 3}, 1.5f, lamp(s, 6));
  s.rectangle({0, -1.2f, 0}, {0, 0, 3}, {3, 0, 0}, s.diffuse(vec3(0.7f)));
  s.camera({0, 0.3f, 4}, {0, 0, 0}, 30);
  s.document.settings.sampler.type = SamplerType::independent;
}
/// Of bodies that reach into each other.
SceneMaker nested_drink() {
  SceneMaker s(8, 8, 256);
  const int glass = body(s, kGlass, 2, kGlassAbsorbs);
  s.mesh(ball(1), glass);
  s.mesh(ball(kHollow, true), glass);
  s.mesh(ball(0.93f), body(s, kWater, 1, kWaterAbsorbs)); // ends within the wall
  s.sphere(kIceCenter, kIceRadius, body(s, kIce, 3, kIceAbsorbs));
  light_drink(s);
  return s;
}
/// Of interfaces, each by what lies on its two sides.
SceneMaker exact_drink() {
  SceneMaker s(8, 8, 256);
  s.mesh(ball(1), body(s, kGlass, 0, kGlassAbsorbs));
  s.mesh(ball(kHollow), body(s, kWater / kGlass, 0, kWaterAbsorbs));
  s.sphere(kIceCenter, kIceRadius, body(s, kIce / kWater, 0, kIceAbsorbs));
  light_drink(s);
  return s;
}

/// The means of the four quarters of the film agree by z-tests, with so many samples that the film's mean is
/// known to 3 %.
void expect_same_expectation(const Document& a, const Document& b) {
  const Film films[] = {render(a), render(b)};
  const int w = films[0].width(), h = films[0].height();
  for (int c = 0; c < 3; ++c) {
    double all = 0, all_variance = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
      double sum[2] = {}, variance = 0;
      for (int k = 0; k < 2; ++k)
        for (int y = quarter / 2 * h / 2; y < (quarter / 2 + 1) * h / 2; ++y)
          for (int x = quarter % 2 * w / 2; x < (quarter % 2 + 1) * w / 2; ++x) {
            sum[k] += static_cast<double>(films[k].mean(x, y)[c]);
            variance += static_cast<double>(films[k].variance_of_mean(x, y)[c]);
          }
      EXPECT_LE(std::abs(sum[0] - sum[1]), 5.5 * std::sqrt(variance))
          << "quarter " << quarter << ", channel " << c << "; " << seed_note();
      all += sum[0], all_variance += variance;
    }
    EXPECT_LT(std::sqrt(all_variance), 0.03 * all) << "too few samples to tell";
  }
}

TEST(NestedDielectricsStatistical, ADrinkOfOverlappingBodiesLooksLikeOneOfExactInterfaces) {
  SceneMaker nested = nested_drink(), exact = exact_drink();
  nested.document.settings.sampler.seed = sampler_seed(1);
  exact.document.settings.sampler.seed = sampler_seed(2);
  expect_same_expectation(nested.document, exact.document);
  nested.document.settings.integrator = exact.document.settings.integrator = Integrator::whitted;
  nested.document.settings.stop.spp = exact.document.settings.stop.spp = 64;
  expect_same_expectation(nested.document, exact.document);
}

SceneMaker clear_bodies_in_furnace(int size, int spp) {
  SceneMaker s(size, size, spp);
  s.sphere({0, 0, 0}, 1, body(s, kGlass, 2));
  s.sphere({0.6f, 0.2f, 0}, 0.9f, body(s, kWater, 1));
  s.sphere({0.3f, 0.3f, 0.2f}, 0.5f, body(s, 2.2f, 3));
  s.sphere({-0.5f, 0.2f, 0.3f}, 0.3f, body(s, 0.8f, 4));
  s.constant_light(vec3(1));
  s.camera({0.3f, 0.2f, 4}, {0.3f, 0.1f, 0}, 35);
  s.document.settings.sampler.seed = sampler_seed(4);
  return s;
}

TEST(NestedDielectrics, ClearBodiesVanishInAWhiteFurnace) {
  SceneMaker s = clear_bodies_in_furnace(24, 16);
  s.document.settings.path.rr = RussianRoulette::off; // then every path brings back 1
  s.document.settings.path.max_depth = 5000;
  const Film film = render(s.document);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) EXPECT_NEAR(film.mean(x, y).x, 1, 1e-5) << x << ", " << y;
}

TEST(NestedDielectricsStatistical, ClearBodiesVanishInAWhiteFurnace) {
  SceneMaker s = clear_bodies_in_furnace(32, 64);
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.integrator = Integrator::whitted;
  expect_radiance(over_pixels(render(s.document), 1), 1, 6e-3, 1);
}

/// A room in a body, a lamp and a matt ball, and bodies of lower priority between all of them, or not.
SceneMaker room_in_body(bool with_hidden) {
  SceneMaker s(8, 8, 256);
  s.sphere({0, 0, 0}, 5, body(s, 1.2f, 2, vec3(0.1f, 0.2f, 0.05f)));
  s.rectangle({0, -1, 0}, {0, 0, 2}, {2, 0, 0}, s.diffuse(vec3(0.8f)));
  s.rectangle({0, 1.5f, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, lamp(s, 5));
  s.sphere({0.4f, -0.6f, 0}, 0.4f, s.diffuse(vec3(0.5f)));
  if (with_hidden) {
    s.sphere({0, 0.4f, 0}, 0.7f, body(s, 1.9f, 1, vec3(3)));
    s.sphere({0, 0, 2.2f}, 0.5f, body(s, 1.7f, 1));
    s.sphere({0.2f, 0.1f, 0.5f}, 0.8f, body(s, 1.4f, 1));
  }
  LightDesc point;
  point.model = PointLightModel{.position = {0.5f, 0.8f, 1}};
  point.color = vec3(1);
  s.document.scene.lights.push_back(point);
  s.camera({0, 0.2f, 3}, {0, -0.3f, 0}, 45);
  s.document.settings.sampler.type = SamplerType::independent;
  return s;
}

TEST(NestedDielectrics, NothingSeesWhatIsHidden) {
  for (Integrator integrator : {Integrator::path, Integrator::whitted, Integrator::ao})
    for (View view : {View::radiance, View::albedo, View::normal, View::depth, View::material}) {
      SceneMaker seen[] = {room_in_body(true), room_in_body(false)};
      std::optional<Film> films[2];
      for (int k = 0; k < 2; ++k) {
        RenderSettings& settings = seen[k].document.settings;
        settings.integrator = integrator;
        settings.view = view;
        settings.stop.spp = 8;
        settings.ao.distance = 1.5f;
        films[k] = render(seen[k].document);
      }
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(films[0]->mean(x, y)[c], films[1]->mean(x, y)[c], 1e-4f)
                << x << ", " << y << ", integrator " << static_cast<int>(integrator) << ", view "
                << static_cast<int>(view);
      if (view == View::radiance) { EXPECT_GT(films[0]->mean(4, 6).x, 0.05f); }
    }
}

TEST(NestedDielectrics, FeaturesOfTheDenoiserDoNotSeeWhatIsHidden) {
  NoisyImage albedo[2], normal[2], position[2];
  for (int k = 0; k < 2; ++k) {
    SceneMaker s = room_in_body(k == 0);
    s.sphere({-0.4f, 0, 0.4f}, 0.4f, body(s, 1.5f, 3)); // is seen through
    FeatureFilm film(8, 8);
    std::atomic<bool> stop{false};
    ASSERT_TRUE(render_features(*RenderScene::build(s.document), s.document, 4, film, stop, 1));
    film.resolve(albedo[k], normal[k], position[k]);
  }
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t h = 0; h < 2; ++h)
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(albedo[0].half[h].pixels[i][c], albedo[1].half[h].pixels[i][c], 1e-4f) << i;
        EXPECT_NEAR(normal[0].half[h].pixels[i][c], normal[1].half[h].pixels[i][c], 1e-3f) << i;
        EXPECT_NEAR(position[0].half[h].pixels[i][c], position[1].half[h].pixels[i][c], 1e-4f) << i;
      }
}

TEST(NestedDielectricsStatistical, StrategiesAgreeAmongHiddenBodies) {
  SceneMaker mis = room_in_body(true), other = room_in_body(true);
  mis.document.settings.sampler.seed = sampler_seed(20);
  for (LightSampling strategy : {LightSampling::bsdf, LightSampling::nee}) {
    other.document.settings.path.light_sampling = strategy;
    other.document.settings.sampler.seed = sampler_seed(21 + static_cast<std::uint64_t>(strategy));
    other.document.settings.stop.spp = strategy == LightSampling::bsdf ? 1024 : 256;
    expect_same_expectation(mis.document, other.document);
  }
}

TEST(NestedDielectrics, ASampleCanBeReplayed) {
  SceneMaker s = nested_drink();
  s.document.settings.stop.spp = 1;
  const Film film = render(s.document);
  const auto scene = RenderScene::build(s.document);
  for (unsigned y = 0; y < 8; ++y)
    for (unsigned x = 0; x < 8; ++x)
      EXPECT_EQ(replay_sample(*scene, s.document, {x, y}, 0),
                film.mean(static_cast<int>(x), static_cast<int>(y)));
}

TEST(NestedDielectrics, ATexturedIndexCountsByItsFactorForNeighbours) {
  SceneMaker s(1, 1, 1);
  DielectricMaterial textured{.ior = 1.4f, .priority = 1};
  EXPECT_EQ(interior(textured)->ior, 1.4f);
  EXPECT_EQ(interior(textured)->priority, 1);
  EXPECT_FALSE(interior(DiffuseMaterial()));
}

} // namespace
} // namespace candela::test
