// Each light's sample() against its pdf(), over the directions in which an independent intersection finds the
// light.

#include "core/hash.h"
#include "render/lights/light_lanes.h"
#include "support/direction_statistics.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace candela;
using namespace candela::test;
using glm::dvec3;

/// A float direction to a light's edge may miss it by its rounding: lights are this much larger here
/// (relative).
constexpr double kEdge = 1e-5;

/// Where a ray meets the plane, in double precision; nothing behind.
std::optional<dvec3> plane_hit(dvec3 o, dvec3 w, dvec3 p, dvec3 n) {
  double t = glm::dot(p - o, n) / glm::dot(w, n);
  return t > 0 && std::isfinite(t) ? std::optional(o + t * w) : std::nullopt;
}
std::optional<dvec3> meet(const RectangleLight& l, dvec3 o, dvec3 w) {
  auto p = plane_hit(o, w, dvec3(l.corner), glm::cross(dvec3(l.edge_x), dvec3(l.edge_y)));
  if (!p) return p;
  dvec3 d = *p - dvec3(l.corner), x(l.edge_x), y(l.edge_y);
  double u = glm::dot(d, x) / glm::dot(x, x), v = glm::dot(d, y) / glm::dot(y, y);
  return u >= -kEdge && u <= 1 + kEdge && v >= -kEdge && v <= 1 + kEdge ? p : std::nullopt;
}
std::optional<dvec3> meet(const TriangleLight& l, dvec3 o, dvec3 w) {
  dvec3 a(l.edge1), b(l.edge2), n = glm::cross(a, b);
  auto p = plane_hit(o, w, dvec3(l.corner), n);
  if (!p) return p;
  dvec3 d = *p - dvec3(l.corner);
  double u = glm::dot(glm::cross(d, b), n) / glm::dot(n, n),
         v = glm::dot(glm::cross(a, d), n) / glm::dot(n, n);
  return u >= -kEdge && v >= -kEdge && u + v <= 1 + kEdge ? p : std::nullopt;
}
std::optional<dvec3> meet(const DiscLight& l, dvec3 o, dvec3 w) {
  auto p = plane_hit(o, w, dvec3(l.center), dvec3(l.normal));
  return p && glm::length(*p - dvec3(l.center)) <= static_cast<double>(l.radius) * (1 + kEdge) ? p
                                                                                               : std::nullopt;
}
std::optional<dvec3> meet(const SphereLight& l, dvec3 o,
                          dvec3 w) { // the first point, or from inside the only one
  dvec3 f = o - dvec3(l.center);
  double r = static_cast<double>(l.radius), b = glm::dot(f, w), d = b * b - (glm::dot(f, f) - r * r);
  if (d < -kEdge * r * r) return std::nullopt;
  d = std::max(d, 0.0);
  double t = -b - std::sqrt(d);
  if (t <= 0) t = -b + std::sqrt(d);
  return t > 0 ? std::optional(o + t * w) : std::nullopt;
}

/// `shining`: whether the reference sees a side that shines, so that the pdf integrates to 1; else sample()
/// gives nothing.
template <class L>
void expect_density_at(const L& light, const LightSamplingContext& ctx, vec3 axis, double width,
                       bool shining) {
  const vec3 reference = ctx.position;
  SCOPED_TRACE(testing::Message() << "from " << reference.x << " " << reference.y << " " << reference.z);
  constexpr std::size_t kCount = 40000;
  int wrong_radiance = 0, wrong_pdf = 0, off_light = 0;
  auto draw = [&](std::size_t i) -> std::optional<vec3> {
    std::uint64_t h = hash_combine(fresh_seed(), i);
    auto s = light.sample(ctx, {to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                                to_unit_float(static_cast<std::uint32_t>(h))});
    if (!s) return std::nullopt;
    wrong_radiance += s->radiance != light.emission || s->delta || s->infinite;
    float pdf = light.pdf(ctx, s->point, s->direction);
    wrong_pdf += !(std::abs(pdf - s->pdf) <= 2e-3f * s->pdf);
    // The point lies on the light to within its error bounds (and some digits of the test's own).
    vec3 along = s->point - reference;
    off_light += !(glm::length(glm::normalize(along) - s->direction) < 1e-5f);
    return s->direction;
  };
  auto pdf = [&](vec3 w) {
    auto p = meet(light, dvec3(reference), glm::normalize(dvec3(w)));
    return p ? static_cast<double>(light.pdf(ctx, vec3(*p), w)) : 0.0;
  };
  // Small bins, for the quadrature may overlook a light's corner that reaches a little into a bin.
  DirectionTest result = test_directions(SphereBins(axis, width, 32, 64), kCount, draw, pdf);
  EXPECT_EQ(wrong_radiance, 0);
  EXPECT_EQ(wrong_pdf, 0);
  EXPECT_EQ(off_light, 0);
  EXPECT_NEAR(result.pdf_integral, shining ? 1 : 0, 2e-3);
  EXPECT_GT(result.chi_square.p_value, sidak_threshold(10))
      << result.chi_square.statistic << " of " << result.chi_square.degrees_of_freedom << "; " << seed_note();
}

