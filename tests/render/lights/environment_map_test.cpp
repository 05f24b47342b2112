// Panoramas: mappings of directions, sampling, illumination.

#include "lights/environment_map.h"
#include "render/closed_forms.h"
#include "render/render_testing.h"
#include "support/direction_statistics.h"

#include <functional>
#include <random>

namespace {

using namespace candela;
using namespace candela::test;
using glm::dvec2;
using glm::dvec3;
using enum EnvironmentMapping;

/// The direction of a point of an image, x to the right and y downwards in [0, 1]^2, by formulas written
/// apart; nothing where the mapping has none.
struct MappingCase {
  const char* name;
  EnvironmentMapping mapping;
  ivec2 size;
};

std::optional<dvec3> in_square(int face, dvec2 q) { // +x -x +y -y +z -z, seen from the inside
  double s = 2 * q.x - 1, t = 1 - 2 * q.y;
  const dvec3 d[6] = {{1, t, s}, {-1, t, -s}, {s, 1, t}, {s, -1, -t}, {-s, t, 1}, {s, t, -1}};
  return glm::normalize(d[face]);
}

std::optional<dvec3> direction_of(const MappingCase& m, dvec2 p) {
  switch (m.mapping) {
  case latlong: { // seen from the inside, +z ahead in the middle, -x to the right of it
    double azimuth = 2 * kPiD * (p.x - 0.5), height = kPiD * (0.5 - p.y);
    return dvec3(-std::sin(azimuth) * std::cos(height), std::sin(height),
                 std::cos(azimuth) * std::cos(height));
  }
  case angular: {
    double x = 2 * p.x - 1, y = 1 - 2 * p.y, r = std::hypot(x, y);
    if (r > 1) return std::nullopt;
    double s = r > 0 ? std::sin(kPiD * r) / r : 0;
    return dvec3(s * x, s * y, -std::cos(kPiD * r));
  }
  case cross: {
    bool upright = m.size.y > m.size.x;
    dvec2 q = p * (upright ? dvec2(3, 4) : dvec2(4, 3));
    ivec2 square = glm::min(ivec2(q), upright ? ivec2(2, 3) : ivec2(3, 2));
    q -= dvec2(square);
    if (square == ivec2(1, 0)) return in_square(2, q);
    if (square == ivec2(0, 1)) return in_square(1, q);
    if (square == ivec2(1, 1)) return in_square(5, q);
    if (square == ivec2(2, 1)) return in_square(0, q);
    if (square == ivec2(1, 2)) return in_square(3, q);
    if (!upright && square == ivec2(3, 1)) return in_square(4, q);
    if (upright && square == ivec2(1, 3)) return in_square(4, 1.0 - q);
    return std::nullopt;
  }
  case faces: {
    int face = std::min(static_cast<int>(6 * p.y), 5);
    return in_square(face, {p.x, 6 * p.y - face});
  }
  }
  return std::nullopt;
}

const MappingCase kCases[] = {{"latlong", latlong, {16, 8}},
                              {"angular", angular, {17, 17}},
                              {"cross", cross, {24, 18}},
                              {"upright cross", cross, {18, 24}},
                              {"faces", faces, {6, 36}}};

MappingCase finer(MappingCase m, int factor) {
  m.size *= factor;
  return m;
}

/// The picture of a radiance by direction; outside of the mapping `beyond`.
std::shared_ptr<const Panorama> picture(const MappingCase& m, const std::function<vec3(vec3)>& radiance,
                                        vec3 beyond = vec3(0)) {
  auto panorama = std::make_shared<Panorama>();
  Image& image = panorama->image;
  image.width = m.size.x, image.height = m.size.y;
  for (int y = 0; y < m.size.y; ++y)
    for (int x = 0; x < m.size.x; ++x) {
      auto d = direction_of(m, (dvec2(x, y) + 0.5) / dvec2(m.size));
      image.pixels.push_back(d ? radiance(vec3(*d)) : beyond);
    }
  return panorama;
}

std::shared_ptr<const Panorama> single_texels(const MappingCase& m, std::mt19937& random, int count) {
  auto panorama = std::make_shared<Panorama>(*picture(m, [](vec3) { return vec3(0); }));
  std::uniform_int_distribution<std::size_t> texel(0, panorama->image.pixels.size() - 1);
  for (int i = 0; i < count; ++i) panorama->image.pixels[texel(random)] = vec3(1, 2, 3);
  return panorama;
}

vec3 random_direction(std::uint64_t i) {
  std::uint64_t h = hash_combine(fresh_seed(), i);
  return sample_uniform_sphere(
      {to_unit_float(static_cast<std::uint32_t>(h >> 32)), to_unit_float(static_cast<std::uint32_t>(h))});
}

float smooth(vec3 d) { return 2 + d.x + 0.5f * d.y - 0.3f * d.z * d.x; }

TEST(EnvironmentMap, EveryMappingShowsTheSameWorld) {
  for (const MappingCase& m : kCases) {
    SCOPED_TRACE(m.name);
    MappingCase fine = finer(m, 16);
    EnvironmentMap map(picture(
                           fine, [](vec3 d) { return vec3(smooth(d)) + d; }, vec3(2)),
                       m.mapping);
    for (std::uint64_t i = 0; i < 20000; ++i) {
      vec3 d = random_direction(i);
      if (m.mapping == angular && d.z > 0.999f) continue; // half a texel from the rim
      vec3 seen = map.radiance(d), is = vec3(smooth(d)) + d;
      // Beyond the centres of a lat-long picture's last rows there is nothing to interpolate with: there it
      // is off by up to half a row times the steepest slope, sqrt(3) 1.43 + 1.
      float half_row = 0.5f * kPi / static_cast<float>(fine.size.y);
      bool at_pole = m.mapping == latlong && std::acos(std::abs(d.y)) < half_row;
      ASSERT_LT(glm::length(seen - is), at_pole ? 3.5f * half_row : 0.01f)
          << d.x << " " << d.y << " " << d.z << "; " << seed_note();
    }
  }
}

TEST(EnvironmentMap, AxesAreAsDocumented) {
  // One white texel where the documentation says that an axis is.
  struct Axis {
    MappingCase map;
    ivec2 texel;
    vec3 direction;
  };
  MappingCase wide{"latlong", latlong, {64, 33}}, ball{"angular", angular, {65, 65}},
      lying{"cross", cross, {36, 27}}, upright{"cross", cross, {27, 36}}, column{"faces", faces, {9, 54}};
  const Axis axes[] = {
      {wide, {32, 16}, {0, 0, 1}},    {wide, {16, 16}, {1, 0, 0}},     {wide, {48, 16}, {-1, 0, 0}},
      {wide, {0, 16}, {0, 0, -1}},    {ball, {32, 32}, {0, 0, -1}},    {ball, {48, 32}, {1, 0, 0}},
      {ball, {32, 16}, {0, 1, 0}},    {lying, {13, 13}, {0, 0, -1}},   {lying, {22, 13}, {1, 0, 0}},
      {lying, {4, 13}, {-1, 0, 0}},   {lying, {13, 4}, {0, 1, 0}},     {lying, {13, 22}, {0, -1, 0}},
      {lying, {31, 13}, {0, 0, 1}},   {upright, {13, 31}, {0, 0, 1}},  {upright, {13, 4}, {0, 1, 0}},
      {upright, {4, 13}, {-1, 0, 0}}, {column, {4, 4}, {1, 0, 0}},     {column, {4, 13}, {-1, 0, 0}},
      {column, {4, 22}, {0, 1, 0}},   {column, {4, 31}, {0, -1, 0}},   {column, {4, 40}, {0, 0, 1}},
      {column, {4, 49}, {0, 0, -1}},  {upright, {13, 22}, {0, -1, 0}}, {upright, {22, 13}, {1, 0, 0}}};
  for (const Axis& axis : axes) {
    auto panorama = std::make_shared<Panorama>(*picture(axis.map, [](vec3) { return vec3(0); }));
    panorama->image.at(axis.texel.x, axis.texel.y) = vec3(1);
    EnvironmentMap map(panorama, axis.map.mapping);
    // The centre of latlong's texel is half a texel off its edge: 64 is even.
    EXPECT_GT(map.radiance(axis.direction).x, 0.45f)
        << axis.map.name << " " << axis.texel.x << " " << axis.texel.y;
  }
}

TEST(EnvironmentMap, DensityIsPositiveWhereverLightIs) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(fresh_seed()));
  for (const MappingCase& m : kCases)
    for (int round = 0; round < 8; ++round) {
      SCOPED_TRACE(m.name);
      EnvironmentMap map(single_texels(m, random, 1 + round % 3), m.mapping);
      int lit = 0;
      for (std::uint64_t i = 0; i < 40000; ++i) {
        vec3 d = random_direction(hash_combine(static_cast<std::uint64_t>(round), i));
        if (is_black(map.radiance(d))) continue;
        ++lit;
        ASSERT_GT(map.pdf(d), 0) << d.x << " " << d.y << " " << d.z << "; " << seed_note();
      }
      if (m.mapping != cross && m.mapping != angular) { // others may have their texel outside
        EXPECT_GT(lit, 0);
      }
    }
}

