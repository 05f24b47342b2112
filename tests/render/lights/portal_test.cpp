// Infinite lights that are sampled through portals.

#include "core/error.h"
#include "render/quadrants.h"
#include "render/world/render_scene.h"
#include "support/direction_statistics.h"

#include <random>

namespace {

using namespace candela;
using namespace candela::test;

/// Dim, with two bright spots, one of them low.
Spectrum some_sky(vec3 d) {
  const float spot = std::max(glm::dot(d, glm::normalize(vec3(0.3f, 0.4f, -1))), 0.0f),
              low = std::max(glm::dot(d, glm::normalize(vec3(-1, -0.2f, -0.4f))), 0.0f);
  return Spectrum(0.2f + 5 * std::pow(spot, 40.0f) + 2 * std::pow(low, 20.0f));
}

PortalRectangle some_portal() {
  PortalLightModel m;
  m.position = {0.5f, 1, -2}, m.direction = {0.2f, -0.1f, 1};
  m.roll = 0.3f, m.width = 1.6f, m.height = 1;
  return portal_rectangle(m);
}
bool leads_through(const PortalRectangle& portal, vec3 from, vec3 direction, float slack) {
  const float along = glm::dot(direction, portal.outwards);
  if (!(along > 0)) return false;
  const vec3 hit =
      from + direction * (glm::dot(portal.center - from, portal.outwards) / along) - portal.center;
  return std::abs(glm::dot(hit, portal.axis_x)) <= portal.half_size.x * slack &&
         std::abs(glm::dot(hit, portal.axis_y)) <= portal.half_size.y * slack;
}

TEST(PortalStatistical, DirectionsFollowTheDensityAndLeadThrough) {
  const PortalRectangle portal = some_portal();
  const PortalGuide guide(std::array{portal}, some_sky);
  for (vec3 from : {vec3(0, 0, 0), vec3(0.5f, 1, -1.5f), vec3(-2, 0.3f, 1), vec3(1.5f, 0.2f, -1.6f)}) {
    SCOPED_TRACE(testing::Message() << from.x << ' ' << from.y << ' ' << from.z);
    const PortalGuide::View view = guide.seen_from(from);
    ASSERT_GT(view.sum, 0);
    int outside = 0;
    auto draw = [&](std::size_t i) -> std::optional<vec3> {
      const std::uint64_t h = hash_combine(fresh_seed(), i);
      const vec3 d = guide.sample(view, {to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                                         to_unit_float(static_cast<std::uint32_t>(h))});
      outside += !leads_through(portal, from, d, 1 + 1e-5f);
      return d;
    };
    const auto pdf = [&](vec3 d) { return static_cast<double>(guide.pdf(view, d)); };
    const DirectionTest result =
        test_directions(SphereBins(glm::normalize(portal.center - from), 0.5, 32, 64), 40000, draw, pdf);
    EXPECT_EQ(outside, 0);
    EXPECT_NEAR(result.pdf_integral, 1, 2e-3);
    EXPECT_GT(result.chi_square.p_value, sidak_threshold(4)) << seed_note();
  }
}

TEST(Portal, DensityFollowsTheSkyWithinAndIsNothingBeside) {
  const PortalRectangle portal = some_portal();
  const PortalGuide guide(std::array{portal}, some_sky);
  const vec3 from(0.2f, 0.8f, 0);
  const PortalGuide::View view = guide.seen_from(from);
  double ratio = 0;
  for (int i = 1; i < 10; ++i)
    for (int j = 1; j < 10; ++j) {
      const vec3 p = portal.center + portal.half_size.x * (0.2f * static_cast<float>(i) - 1) * portal.axis_x +
                     portal.half_size.y * (0.2f * static_cast<float>(j) - 1) * portal.axis_y;
      const vec3 d = glm::normalize(p - from);
      const double here = static_cast<double>(guide.pdf(view, d) / some_sky(d).g);
      if (ratio == 0) ratio = here;
      EXPECT_NEAR(here, ratio, 0.03 * ratio) << i << ' ' << j;
    }
  for (vec3 beside : {2.1f * portal.half_size.x * portal.axis_x, -1.2f * portal.half_size.y * portal.axis_y})
    EXPECT_EQ(guide.pdf(view, glm::normalize(portal.center + beside - from)), 0);
  EXPECT_EQ(guide.seen_from(portal.center + 0.5f * portal.outwards).sum, 0) << "from outside";
}

/// A room of which the wall at z = -2 is missing but for what leaves two windows open, a third opening in the
/// ceiling that nobody has told of, and a floor that goes on outside.
Document room(bool with_portals, bool constant) {
  SceneMaker s(8, 8, 1);
  const int white = s.diffuse({0.7f, 0.6f, 0.5f}), floor = s.diffuse({0.5f, 0.6f, 0.7f});
  s.rectangle({0, 0, 0}, {0, 0, 6}, {6, 0, 0}, floor);
  s.rectangle({-2, 1.25f, 0}, {0, 1.25f, 0}, {0, 0, 2}, white);
  s.rectangle({2, 1.25f, 0}, {0, 0, 2}, {0, 1.25f, 0}, white);
  s.rectangle({0, 1.25f, 2}, {0, 1.25f, 0}, {2, 0, 0}, white);
  s.rectangle({-0.3f, 2.5f, 0}, {1.7f, 0, 0}, {0, 0, 2}, white); // leaves a gap
  s.rectangle({0, 0.4f, -2}, {2, 0, 0}, {0, 0.4f, 0}, white);
  s.rectangle({0, 2.25f, -2}, {2, 0, 0}, {0, 0.25f, 0}, white);
  s.rectangle({-1.7f, 1.4f, -2}, {0.3f, 0, 0}, {0, 0.6f, 0}, white);
  s.rectangle({1.7f, 1.4f, -2}, {0.3f, 0, 0}, {0, 0.6f, 0}, white);
  s.rectangle({0, 1.4f, -2}, {0.4f, 0, 0}, {0, 0.6f, 0}, white);
  s.sphere({0.6f, 0.5f, 0.2f}, 0.5f, white);
  if (constant) {
    s.constant_light({2, 3, 4});
  } else {
    auto panorama = std::make_shared<Panorama>();
    panorama->image = {64, 32, {}};
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 64; ++x)
        panorama->image.pixels.push_back(y > 17                ? vec3(0.3f, 0.25f, 0.2f)
                                         : x % 16 < 3 && y > 9 ? vec3(9, 7, 5)
                                                               : vec3(0.8f, 1.2f, 2));
    LightDesc sky;
    sky.model = EnvironmentLightModel{.rotation = 0.7f, .panorama = panorama};
    s.document.scene.lights.push_back(sky);
  }
  if (with_portals)
    for (float x : {-0.9f, 0.9f}) {
      LightDesc portal;
      portal.model = PortalLightModel{{x, 1.4f, -2}, {0, 0, 1}, 0, 1, 1.2f};
      s.document.scene.lights.push_back(portal);
    }
  s.camera({0, 5, 4.5f}, {0, 0.5f, -0.5f}, 60); // over the rear wall: it sees inside and outside
  s.document.settings.path.max_depth = 4;
  return s.document;
}