/// From a surface that faces `towards`, and from the same place in a medium, where no normal plays a part.
template <class L>
void expect_density(const L& light, vec3 reference, vec3 towards, double width, bool shining = true) {
  const vec3 axis = glm::normalize(towards - reference);
  expect_density_at(light, {reference, axis}, axis, width, shining);
  expect_density_at(light, LightSamplingContext::in_volume(reference), axis, width, shining);
}

RectangleLight rectangle(vec3 corner, vec3 x, vec3 y, bool two_sided = false) {
  return {corner, x, y, {1, 2, 3}, two_sided};
}
TriangleLight triangle(vec3 corner, vec3 a, vec3 b, bool two_sided = false) {
  vec3 c = glm::cross(a, b);
  return {corner, a, b, glm::normalize(c), 0.5f * glm::length(c), {1, 2, 3}, two_sided};
}

TEST(LightStatistical, Rectangle) {
  auto light = rectangle({-1, 2, -0.5f}, {2, 0, 0}, {0, 0, 1}); // shines downwards: x cross z = -y
  expect_density(light, {0, 0, 0}, {0, 2, 0}, 0.3);
  expect_density(light, {0.3f, 1.7f, 0.1f}, {0, 2, 0}, 1);
  expect_density(light, {4, 1.5f, 1}, {0, 2, 0}, 0.2);
  expect_density(light, {0, 4, 0}, {0, 2, 0}, 0.3, false); // behind
  expect_density(rectangle({-1, 2, -0.5f}, {2, 0, 0}, {0, 0, 1}, true), {0, 4, 0}, {0, 2, 0}, 0.3);
}

/// Four by three cells, one of them black, over (-1, 2, -0.5) + [0, 2] x [0, 1].
const EmissionGrid& some_picture() {
  static const EmissionGrid grid(
      std::array{1.0f, 0.0f, 3.0f, 2.0f, 0.5f, 9.0f, 1.0f, 1.0f, 4.0f, 2.0f, 0.1f, 1.0f}, 4);
  return grid;
}
RectangleLight picture_light(const EmissionGrid& grid, bool two_sided = false) {
  return {{-1, 2, -0.5f}, {2, 0, 0}, {0, 0, 1}, {1, 2, 3}, two_sided, &grid};
}

TEST(LightStatistical, RectangleWithAPicture) {
  const RectangleLight light = picture_light(some_picture());
  expect_density(light, {0, 0, 0}, {0, 2, 0}, 0.3);
  expect_density(light, {0.3f, 1.7f, 0.1f}, {0, 2, 0}, 1);
  expect_density(light, {4, 1.5f, 1}, {0, 2, 0}, 0.2);
  expect_density(light, {0, 4, 0}, {0, 2, 0}, 0.3, false); // behind
  expect_density(picture_light(some_picture(), true), {0, 4, 0}, {0, 2, 0}, 0.3);
}

/// Of value(place, density in 1/sr), the integral over the solid angle of the light.
template <class Value>
double over_light(const RectangleLight& light, const LightSamplingContext& ctx, Value value) {
  constexpr int kSide = 480;
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const vec2 place = (vec2(x, y) + 0.5f) / static_cast<float>(kSide);
      const vec3 p = light.at(place.x * light.length_x, place.y * light.length_y);
      const float one = solid_angle_density(ctx, p, light.normal, light.area(), light.two_sided);
      if (one > 0)
        sum += static_cast<double>(value(place, light.pdf(ctx, p, glm::normalize(p - ctx.position)))) /
               static_cast<double>(one);
    }
  return sum / (kSide * kSide);
}

TEST(Light, DensityOfAPictureIsOneFromNearAndFar) {
  const RectangleLight light = picture_light(some_picture());
  for (vec3 from :
       {vec3(0, 1.9f, 0), vec3(0.2f, 1, 0.3f), vec3(8, -3, 2), vec3(0, -40, 0), vec3(300, -900, 50)})
    EXPECT_NEAR(over_light(light, {from, {0, 1, 0}}, [](vec2, float pdf) { return pdf; }), 1, 2e-3) << from.y;
}

