// Discs and spheres that show pictures: samples against densities, by the place on the light, where densities
// per solid angle times cosine over distance squared have no poles, as they have at the rim of a sphere.

#include "core/hash.h"
#include "lights/disc_light.h"
#include "lights/sphere_light.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace {

using namespace candela;
using namespace candela::test;

/// Four by three cells, one of them black.
const EmissionGrid& twelve_texels() {
  static const EmissionGrid grid(
      std::array{1.0f, 0.0f, 3.0f, 2.0f, 0.5f, 9.0f, 1.0f, 1.0f, 4.0f, 2.0f, 0.1f, 1.0f}, 4);
  return grid;
}

DiscLight disc(const EmissionGrid& grid, bool two_sided = false) {
  DiscLight light{{0, 2, 0}, {0, -1, 0}, 0.8f, {1, 2, 3}, two_sided};
  light.set_picture(&grid, {0.6f, 0, 0.8f}, {-0.8f, 0, 0.6f});
  return light;
}
/// Its picture turned, and mirrored.
SphereLight sphere(const EmissionGrid& grid, bool two_sided = false) {
  SphereLight light{{1, 2, 3}, 0.7f, {1, 2, 3}, two_sided};
  const mat3 mirrored =
      mat3(glm::rotate(mat4(1), 0.8f, vec3(1, 2, -1))) * mat3(vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
  light.set_picture(&grid, mirrored);
  return light;
}

/// A place on the light.
struct Place {
  vec3 point, normal;
};
Place place_at(const DiscLight& l, vec2 q) {
  const vec2 d = l.radius * DiscLight::from_polar(q);
  return {l.center + d.x * l.axis_x + d.y * l.axis_y, l.normal};
}
Place place_at(const SphereLight& l, vec2 q) {
  const vec3 normal = SphereLight::from_square(q) * l.local_from_world;
  return {l.center + l.radius * normal, normal};
}
vec2 square_of(const DiscLight& l, vec3 point) {
  const vec3 d = (point - l.center) / l.radius;
  return DiscLight::polar({glm::dot(d, l.axis_x), glm::dot(d, l.axis_y)});
}
vec2 square_of(const SphereLight& l, vec3 point) {
  return SphereLight::square_of(l.local_from_world * glm::normalize(point - l.center));
}
float area(const DiscLight& l) { return kPi * sqr(l.radius); }
float area(const SphereLight& l) { return 4 * kPi * sqr(l.radius); }
/// Whether the point sees the place, the light's own body between.
bool sees(const DiscLight& l, vec3 from, const Place& at) {
  return l.two_sided || glm::dot(from - at.point, at.normal) > 0;
}
bool sees(const SphereLight& l, vec3 from, const Place& at) {
  const bool outside = length_squared(from - l.center) > sqr(l.radius);
  return outside ? glm::dot(from - at.point, at.normal) > 0 : l.two_sided;
}

/// Solid angle over the area of the unit square.
template <class L>
float steradians(const L& light, vec3 from, const Place& at) {
  const vec3 d = at.point - from;
  const float d2 = length_squared(d);
  return sees(light, from, at) ? area(light) * std::abs(glm::dot(d, at.normal)) / (d2 * std::sqrt(d2)) : 0;
}

/// The integral over the solid angle of what is seen of value(place in the unit square, density in 1/sr), by
/// kSide^2 parts of the square, each by kEach^2 points.
constexpr int kSide = 16, kEach = 24;
template <class L, class Value>
std::vector<double> over_light(const L& light, const LightSamplingContext& ctx, Value value) {
  std::vector<double> parts(kSide * kSide, 0.0);
  constexpr int kAll = kSide * kEach;
  for (int y = 0; y < kAll; ++y)
    for (int x = 0; x < kAll; ++x) {
      const vec2 q = (vec2(x, y) + 0.5f) / static_cast<float>(kAll);
      const Place at = place_at(light, q);
      const float sr = steradians(light, ctx.position, at);
      if (!(sr > 0)) continue;
      const float pdf = light.pdf(ctx, at.point, glm::normalize(at.point - ctx.position));
      parts[static_cast<std::size_t>(y / kEach * kSide + x / kEach)] +=
          static_cast<double>(value(q, pdf)) * static_cast<double>(sr) / (kAll * kAll);
    }
  return parts;
}
double sum(const std::vector<double>& parts) {
  double all = 0;
  for (double part : parts) all += part;
  return all;
}

/// `least`: of the integral; the rest are samples that fail, of what is out of sight.
template <class L>
void expect_density(const L& light, vec3 from, double least) {
  SCOPED_TRACE(testing::Message() << L::kName << " from " << from.x << ' ' << from.y << ' ' << from.z);
  const LightSamplingContext ctx{from, glm::normalize(light.center - from)};
  constexpr std::size_t kCount = 100000;
  std::vector<double> expected = over_light(light, ctx, [](vec2, float pdf) { return pdf; });
  const double integral = sum(expected);
  EXPECT_GT(integral, least);
  EXPECT_LT(integral, 1 + 2e-3);
  expected.push_back(1 - integral);
  for (double& e : expected) e = std::max(e * kCount, 1e-6);
  std::vector<double> observed(expected.size(), 0.0);
  int wrong_pdf = 0, wrong_place = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::uint64_t h = hash_combine(fresh_seed(), i);
    const auto s = light.sample(ctx, {to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                                      to_unit_float(static_cast<std::uint32_t>(h))});
    if (!s) {
      observed.back() += 1;
      continue;
    }
    wrong_pdf += !(std::abs(light.pdf(ctx, s->point, s->direction) - s->pdf) <= 2e-3f * s->pdf);
    const vec2 q = square_of(light, s->point);
    wrong_place += !(glm::length(place_at(light, q).point - s->point) < 1e-4f) ||
                   !(glm::length(glm::normalize(s->point - from) - s->direction) < 1e-5f);
    const ivec2 part = glm::clamp(ivec2(q * static_cast<float>(kSide)), 0, kSide - 1);
    observed[static_cast<std::size_t>(part.y * kSide + part.x)] += 1;
  }
  EXPECT_LE(wrong_pdf, 100) << "some lie on an edge between two cells";
  EXPECT_EQ(wrong_place, 0);
  const ChiSquareResult result = chi_square_test(observed, expected);
  EXPECT_GT(result.p_value, sidak_threshold(5))
      << result.statistic << " of " << result.degrees_of_freedom << "; " << seed_note();
}