Document with(Document d, LightSampling how, int spp, std::uint64_t salt) {
  d.settings.path.light_sampling = how;
  d.settings.stop.spp = spp;
  d.settings.sampler.type = SamplerType::independent;
  d.settings.sampler.seed = sampler_seed(salt);
  return d;
}

TEST(PortalStatistical, ChangesNoExpectation) {
  std::uint64_t salt = 0;
  for (bool constant : {false, true}) {
    const Estimate expected = estimate(render(with(room(false, constant), LightSampling::mis, 4096, ++salt)));
    for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis}) {
      SCOPED_TRACE(testing::Message() << "constant " << constant << ", strategy " << static_cast<int>(how));
      expect_same(estimate(render(with(room(true, constant), how, 1024, ++salt))), expected, 6);
    }
  }
}

TEST(PortalStatistical, HasLessVarianceInTheRoom) {
  auto variance = [](Document d) {
    d.scene.camera.position = {1.8f, 1.2f, 1.8f};
    d.scene.camera.target = {-1, 0.6f, 0.5f};
    const Film film = render(with(d, LightSampling::mis, 256, 99));
    double sum = 0;
    for (double v : estimate(film).variance) sum += v;
    return sum;
  };
  EXPECT_LT(2 * variance(room(true, false)), variance(room(false, false)));
}

TEST(PortalRender, ClosedOnesKeepTheBits) {
  Document closed = with(room(true, false), LightSampling::mis, 16, 7), none = closed;
  for (LightDesc& light : closed.scene.lights)
    if (std::holds_alternative<PortalLightModel>(light.model)) light.color = vec3(0);
  none.scene.lights.resize(1);
  const Film a = render(closed), b = render(none);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(a.mean(x, y), b.mean(x, y));
}

TEST(Portal, TooManyAreAnError) {
  Document d = room(true, true);
  for (int i = 0; i < 20; ++i) d.scene.lights.push_back(d.scene.lights.back());
  EXPECT_THROW(RenderScene::build(d), Error);
}

} // namespace