TEST(Light, AMostlyBlackPictureHasMuchLessVariance) {
  std::vector<float> luminance(24 * 16, 0.0f);
  for (std::size_t cell : {30u, 31u, 54u, 200u}) luminance[cell] = 1; // one in a hundred
  const EmissionGrid grid(luminance, 24);
  RectangleLight light = picture_light(grid), even = light;
  even.picture = nullptr;
  for (vec3 from : {vec3(0, 1, 0), vec3(2, -4, 3), vec3(0, -40, 0)}) {
    const LightSamplingContext ctx{from, {0, 1, 0}};
    auto radiance = [&](vec2 place) { return grid.pdf(place); };
    const double mean = over_light(light, ctx, [&](vec2 place, float) { return radiance(place); });
    auto variance = [&](const RectangleLight& l) {
      return over_light(l, ctx, [&](vec2 place, float pdf) { return sqr(radiance(place)) / pdf; }) -
             sqr(mean);
    };
    EXPECT_LT(20 * variance(light), variance(even)) << from.y;
    EXPECT_GT(over_light(light, ctx, [](vec2, float pdf) { return pdf > 0 ? 1.0f : 0.0f; }),
              0.999 * over_light(light, ctx, [](vec2, float) { return 1.0f; }))
        << "nothing is left out";
  }
}

