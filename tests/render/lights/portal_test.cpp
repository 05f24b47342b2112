// Infinite lights that are sampled through portals.

#include "core/error.h"
#include "render/quadrants.h"
#include "render/world/render_scene.h"
#include "support/direction_statistics.h"

namespace {

using namespace candela;
using namespace candela::test;

/// Bright upwards and to one side.
Spectrum some_sky(vec3 d) { return Spectrum(1 + 0.8f * d.y + 0.5f * d.x * d.z); }

/// The same as a light.
EnvironmentLight some_environment() {
  static const auto map = [] {
    auto panorama = std::make_shared<Panorama>();
    panorama->image = {256, 128, {}};
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 256; ++x) {
        const float phi = 2 * kPi * (static_cast<float>(x) + 0.5f) / 256,
                    theta = kPi * (static_cast<float>(y) + 0.5f) / 128;
        panorama->image.pixels.push_back(
            some_sky({std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)}));
      }
    return EnvironmentMap(panorama, EnvironmentMapping::latlong);
  }();
  EnvironmentLight light;
  light.map = &map;
  return light;
}

/// Of two walls: the second looks out of the same one as the first.
std::vector<PortalLightModel> some_portals() {
  PortalLightModel m;
  m.position = {0.5f, 1, -2}, m.direction = {0.2f, -0.1f, 1};
  m.roll = 0.3f, m.width = 1.6f, m.height = 1;
  PortalLightModel beside = m, other;
  beside.position = {-1.5f, 1.2f, -1.8f}, beside.width = 0.5f;
  other.position = {2, 1, 0.5f}, other.direction = {-1, 0, 0.2f}, other.height = 1.5f;
  return {m, beside, other};
}

std::vector<LightDesc> described(const std::vector<PortalLightModel>& portals) {
  std::vector<LightDesc> lights;
  for (const PortalLightModel& m : portals) lights.emplace_back().model = m;
  return lights;
}

/// A light that knows the portals.
struct Guided {
  ScenePortals portals;
  Light light;
  Guided(Light made, const std::vector<PortalLightModel>& models) : portals(described(models)), light(made) {
    portals.give(light, nullptr, nullptr);
  }
};

bool leads_through(const PortalRectangle& portal, vec3 from, vec3 direction, float slack) {
  const float along = glm::dot(direction, portal.axes.outwards);
  if (!(along > 0)) return false;
  const vec3 hit =
      from + direction * (glm::dot(portal.center - from, portal.axes.outwards) / along) - portal.center;
  return std::abs(glm::dot(hit, portal.axes.x)) <= portal.half_size.x * slack &&
         std::abs(glm::dot(hit, portal.axes.y)) <= portal.half_size.y * slack;
}

/// Chi-square and integral of a light's samples, of which those by the portals must lead through one.
void expect_density(const Light& light, const std::vector<PortalLightModel>& portals,
                    const LightSamplingContext& ctx) {
  SCOPED_TRACE(testing::Message() << light_name(light) << " from " << ctx.position.x << ' ' << ctx.position.y
                                  << ' ' << ctx.position.z << ", domain " << static_cast<int>(ctx.domain));
  constexpr std::size_t kCount = 40000;
  int elsewhere = 0, wrong_pdf = 0;
  auto draw = [&](std::size_t i) -> std::optional<vec3> {
    const std::uint64_t h = hash_combine(fresh_seed(), i);
    const vec2 u(to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                 to_unit_float(static_cast<std::uint32_t>(h)));
    const auto s = sample_light(light, ctx, u);
    if (!s) return std::nullopt;
    const bool through = std::ranges::any_of(portals, [&](const PortalLightModel& m) {
      return leads_through(portal_rectangle(m), ctx.position, s->direction, 1 + 1e-5f);
    });
    elsewhere += u.x >= PortalGuide::kOwnShare && !through;
    wrong_pdf += !(std::abs(light_pdf(light, ctx, {}, s->direction) - s->pdf) <= 1e-3f * s->pdf);
    return s->direction;
  };
  const auto pdf = [&](vec3 d) { return static_cast<double>(light_pdf(light, ctx, {}, d)); };
  const vec3 axis = glm::normalize(portals[0].position - ctx.position);
  const double width =
      std::min(0.7, 0.8 / static_cast<double>(glm::length(portals[0].position - ctx.position)));
  const DirectionTest result = test_directions(SphereBins(axis, width, 32, 64), kCount, draw, pdf);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_LE(wrong_pdf, 40) << "some lie on an edge between two cells";
  EXPECT_NEAR(result.pdf_integral, 1, 3e-3);
  EXPECT_GT(result.chi_square.p_value, sidak_threshold(20)) << seed_note();
}