TEST(PictureLightStatistical, Disc) {
  for (bool two_sided : {false, true}) {
    const DiscLight light = disc(twelve_texels(), two_sided);
    expect_density(light, {0, 0, 0}, 1 - 2e-3);
    expect_density(light, {0.3f, 1.6f, 0.1f}, 1 - 2e-3);
  }
  expect_density(disc(twelve_texels(), true), {0.2f, 3, 0}, 1 - 2e-3);
  const LightSamplingContext behind{{0, 3, 0}, {0, -1, 0}};
  const DiscLight light = disc(twelve_texels());
  EXPECT_FALSE(light.sample(behind, {0.3f, 0.4f}) || light.sample(behind, {0.95f, 0.4f}));
  EXPECT_EQ(light.pdf(behind, {0.1f, 2, 0}, glm::normalize(vec3(0.1f, -1, 0))), 0);
}

TEST(PictureLightStatistical, Sphere) {
  for (bool two_sided : {false, true}) {
    const SphereLight light = sphere(twelve_texels(), two_sided);
    expect_density(light, {1, -30, 3}, 0.6);
    expect_density(light, {2.5f, 2, 2}, 0.6);
  }
  expect_density(sphere(twelve_texels(), true), {1.2f, 2.1f, 3}, 1 - 2e-3);
  const LightSamplingContext inside{{1.2f, 2, 3}, {0, -1, 0}};
  const SphereLight light = sphere(twelve_texels());
  EXPECT_FALSE(light.sample(inside, {0.3f, 0.4f}) || light.sample(inside, {0.95f, 0.4f}));
}

/// One cell in a hundred shines, in sight.
template <class L>
void expect_less_variance(L light, const EmissionGrid& grid, vec3 from, double times) {
  SCOPED_TRACE(testing::Message() << L::kName << " from " << from.y);
  L even = light;
  even.picture = nullptr;
  const LightSamplingContext ctx{from, glm::normalize(light.center - from)};
  const double mean = sum(over_light(light, ctx, [&](vec2 q, float) { return grid.pdf(q); }));
  ASSERT_GT(mean, 0);
  auto variance = [&](const L& l) {
    return sum(over_light(l, ctx, [&](vec2 q, float pdf) { return sqr(grid.pdf(q)) / pdf; })) - sqr(mean);
  };
  EXPECT_LT(times * variance(light), variance(even));
  auto covered = [](const std::vector<double>& parts) { return sum(parts); };
  EXPECT_GT(covered(over_light(light, ctx, [](vec2, float pdf) { return pdf > 0 ? 1.0f : 0.0f; })),
            0.999 * covered(over_light(light, ctx, [](vec2, float) { return 1.0f; })))
      << "nothing is left out";
}

TEST(PictureLight, AMostlyBlackPictureHasMuchLessVariance) {
  std::vector<float> luminance(24 * 16, 0.0f);
  for (std::size_t cell : {30u, 31u, 54u, 200u}) luminance[cell] = 1;
  const EmissionGrid grid(luminance, 24);
  for (vec3 from : {vec3(0, 1, 0), vec3(2, -4, 3), vec3(0, -40, 0)})
    expect_less_variance(disc(grid), grid, from, 10);
  const SphereLight ball = sphere(grid);
  const vec3 bright = place_at(ball, vec2(6.7f, 1.7f) / vec2(24, 16)).normal;
  for (vec3 from : {ball.center + 2.0f * bright, ball.center + 40.0f * bright,
                    ball.center + 3.0f * glm::normalize(bright + vec3(0.7f, 0.3f, -0.4f))})
    expect_less_variance(ball, grid, from, 4);
}

} // namespace