TEST(EnvironmentMap, TotalIsTheIntegralOfTheLuminance) {
  for (const MappingCase& m : kCases) {
    SCOPED_TRACE(m.name);
    EnvironmentMap map(picture(
                           finer(m, 4), [](vec3 d) { return vec3(smooth(d)); }, vec3(2)),
                       m.mapping);
    EXPECT_NEAR(map.total_luminance(), 8 * kPi, m.mapping == angular ? 0.15f : 0.05f) << "2 on average";
  }
}

TEST(EnvironmentMap, MoreTexelsThanCells) { // 4099 texels share 2048 cells
  auto panorama = std::make_shared<Panorama>();
  panorama->image = {4099, 3, std::vector<vec3>(3 * 4099, vec3(0))};
  for (int x : {0, 1, 1000, 2049, 4098}) panorama->image.at(x, 1) = vec3(1);
  EnvironmentMap map(panorama, latlong);
  for (int i = 0; i < 200000; ++i) {
    double phi = 2 * kPiD * (i + 0.5) / 200000;
    vec3 d(static_cast<float>(std::sin(phi)), 0, static_cast<float>(-std::cos(phi)));
    if (is_black(map.radiance(d))) continue;
    ASSERT_GT(map.pdf(d), 0) << phi;
  }
}