TEST(PortalStatistical, SamplesFollowTheDensityAndLeadThrough) {
  const auto portals = some_portals();
  for (const Light& light : {Light(some_environment()), Light(ConstantLight{{1, 2, 3}})}) {
    const Guided guided(light, portals);
    for (vec3 from : {vec3(0, 0, 0), vec3(0.5f, 1, -1.5f), vec3(-2, 0.3f, 1), vec3(1.5f, 0.2f, -1.4f)})
      expect_density(guided.light, portals, {from, glm::normalize(vec3(0.3f, 1, -0.2f))});
    // So far that a portal is about a cell of the chart.
    expect_density(guided.light, portals, {{1, 2, 40}, {0, 0.6f, -0.8f}});
    const vec3 from(0.2f, 0.8f, 0);
    expect_density(guided.light, portals, {from, {0, 0, 1}}); // sees one of them with its back
    expect_density(guided.light, portals, {from, {0, 1, 0}, ScatteringDomain::sphere});
    expect_density(guided.light, portals, LightSamplingContext::in_volume(from));
  }
}

/// The integral over what a portal shows, and of which densities share, by the area of the portal.
TEST(Portal, WindowsSendWhatComesThrough) {
  for (const PortalLightModel& m : some_portals()) {
    const PortalRectangle portal = portal_rectangle(m);
    const PortalChart chart(portal.axes, 128, 2, some_sky);
    for (vec3 from : {vec3(0, 0, 0), vec3(0.5f, 1.4f, -1.2f), vec3(-3, 0.3f, 4)}) {
      double sent = 0;
      constexpr int kSide = 400;
      for (int i = 0; i < kSide * kSide; ++i) {
        const vec2 at = portal.half_size * ((vec2(i % kSide, i / kSide) + 0.5f) * (2.0f / kSide) - 1.0f);
        const vec3 d = portal.center + at.x * portal.axes.x + at.y * portal.axes.y - from;
        const float r2 = glm::dot(d, d), cosine = glm::dot(d, portal.axes.outwards) / std::sqrt(r2);
        sent += static_cast<double>(luminance(some_sky(glm::normalize(d))) * cosine / r2);
      }
      sent *= static_cast<double>(m.width * m.height) / (kSide * kSide);
      const vec3 d = portal.center - from;
      const auto distance = static_cast<double>(glm::dot(d, portal.axes.outwards));
      const glm::dvec2 middle(glm::dot(d, portal.axes.x), glm::dot(d, portal.axes.y)), half(portal.half_size);
      EXPECT_NEAR(chart.window((middle - half) / distance, (middle + half) / distance).sum, sent,
                  2e-3 * sent);
    }
  }
}

TEST(Portal, DensityFollowsTheSkyWithinAndIsNothingBeside) {
  const PortalRectangle portal = portal_rectangle(some_portals()[0]);
  const auto chart = std::make_shared<const PortalChart>(portal.axes, 256, 2, some_sky);
  const PortalGuide guide(std::array{portal}, std::array{chart});
  const LightSamplingContext ctx{{0.2f, 0.8f, 0}, {0, 1, 0}};
  const PortalGuide::View view = guide.seen_from(ctx);
  double ratio = 0;
  for (int i = 1; i < 10; ++i)
    for (int j = 1; j < 10; ++j) {
      const vec3 p = portal.center + portal.half_size.x * (0.2f * static_cast<float>(i) - 1) * portal.axes.x +
                     portal.half_size.y * (0.2f * static_cast<float>(j) - 1) * portal.axes.y;
      const vec3 d = glm::normalize(p - ctx.position);
      const double here = static_cast<double>(guide.pdf(view, d) / luminance(some_sky(d)));
      if (ratio == 0) ratio = here;
      EXPECT_NEAR(here, ratio, 0.02 * ratio) << i << ' ' << j;
    }
  for (vec3 beside : {2.1f * portal.half_size.x * portal.axes.x, -1.2f * portal.half_size.y * portal.axes.y})
    EXPECT_EQ(guide.pdf(view, glm::normalize(portal.center + beside - ctx.position)), 0);
  EXPECT_EQ(guide.seen_from({portal.center + 0.5f * portal.axes.outwards, {0, 1, 0}}).sum, 0)
      << "from outside";
  EXPECT_EQ(guide.seen_from({ctx.position, portal.axes.outwards * -1.0f}).sum, 0) << "behind the surface";
}

