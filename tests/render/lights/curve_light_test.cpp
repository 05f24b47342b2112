// Pieces of curves as lights: samples against densities, and that every place of a curve is one light's.

#include "render/render_testing.h"
#include "render/world/render_scene.h"
#include "support/direction_statistics.h"

#include <random>

namespace candela::test {
namespace {

std::shared_ptr<const RenderScene> glowing(Strands strands, CurveForm form) {
  SceneMaker s(8, 8, 1);
  CurvesShape shape;
  shape.strands = std::make_shared<const Strands>(std::move(strands));
  shape.form = static_cast<int>(form);
  s.document.scene.instances.push_back({"", shape, mat4(1), {s.diffuse(vec3(0.2f), {1, 2, 3})}});
  return RenderScene::build(s.document);
}

/// One piece, for it is not long for its width.
Strands bent(float width, float tip_width) {
  Strands s;
  s.basis = CurveBasis::bezier;
  s.points = {{-0.5f, 2, 0}, {-0.2f, 2.3f, 0.1f}, {0.2f, 2.2f, -0.1f}, {0.5f, 2, 0.1f}};
  s.counts = {4};
  s.widths = {width, tip_width};
  return s;
}

/// Winds up, and turns at a corner.
Strands curl_with_a_corner(float width, float tip_width) {
  Strands s;
  s.basis = CurveBasis::bezier;
  s.points = {{0, 0, 0},    {0.2f, 0.4f, 0}, {0.5f, 0.5f, 0.3f}, {0.7f, 0.6f, 0.3f}, {0.9f, 0.7f, 0.3f},
              {1, 0.9f, 0}, {0.8f, 1.1f, 0}, {1.1f, 0.9f, 0.2f}, {1.3f, 0.6f, 0.4f}, {1.5f, 0.7f, 0}};
  s.counts = {10};
  s.widths = {width, tip_width};
  return s;
}

const CurveLight& light_at(const RenderScene& scene, std::size_t i) {
  return std::get<CurveLight>(scene.lights().at(i));
}

/// `least`: of the samples that meet the curve.
void expect_density(const RenderScene& scene, vec3 from, double width, double least) {
  SCOPED_TRACE(testing::Message() << "from " << from.x << ' ' << from.y << ' ' << from.z);
  ASSERT_EQ(scene.lights().size(), 1u);
  const CurveLight& light = light_at(scene, 0);
  const vec3 axis = glm::normalize(vec3(0, 2.2f, 0) - from);
  const LightSamplingContext ctx{from, axis};
  int wrong = 0;
  auto meets = [&](vec3 w) { // by the scene's own intersection
    Hit hit;
    return scene.geometry().accel().intersect({from, 0, w, kInfinity}, hit);
  };
  auto draw = [&](std::size_t i) -> std::optional<vec3> {
    const std::uint64_t h = hash_combine(fresh_seed(), i);
    const auto s = light.sample(ctx, {to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                                      to_unit_float(static_cast<std::uint32_t>(h))});
    if (!s) return std::nullopt;
    wrong += !(std::abs(light.pdf(ctx, s->point, s->direction) - s->pdf) <= 1e-3f * s->pdf) ||
             s->radiance != light.emission || s->delta || s->infinite ||
             !(glm::length(glm::normalize(s->point - from) - s->direction) < 1e-5f);
    // At the outline the direction to the rounded point may pass the curve by, as the one that met it did
    // not.
    if (meets(s->direction)) return s->direction;
    const Basis across = Basis::from_normal(s->direction);
    for (const vec3 aside : {across.s, -across.s, across.t, -across.t})
      if (const vec3 w = glm::normalize(s->direction + 2e-5f * aside); meets(w)) return w;
    return s->direction;
  };
  auto pdf = [&](vec3 w) { return meets(w) ? static_cast<double>(light.pdf(ctx, {}, w)) : 0.0; };
  const DirectionTest result = test_directions(SphereBins(axis, width, 16, 32), 40000, draw, pdf);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(result.pdf_integral, least);
  EXPECT_LT(result.pdf_integral, 1 + 2e-3);
  EXPECT_GT(result.chi_square.p_value, sidak_threshold(9)) << seed_note();
}

TEST(CurveLightStatistical, SamplesFollowTheDensity) {
  for (CurveForm form : {CurveForm::round, CurveForm::ribbon}) {
    const auto thick = glowing(bent(0.2f, 0.1f), form);
    expect_density(*thick, {0.2f, 1.6f, 0.3f}, 0.6, 0.15);
    expect_density(*thick, {-3, 1.9f, 0.1f}, 0.08, 0.1); // along it
  }
  const auto thick = glowing(bent(0.2f, 0.1f), CurveForm::round);
  expect_density(*thick, {0, 2.35f, 0.2f}, 1.5, 0.01); // in the ball about it
  expect_density(*thick, {0.45f, 2.02f, 0.3f}, 0.8, 0.03);
  expect_density(*glowing(bent(0.12f, 0), CurveForm::ribbon), {0.1f, 12, 1}, 0.05, 0.1);
}

/// Far and thin enough to be sampled by the proxy's area.
TEST(CurveLight, ASmallOneIsAsBrightAsItsSize) {
  Strands straight = bent(0.01f, 0.01f);
  for (int k = 0; k < 4; ++k)
    straight.points[static_cast<std::size_t>(k)] = {0.05f * static_cast<float>(k) - 0.075f, 0, 0};
  const auto scene = glowing(straight, CurveForm::round);
  const LightSamplingContext ctx{{0, 60, 10}, {0, -1, 0}};
  double sum = 0;
  constexpr int kSide = 300;
  for (std::size_t piece = 0; piece < scene->lights().size(); ++piece)
    for (int i = 0; i < kSide * kSide; ++i) {
      const int column = i % kSide, row = i / kSide;
      const auto s =
          light_at(*scene, piece).sample(ctx, (vec2(column, row) + 0.5f) / static_cast<float>(kSide));
      if (s) sum += 1 / static_cast<double>(s->pdf);
    }
  // A cylinder 0.15 long and 0.01 thick with half balls, seen from the side.
  const double expected = (0.15 * 0.01 + std::numbers::pi * 0.25 * 1e-4) / (60.0 * 60 + 10 * 10);
  EXPECT_NEAR(sum / (kSide * kSide), expected, 0.01 * expected);
}

/// Of all lights, the one that a ray's hit is counted as is met and seen, and no other one.
TEST(CurveLight, EveryPlaceIsOneLights) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(fresh_seed()));
  SCOPED_TRACE(seed_note());
  std::normal_distribution<float> normal;
  for (CurveForm form : {CurveForm::round, CurveForm::ribbon}) {
    const auto scene = glowing(curl_with_a_corner(0.12f, 0.06f), form);
    const CurveSurfaces& curves = scene->geometry().curves();
    ASSERT_GE(curves.segments.size(), 3u);
    int hits = 0, joints = 0, wrong = 0, twice = 0, without = 0;
    for (int i = 0; i < 200000; ++i) {
      const vec3 from = vec3(0.7f, 0.5f, 0.1f) +
                        3.0f * glm::normalize(vec3(normal(random), normal(random), normal(random)));
      // Half of them near a joint.
      const std::size_t piece = static_cast<std::size_t>(random()) % curves.segments.size();
      const vec3 to = vec3(curves.segments[piece].points[i % 2 == 0 ? 0 : 1 + random() % 2]) +
                      0.05f * vec3(normal(random), normal(random), normal(random));
      const vec3 direction = glm::normalize(to - from);
      Hit hit;
      if (!scene->geometry().accel().intersect({from, 0, direction, kInfinity}, hit)) continue;
      ++hits;
      joints += hit.u < 0 || hit.u > 1 || hit.u == 0;
      const auto surface = scene->geometry().surface({from, 0, direction, kInfinity}, hit);
      const std::uint32_t own = scene->light_of(surface.emitter);
      without += own == kNoLight;
      int met_there = 0;
      for (std::uint32_t l = 0; l < scene->lights().size(); ++l) {
        const CurveLight& light = light_at(*scene, l);
        const auto met = curves.meet(light.piece, from, direction);
        if (!met) continue;
        const vec3 end = offset_ray_origin(met->point, met->point_error, met->normal, -direction);
        if (scene->geometry().accel().occluded({from, 0, end - from, 1 - gamma_bound(16)})) continue;
        ++met_there;
        wrong += l != own;
      }
      if (own != kNoLight) wrong += met_there == 0;
      twice += met_there > 1;
    }
    EXPECT_GT(hits, 10000);
    EXPECT_GT(joints, form == CurveForm::round ? 20 : 1);
    // What extends a piece beyond its end is not quite what the neighbour is.
    EXPECT_LE(wrong, hits / 10000) << twice << " twice, of " << hits;
    EXPECT_EQ(without > 0, form == CurveForm::ribbon) << "at corners of ribbons";
  }
}

TEST(CurveLight, ThoseThatVaryOrLetLightThroughAreNone) {
  SceneMaker s(8, 8, 1);
  s.document.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"", CheckerTexture{vec3(1), vec3(0), 2}}));
  Material veil, even, checked;
  veil.emission = even.emission = checked.emission = vec3(1);
  veil.opacity = 0.5f;
  checked.emission.use.texture = 0;
  for (const Material& m : {veil, checked, even})
    s.document.scene.instances.push_back({"", CurvesShape{}, mat4(1), {s.material(m)}});
  const auto scene = RenderScene::build(s.document);
  ASSERT_FALSE(scene->lights().empty());
  for (std::size_t i = 0; i < scene->lights().size(); ++i) {
    const CurveSurfaces& curves = scene->geometry().curves();
    EXPECT_EQ(curves.shapes[curves.parts[light_at(*scene, i).piece].shape].material, 2u);
  }
}

} // namespace
} // namespace candela::test