TEST(Light, ManySamplesAtOnceAreTheSameToTheBit) {
  const Light lights[] = {rectangle({-1, 2, -0.5f}, {2, 0, 0}, {0, 0, 1}),
                          rectangle({-1, 2, -0.5f}, {2, 0, 0}, {0, 0, 1}, true),
                          picture_light(some_picture()),
                          rectangle({0, 40, 0}, {0.05f, 0, 0}, {0, 0, 0.05f}), // far: sampled by area
                          triangle({-1, 2, -0.5f}, {2, 0.5f, 0}, {0.5f, 0, 1.5f}),
                          SphereLight{{0, 3, 0}, 0.5f, {1, 2, 3}, false},
                          PointLight{{0, 5, 0}, vec3(3)},
                          DirectionalLight{{0, -1, 0}, vec3(2)}};
  std::mt19937_64 random(fresh_seed());
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> place(-2, 4), unit(0, kOneMinusEpsilon);
  int seen = 0;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const std::size_t count = repeat == 0 ? kLaneCount : 33;
    std::vector<LightSamplingContext> contexts(count);
    std::vector<LightQuery> queries;
    for (std::uint32_t k = 0; k < count; ++k) {
      contexts[k].position = {place(random), place(random), place(random)};
      const auto lane = static_cast<std::uint32_t>(count) - 1 - k;
      queries.push_back({&lights[k % std::size(lights)], &contexts[k], {unit(random), unit(random)}, lane});
    }
    LightSampleLanes samples{};
    sample_lights(queries, samples);
    for (const LightQuery& query : queries) {
      auto one = sample_light(*query.light, *query.context, query.u);
      ASSERT_EQ(samples.pdf[query.lane], one ? one->pdf : 0);
      if (!one) continue;
      ++seen;
      EXPECT_EQ(samples.point[query.lane], one->point);
      EXPECT_EQ(samples.point_error[query.lane], one->point_error);
      EXPECT_EQ(samples.point_normal[query.lane], one->point_normal);
      EXPECT_EQ(samples.radiance[query.lane], one->radiance);
      EXPECT_EQ(samples.infinite[query.lane], one->infinite);
      EXPECT_EQ(samples.delta[query.lane], one->delta);
      if (one->infinite) { EXPECT_EQ(samples.direction[query.lane], one->direction); }
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(LightStatistical, Triangle) {
  auto light = triangle({-1, 2, -0.5f}, {2, 0.5f, 0}, {0.5f, 0, 1.5f});
  expect_density(light, {0, 0, 0}, {0, 2, 0}, 0.3);
  expect_density(light, {0, 1, 0.2f}, {0, 2, 0.2f}, 0.8);
  expect_density(light, {3, 1, 1}, {0, 2, 0}, 0.2);
  expect_density(light, {0, 4, 0}, {0, 2, 0}, 0.3, false);
  expect_density(triangle({-1, 2, -0.5f}, {2, 0.5f, 0}, {0.5f, 0, 1.5f}, true), {0, 4, 0}, {0, 2, 0}, 0.3);
}

TEST(LightStatistical, Disc) {
  DiscLight light{{0, 2, 0}, {0, -1, 0}, 0.8f, {1, 2, 3}, false};
  expect_density(light, {0, 0, 0}, {0, 2, 0}, 0.2);
  expect_density(light, {0.2f, 1.2f, 0}, {0, 2, 0}, 0.6);
  expect_density(light, {3, 1, 1}, {0, 2, 0}, 0.15);
  expect_density(light, {0, 4, 0}, {0, 2, 0}, 0.2, false);
  light.two_sided = true;
  expect_density(light, {0.5f, 4, 0}, {0, 2, 0}, 0.2);
}

TEST(LightStatistical, Sphere) {
  SphereLight light{{1, 2, 3}, 0.7f, {1, 2, 3}, false};
  expect_density(light, {1, 0, 3}, {1, 2, 3}, 0.2);
  expect_density(light, {1, 1.25f, 3.1f}, {1, 2, 3}, 0.6); // nearly on it
  expect_density(light, {30, -10, 3}, {1, 2, 3}, 0.012);
  expect_density(light, {1.2f, 2, 3}, {2, 2, 3}, 1, false); // inside
  light.two_sided = true;
  expect_density(light, {1.2f, 2.3f, 3}, {2, 2, 3}, 1);
}

TEST(LightStatistical, ConstantIsSampledByTheCosineOrFromAllAround) {
  ConstantLight light{{1, 2, 3}};
  for (ScatteringDomain domain :
       {ScatteringDomain::hemisphere, ScatteringDomain::sphere, ScatteringDomain::volume}) {
    SCOPED_TRACE(static_cast<int>(domain));
    const vec3 axis = glm::normalize(vec3(1, 2, -1));
    LightSamplingContext ctx{{5, 5, 5}, axis, domain};
    if (domain == ScatteringDomain::volume) ctx = LightSamplingContext::in_volume({5, 5, 5});
    auto draw = [&](std::size_t i) -> std::optional<vec3> {
      std::uint64_t h = hash_combine(fresh_seed(), i);
      auto s = light.sample(ctx, {to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                                  to_unit_float(static_cast<std::uint32_t>(h))});
      if (!s) return std::nullopt;
      EXPECT_TRUE(s->infinite && !s->delta && s->radiance == vec3(1, 2, 3));
      EXPECT_EQ(s->pdf, light.pdf(ctx, {}, s->direction));
      return s->direction;
    };
    auto result = test_directions(SphereBins(axis, 1), 100000, draw,
                                  [&](vec3 w) { return static_cast<double>(light.pdf(ctx, {}, w)); });
    EXPECT_NEAR(result.pdf_integral, 1, 1e-4);
    EXPECT_GT(result.chi_square.p_value, sidak_threshold(3)) << seed_note();
  }
}

TEST(Light, DeltaLights) {
  LightSamplingContext ctx{{1, 0, 0}, {0, 1, 0}};
  auto s = PointLight{{1, 2, 0}, {8, 4, 2}}.sample(ctx, {});
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->delta && !s->infinite);
  EXPECT_EQ(s->direction, vec3(0, 1, 0));
  EXPECT_EQ(s->radiance, vec3(2, 1, 0.5f));
  EXPECT_EQ(s->pdf, 1);
  EXPECT_FALSE((PointLight{{1, 0, 0}, vec3(1)}.sample(ctx, {}))); // on the reference itself
  s = DirectionalLight{{0, -1, 0}, {8, 4, 2}}.sample(ctx, {});
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->delta && s->infinite);
  EXPECT_EQ(s->direction, vec3(0, 1, 0));
  EXPECT_EQ(s->radiance, vec3(8, 4, 2));
}

TEST(Light, SaysHowItCanBeFound) {
  EXPECT_EQ(light_kind(PointLight{}), LightKind::delta_position);
  EXPECT_EQ(light_kind(SpotLight{}), LightKind::delta_position);
  EXPECT_EQ(light_kind(DirectionalLight{}), LightKind::delta_direction);
  EXPECT_EQ(light_kind(ConstantLight{}), LightKind::infinite);
  EXPECT_EQ(light_kind(EnvironmentLight{}), LightKind::infinite);
  for (const Light& light :
       {Light(RectangleLight{}), Light(TriangleLight{}), Light(SphereLight{}), Light(DiscLight{})}) {
    EXPECT_EQ(light_kind(light), LightKind::area);
    EXPECT_FALSE(is_delta_light(light));
    EXPECT_TRUE(light_bounds(light));
  }
  EXPECT_TRUE(is_delta_light(DirectionalLight{}) && is_delta_light(PointLight{}));
  EXPECT_FALSE(is_delta_light(ConstantLight{}));
  EXPECT_FALSE(light_bounds(PointLight{{}, {}, {0, 1, 0}})) << "its fall-off is not that of the tree";
}