/// Windows that begin and end within cells: each cell gets its share of the samples.
TEST(PortalStatistical, ChartsAreSampledBetweenTheirCells) {
  SCOPED_TRACE(seed_note());
  constexpr int kSide = 8;
  // Bright on the left of the third row, and on the right of the next.
  const auto sky = [](vec3 d) {
    const vec2 t = vec2(d) / -d.z;
    return Spectrum((t.y < -1 / 3.0f) == (t.x < 0) ? 5 : 1);
  };
  const PortalChart chart({}, kSide, 1, sky);
  auto tangents = [](glm::dvec2 cell) {
    const glm::dvec2 at = 2.0 * cell / double(kSide) - 1.0;
    return at / (1.0 - glm::abs(at));
  };
  const glm::dvec2 lo(1.2, 2.3), hi(6.7, 3.6);
  const PortalChart::Window window = chart.window(tangents(lo), tangents(hi));
  std::vector<double> expected, observed(std::size_t{kSide} * kSide);
  constexpr int kCount = 40000;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 corner(x, y), within = glm::min(hi, corner + 1.0) - glm::max(lo, corner);
      const double share = std::max(within.x, 0.0) * std::max(within.y, 0.0);
      expected.push_back(share > 0 ? kCount * share / window.sum *
                                         chart.window(tangents(corner), tangents(corner + 1.0)).sum
                                   : 0);
    }
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::uint64_t h = hash_combine(fresh_seed() + 1, i);
    const vec2 u(to_unit_float(static_cast<std::uint32_t>(h >> 32)),
                 to_unit_float(static_cast<std::uint32_t>(h)));
    const glm::dvec2 cell = chart.sample(window, u).place.cell;
    ++observed[static_cast<std::size_t>(cell.y) * kSide + static_cast<std::size_t>(cell.x)];
  }
  EXPECT_GT(chi_square_test(observed, expected).p_value, 1e-6);
}

/// What lights a room.
LightDesc surroundings(std::string_view what) {
  LightDesc light;
  light.color = {2, 3, 4};
  if (what == "constant") {
    light.model = ConstantLightModel{};
  } else if (what == "environment") {
    auto panorama = std::make_shared<Panorama>();
    panorama->image = {64, 32, {}};
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 64; ++x)
        panorama->image.pixels.push_back(y > 17                ? vec3(0.15f, 0.1f, 0.05f)
                                         : x % 16 < 3 && y > 9 ? vec3(4, 2, 1)
                                                               : vec3(0.4f, 0.4f, 0.5f));
    light.model = EnvironmentLightModel{.rotation = 0.7f, .panorama = panorama};
  } else {
    SkyLightModel sky;
    sky.resolution = 64;
    sky.sun_azimuth = radians(20.0f), sky.sun_elevation = radians(40.0f); // it shines in
    if (what == "sky without sun") sky.sun_scale = 0;
    light.model = sky;
    light.color = vec3(0.02f);
  }
  return light;
}

/// A room of which the wall at z = -2 is missing but for what leaves two windows open. With a gap in the
/// ceiling that nobody has told of, if `gap`; the floor continues outside.
Document room(std::string_view what, bool gap, const std::vector<PortalLightModel>& portals) {
  SceneMaker s(8, 8, 1);
  const int white = s.diffuse({0.7f, 0.6f, 0.5f}), floor = s.diffuse({0.5f, 0.6f, 0.7f});
  s.rectangle({0, 0, 0}, {0, 0, 6}, {6, 0, 0}, floor);
  s.rectangle({-2, 1.25f, 0}, {0, 1.25f, 0}, {0, 0, 2}, white);
  s.rectangle({2, 1.25f, 0}, {0, 0, 2}, {0, 1.25f, 0}, white);
  s.rectangle({0, 1.25f, 2}, {0, 1.25f, 0}, {2, 0, 0}, white);
  if (gap)
    s.rectangle({-0.3f, 2.5f, 0}, {1.7f, 0, 0}, {0, 0, 2}, white);
  else
    s.rectangle({0, 2.5f, 0}, {2, 0, 0}, {0, 0, 2}, white);
  s.rectangle({0, 0.4f, -2}, {2, 0, 0}, {0, 0.4f, 0}, white);
  s.rectangle({0, 2.25f, -2}, {2, 0, 0}, {0, 0.25f, 0}, white);
  s.rectangle({-1.7f, 1.4f, -2}, {0.3f, 0, 0}, {0, 0.6f, 0}, white);
  s.rectangle({1.7f, 1.4f, -2}, {0.3f, 0, 0}, {0, 0.6f, 0}, white);
  s.rectangle({0, 1.4f, -2}, {0.4f, 0, 0}, {0, 0.6f, 0}, white);
  s.sphere({0.6f, 0.5f, 0.2f}, 0.5f, white);
  s.document.scene.lights = {surroundings(what)};
  for (const LightDesc& portal : described(portals)) s.document.scene.lights.push_back(portal);
  s.camera({1.8f, 1.2f, 1.8f}, {-1, 0.6f, 0.5f}, 60);
  return s.document;
}
std::vector<PortalLightModel> windows() {
  return {{{-0.9f, 1.4f, -2}, {0, 0, 1}, 0, 1, 1.2f}, {{0.9f, 1.4f, -2}, {0, 0, 1}, 0, 1, 1.2f}};
}
/// One that covers half of its window and some of the wall, one in a wall without a window, and one that
/// looks out of the room from the middle of it.
std::vector<PortalLightModel> misplaced() {
  return {{{-1.2f, 1.2f, -2}, {0, 0, 1}, 0.2f, 1, 1},
          {{-2, 1, 0}, {1, 0, 0}, 0, 1, 1},
          {{0, 1, 0}, {0.5f, 0.2f, 1}, 0, 0.7f, 0.7f}};
}