void expect_density(const MappingCase& m, const EnvironmentMap& map, EnvironmentDensity of) {
  SCOPED_TRACE(m.name);
  int unlike = 0;
  auto draw = [&](std::size_t i) -> std::optional<vec3> {
    std::uint64_t h = hash_combine(fresh_seed(), i);
    auto s = map.sample(
        {to_unit_float(static_cast<std::uint32_t>(h >> 32)), to_unit_float(static_cast<std::uint32_t>(h))},
        of);
    if (!s) return std::nullopt;
    auto seen = map.lookup(s->direction, of); // at a texel's edge, rounding may look into the next
    unlike += std::abs(seen.pdf - s->pdf) > 0.01f * s->pdf;
    if (!(seen.pdf > 0)) return std::nullopt; // or into nothing
    return s->direction;
  };
  auto result = test_directions(SphereBins({0, 0, 1}, 2, 24, 36), 60000, draw,
                                [&](vec3 w) { return static_cast<double>(map.pdf(w, of)); });
  EXPECT_LT(unlike, 60);
  EXPECT_NEAR(result.pdf_integral, 1, m.mapping == angular ? 0.05 : 2e-3); // its corners show nothing
  EXPECT_GT(result.chi_square.p_value, sidak_threshold(20)) << seed_note();
}

TEST(EnvironmentMapStatistical, SamplesFollowTheDensity) {
  for (const MappingCase& m : kCases)
    for (EnvironmentDensity of : {EnvironmentDensity::full, EnvironmentDensity::compensated}) {
      expect_density(m, {picture(m, [](vec3 d) { return vec3(smooth(d)); }), m.mapping}, of);
      auto lamps = [](vec3 d) { return vec3(d.x > 0.8f ? 20.0f : (d.y < -0.6f ? 0.0f : 1.0f)); };
      expect_density(m, {picture(m, lamps), m.mapping}, of);
    }
}

TEST(EnvironmentMap, WhatIsDarkerThanTheMeanIsLeftToChance) {
  const MappingCase m = finer(kCases[0], 4);
  auto sky = [](vec3 d) { return vec3(d.y > 0.9f ? 30.0f : 1.0f); };
  EnvironmentMap map(picture(m, sky), m.mapping);
  const vec3 sun(0, 1, 0), blue = glm::normalize(vec3(1, 0.3f, 0));
  EXPECT_GT(map.pdf(blue), 0);
  EXPECT_EQ(map.pdf(blue, EnvironmentDensity::compensated), 0);
  EXPECT_GT(map.pdf(sun, EnvironmentDensity::compensated), 1.3f * map.pdf(sun));
  EXPECT_EQ(map.lookup(blue, EnvironmentDensity::compensated).radiance, map.radiance(blue));
  EXPECT_LT(map.total_luminance(EnvironmentDensity::compensated), map.total_luminance());
  // Where all is alike there is nothing to leave out.
  EnvironmentMap even(picture(m, [](vec3) { return vec3(3); }), m.mapping);
  EXPECT_EQ(even.pdf(blue, EnvironmentDensity::compensated), even.pdf(blue));
  EXPECT_GT(even.pdf(blue), 0);
}