TEST(Light, SpotFallsOffBetweenBeamAndCutoff) {
  SpotLight spot{{0, 4, 0}, {0, -1, 0}, radians(20.0f), radians(40.0f), {8, 4, 2}};
  auto irradiance = [&](float angle) { // on a plane that faces the light, at the distance 4 / cos
    LightSamplingContext ctx{{4 * std::tan(radians(angle)), 0, 0}, {0, 1, 0}};
    auto s = spot.sample(ctx, {});
    if (s) {
      EXPECT_TRUE(s->delta && !s->infinite && s->pdf == 1);
      EXPECT_NEAR(s->direction.y, std::cos(radians(angle)), 1e-6f);
    }
    return s ? s->radiance.x * sqr(4 / std::cos(radians(angle))) : 0.0f;
  };
  EXPECT_EQ(irradiance(0), 8);
  EXPECT_NEAR(irradiance(19.9f), 8, 1e-4f);
  EXPECT_NEAR(irradiance(25), 6, 1e-4f);
  EXPECT_NEAR(irradiance(-35), 2, 1e-4f);
  EXPECT_EQ(irradiance(40.1f), 0);
  EXPECT_FALSE((spot.sample({{0, 5, 0}, {0, -1, 0}}, {}))) << "behind it";
  spot.beam_width = spot.cutoff_angle;
  EXPECT_NEAR(irradiance(39.9f), 8, 1e-4f) << "a hard edge";
  EXPECT_EQ(irradiance(40.1f), 0);
}

TEST(Light, AttenuationReplacesTheInverseSquare) {
  LightSamplingContext ctx{{0, 0, 0}, {0, 1, 0}};
  auto at = [&](vec3 attenuation) {
    auto s = PointLight{{0, 3, 0}, vec3(18), attenuation}.sample(ctx, {});
    auto t = SpotLight{{0, 3, 0}, {0, -1, 0}, 1, 1, vec3(18), attenuation}.sample(ctx, {});
    EXPECT_EQ(s->radiance, t->radiance);
    return s->radiance.x;
  };
  EXPECT_EQ(at({0, 0, 1}), 2);
  EXPECT_EQ(at({1, 0, 0}), 18);
  EXPECT_EQ(at({0, 2, 0}), 3);
  EXPECT_EQ(at({3, 2, 1}), 1);
}

TEST(Light, PowerOfASpotIsItsIntegralOverTheSphere) {
  for (auto [beam, cutoff] : {std::pair(0.2f, 0.6f), {0.0f, 3.0f}, {1.0f, 1.0f}}) {
    SpotLight spot{vec3(0), {0, 0, 1}, beam, cutoff, vec3(1)};
    double sum = 0;
    for (int i = 0; i < 100000; ++i) {
      double theta = (i + 0.5) * std::numbers::pi / 100000;
      sum += static_cast<double>(spot.falloff(static_cast<float>(theta))) * std::sin(theta);
    }
    sum *= 2 * std::numbers::pi * std::numbers::pi / 100000;
    EXPECT_NEAR(light_power(spot, 1), sum, 1e-3 * sum);
    spot.attenuation = {1, 0, 0};
    EXPECT_NEAR(light_power(spot, 3), 9 * sum, 9e-3 * sum) << "as strong there as at the distance 1";
  }
}

TEST(Light, PowerIsWhatItSendsOut) {
  // Phi = pi A L for a Lambertian side, 4 pi I for a point; relative to one of luminance 1.
  vec3 one(1);
  EXPECT_NEAR(light_power(SphereLight{{0, 0, 0}, 2, one, false}, 1), 16 * kPi * kPi, 1e-3f);
  EXPECT_NEAR(light_power(DiscLight{{0, 0, 0}, {0, 0, 1}, 2, one, true}, 1), 8 * kPi * kPi, 1e-3f);
  EXPECT_NEAR(light_power(PointLight{{0, 0, 0}, one}, 1), 4 * kPi, 1e-4f);
  EXPECT_NEAR(light_power(DirectionalLight{{0, 0, 1}, one}, 3), 9 * kPi, 1e-4f);
}

} // namespace