Document with(Document d, LightSampling how, int spp, std::uint64_t salt) {
  d.settings.path.light_sampling = how;
  d.settings.stop.spp = spp;
  d.settings.sampler.type = SamplerType::independent;
  d.settings.sampler.seed = sampler_seed(salt);
  return d;
}

/// Inside, and what lies outside of the windows.
TEST(PortalStatistical, ChangeNoExpectation) {
  std::uint64_t salt = 0;
  for (const char* what : {"constant", "environment", "sky without sun", "sky"})
    for (const auto& portals : {windows(), misplaced()}) {
      auto seen = [&](const std::vector<PortalLightModel>& given) {
        Document d = room(what, true, given);
        d.settings.path.max_depth = 4;
        d.scene.camera.position = {0.2f, 1.3f, 1.8f}, d.scene.camera.target = {0, 0.9f, -2};
        return d;
      };
      // BSDF sampling alone finds the sun's disc too seldom for a normal distribution.
      const bool sun = std::string_view(what) == "sky";
      const Estimate expected = estimate(render(with(seen({}), LightSampling::mis, 2048, ++salt)));
      for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis}) {
        if (sun && how == LightSampling::bsdf) continue;
        SCOPED_TRACE(testing::Message()
                     << what << ", " << portals.size() << " portals, strategy " << static_cast<int>(how));
        expect_same(estimate(render(with(seen(portals), how, 1024, ++salt))), expected, 22);
      }
    }
}

/// Seen from the windows, which would be most of the noise: their edges are in pixels that see them.
TEST(PortalStatistical, HaveLessVarianceInTheRoom) {
  auto variance = [](Document d, int only_depth) {
    d.scene.camera.position = {0.3f, 1.3f, -1.7f}, d.scene.camera.target = {-0.4f, 0.9f, 2};
    d.settings.path.only_depth = only_depth;
    double sum = 0;
    for (double v : estimate(render(with(d, LightSampling::mis, 256, 99))).variance) sum += v;
    return sum;
  };
  for (const char* what : {"constant", "environment", "sky without sun"})
    for (int only_depth : {2, 0}) {
      const double without = variance(room(what, false, {}), only_depth),
                   with_portals = variance(room(what, false, windows()), only_depth);
      EXPECT_LT((only_depth == 2 ? 8 : 2) * with_portals, without) << what;
    }
}

TEST(PortalRender, ClosedOnesKeepTheBits) {
  Document closed = with(room("environment", true, windows()), LightSampling::mis, 16, 7), none = closed;
  for (LightDesc& light : closed.scene.lights)
    if (std::holds_alternative<PortalLightModel>(light.model)) light.color = vec3(0);
  none.scene.lights.resize(1);
  const Film a = render(closed), b = render(none);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(a.mean(x, y), b.mean(x, y));
}

TEST(Portal, TooManyAreAnError) {
  Document d = room("constant", true, windows());
  for (int i = 0; i < 20; ++i) d.scene.lights.push_back(d.scene.lights.back());
  EXPECT_THROW(RenderScene::build(d), Error);
}

} // namespace