LightDesc environment(std::shared_ptr<const Panorama> panorama, EnvironmentMapping mapping) {
  LightDesc light;
  light.model = EnvironmentLightModel{.mapping = mapping, .panorama = std::move(panorama)};
  return light;
}

vec3 radiance_from(const LightDesc& light, vec3 d) {
  Document document;
  document.scene.lights.push_back(light);
  return light_radiance(RenderScene::build(document)->lights()[0], d);
}

TEST(EnvironmentLight, RotationTurnsThePictureByExactlyThat) {
  MappingCase m = finer(kCases[0], 8);
  LightDesc light = environment(picture(m, [](vec3 d) { return vec3(smooth(d)) + d; }), latlong);
  light.scale = 3;
  light.color = {1, 2, 0.5f};
  for (float angle : {0.0f, 30.0f, 90.0f, -200.0f})
    for (vec3 up : {vec3(0, 1, 0), vec3(0, 0, 2), vec3(0, -1, 0), vec3(1, 1, 1)}) {
      LightDesc turned = light;
      auto& model = std::get<EnvironmentLightModel>(turned.model);
      model.rotation = radians(angle);
      model.up = up;
      mat3 around = mat3(glm::rotate(mat4(1), radians(angle), vec3(0, 1, 0)));
      vec3 n = glm::normalize(up);
      for (std::uint64_t i = 0; i < 50; ++i) {
        vec3 d = around * random_direction(i), was = random_direction(i);
        if (up == vec3(0, 0, 2)) d = {d.x, -d.z, d.y}; // y to z by a quarter turn about x
        if (up == vec3(0, -1, 0)) d = {d.x, -d.y, -d.z};
        if (up == vec3(1)) { // Rodrigues' formula with the axis y x up
          vec3 axis = glm::normalize(glm::cross(vec3(0, 1, 0), n));
          float c = n.y, s = std::sqrt(1 - c * c);
          d = c * d + s * glm::cross(axis, d) + (1 - c) * glm::dot(axis, d) * axis;
        }
        vec3 expected = radiance_from(light, was), seen = radiance_from(turned, d);
        EXPECT_LT(glm::length(seen - expected), 2e-4f * glm::length(expected))
            << angle << "; " << seed_note();
      }
    }
}

TEST(EnvironmentLight, OfNoPictureIsConstant) {
  LightDesc light = environment(nullptr, latlong);
  light.color = {1, 2, 3};
  light.scale = 2;
  EXPECT_EQ(radiance_from(light, {0, 1, 0}), vec3(2, 4, 6));
}

TEST(EnvironmentLight, WhatIsMadeOfAPictureIsKeptThroughEdits) {
  Document document;
  document.scene.lights.push_back(
      environment(picture(kCases[0], [](vec3 d) { return vec3(smooth(d)); }), latlong));
  auto before = RenderScene::build(document);
  std::get<EnvironmentLightModel>(document.scene.lights[0].model).rotation = 1;
  auto after = RenderScene::build(document, before.get());
  auto map_of = [](const RenderScene& s) { return std::get<EnvironmentLight>(s.lights()[0]).map; };
  EXPECT_EQ(map_of(*before), map_of(*after));
  std::get<EnvironmentLightModel>(document.scene.lights[0].model).mapping = angular;
  EXPECT_NE(map_of(*RenderScene::build(document, after.get())), map_of(*after));
}

/// A grey plate that sees nothing but the sky, the sampler's means over its pixels.
RunningStatistics plate(const LightDesc& light, LightSampling how, int spp, std::uint64_t salt) {
  SceneMaker s(16, 16, spp);
  s.rectangle({0, 0, 0}, {0, 0, 50}, {50, 0, 0}, s.diffuse(vec3(0.5f)));
  s.document.scene.lights.push_back(light);
  s.camera({0, 4, 4}, {0, 0, 0}, 20);
  s.document.settings.path.light_sampling = how;
  s.document.settings.path.max_depth = 2;
  s.document.settings.sampler.seed = sampler_seed(salt);
  return over_pixels(render(s.document), 0);
}

TEST(EnvironmentRender, OfOneColourIsTheConstantLightInEveryMapping) {
  std::uint64_t salt = 0;
  for (const MappingCase& m : kCases)
    for (LightSampling how : {LightSampling::nee, LightSampling::mis}) {
      SCOPED_TRACE(m.name);
      auto white = picture(
          m, [](vec3) { return vec3(3); }, vec3(3));
      expect_radiance(plate(environment(white, m.mapping), how, 256, ++salt), 1.5, 0.005, 10);
    }
}

TEST(EnvironmentRender, UnderASunAllStrategiesMeanTheSame) {
  auto sky = [](vec3 d) {
    return vec3(glm::dot(d, glm::normalize(vec3(1, 2, 0.5f))) > 0.95f ? 40.0f : 1.0f);
  };
  LightDesc light = environment(picture(finer(kCases[0], 4), sky), latlong);
  RunningStatistics nee = plate(light, LightSampling::nee, 1024, 201);
  for (LightSampling how : {LightSampling::mis, LightSampling::bsdf})
    EXPECT_GT(z_test(plate(light, how, 1024, 202 + static_cast<std::uint64_t>(how)), nee), sidak_threshold(2))
        << seed_note();
}

TEST(EnvironmentRender, OneBrightTexelIsADirectionalLight) {
  std::uint64_t salt = 100;
  for (MappingCase m : kCases) {
    SCOPED_TRACE(m.name);
    m = finer(m, 8);
    vec3 towards = glm::normalize(vec3(0.3f, 0.8f, -0.4f));
    // The texel that has the direction: the one nearest to it.
    auto panorama = std::make_shared<Panorama>(*picture(
        m, [&](vec3 d) { return vec3(glm::dot(d, towards)); }, vec3(-1)));
    auto brightest = std::ranges::max_element(panorama->image.pixels, {}, [](vec3 p) { return p.x; });
    for (auto p = panorama->image.pixels.begin(); p != panorama->image.pixels.end(); ++p)
      *p = vec3(p == brightest ? 1000.0f : 0.0f);
    // Its irradiance on the plate, by a fine lattice of directions around it.
    EnvironmentMap map(panorama, m.mapping);
    double irradiance = 0;
    Basis frame = Basis::from_normal(towards);
    constexpr int kSteps = 2000;
    constexpr double kHalf = 0.2, kStep = 2 * kHalf / kSteps;
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kSteps; ++i) {
        dvec2 st = dvec2(i + 0.5, j + 0.5) * kStep - kHalf;
        double r2 = 1 + glm::dot(st, st);
        vec3 d = glm::normalize(frame.to_world(vec3(dvec3(st, 1))));
        vec3 l = map.radiance(d);
        irradiance += static_cast<double>(l.x * d.y) * kStep * kStep / (r2 * std::sqrt(r2));
      }
    LightDesc sun;
    sun.model = DirectionalLightModel{-towards};
    sun.color = vec3(static_cast<float>(irradiance / static_cast<double>(towards.y)));
    double exact = plate(sun, LightSampling::mis, 1, 1).mean();
    EXPECT_NEAR(exact, 0.5 * irradiance / kPiD, 1e-3 * exact);
    expect_radiance(plate(environment(panorama, m.mapping), LightSampling::mis, 512, ++salt), exact, 0.01, 5);
  }
}

TEST(EnvironmentRender, LosslessBallsVanishInAWhitePanorama) {
  for (std::string_view type : {"diffuse", "mirror", "dielectric"}) {
    SceneMaker s(16, 16, 1024);
    Material m = material_of_type(type);
    set_if_there(m, "diffuse", vec3(type == "diffuse" ? 1.0f : 0.0f));
    set_if_there(m, "specular", vec3(1));
    s.sphere({0, 0, 0}, 1.2f, s.material(m));
    s.document.scene.lights.push_back(environment(picture(kCases[0], [](vec3) { return vec3(1); }), latlong));
    s.camera({0.5f, 1, 6}, {0, 0, 0}, 15);
    s.document.settings.sampler.seed = sampler_seed(200 + type.size());
    RunningStatistics all = over_pixels(render(s.document), 1);
    EXPECT_NEAR(all.mean(), 1, 2e-3);
    EXPECT_GT(z_test(all, 1, 2e-5), sidak_threshold(3)) << all.mean() << "; " << seed_note();
  }
}

} // namespace
