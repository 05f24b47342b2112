#include "versus_cycles/scenes.h"

#include "core/hash.h"
#include "support/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace candela::versus {

namespace {

/// Smooth noise in [-1, 1]: random values on the integer lattice, blended by quintics.
float value_noise(vec3 p) {
  vec3 base = glm::floor(p), t = p - base;
  vec3 w = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
  float sum = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    std::uint64_t h = 0;
    float weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      auto bit = static_cast<int>(corner >> axis & 1);
      h = hash_combine(h, static_cast<std::uint32_t>(static_cast<int>(base[axis]) + bit));
      weight *= bit == 1 ? w[axis] : 1 - w[axis];
    }
    sum += weight * (2 * to_unit_float(static_cast<std::uint32_t>(h >> 32)) - 1);
  }
  return sum;
}

/// The icosahedron, each triangle split into four `level` times, on the unit sphere.
Mesh icosphere(int level) {
  const float g = (1 + std::sqrt(5.0f)) / 2; // the golden ratio
  Mesh mesh;
  mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (vec3& p : mesh.positions) p = glm::normalize(p);
  for (int i = 0; i < level; ++i) {
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    middles.reserve(mesh.triangles.size() * 3 / 2);
    auto middle = [&](std::uint32_t a, std::uint32_t b) {
      auto key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
      auto [entry, is_new] = middles.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    std::vector<uvec3> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (uvec3 t : mesh.triangles) {
      uvec3 m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
      finer.insert(finer.end(), {uvec3(t.x, m.x, m.z), uvec3(t.y, m.y, m.x), uvec3(t.z, m.z, m.y), m});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// A blue gradient over brown ground, and a sun 40 degrees high that gives four times the sky's irradiance.
Image sky_with_sun() {
  constexpr int kWidth = 2048, kHeight = 1024, kSubpixels = 16; // the sun is three pixels wide
  const float radius = radians(0.53f / 2), cos_radius = std::cos(radius);
  const vec3 sun = glm::normalize(vec3(0.62f, 0.84f, 0.42f));
  const vec3 sun_radiance = vec3(3.5f, 3.15f, 2.6f) / (2 * kPi * (1 - cos_radius));
  // The inverse of lights/environment_map.h: u = atan2(x, -z) / 2 pi, v = acos(y) / pi.
  auto direction = [](float x, float y) {
    float phi = 2 * kPi * x / kWidth, theta = kPi * y / kHeight;
    return vec3(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
  };
  Image image{kWidth, kHeight, {}};
  image.pixels.reserve(static_cast<std::size_t>(kWidth) * kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      vec3 d = direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      vec3 c = d.y > 0
                   ? glm::mix(vec3(0.32f, 0.36f, 0.4f), vec3(0.1f, 0.18f, 0.36f), std::sqrt(d.y))
                   : glm::mix(vec3(0.32f, 0.36f, 0.4f), vec3(0.1f, 0.08f, 0.06f), std::min(-8 * d.y, 1.0f));
      if (glm::dot(d, sun) > std::cos(radius + radians(0.5f))) {
        int hits = 0;
        for (int i = 0; i < kSubpixels * kSubpixels; ++i) {
          float dx = (static_cast<float>(i % kSubpixels) + 0.5f) / kSubpixels,
                dy = (static_cast<float>(i / kSubpixels) + 0.5f) / kSubpixels;
          if (glm::dot(direction(static_cast<float>(x) + dx, static_cast<float>(y) + dy), sun) > cos_radius)
            ++hits;
        }
        c += sun_radiance * (static_cast<float>(hits) / (kSubpixels * kSubpixels));
      }
      image.pixels.push_back(c);
    }
  return image;
}

} // namespace

VersusScene cornell_box(int size) {
  return {"Cornell box", "diffuse, one lamp", test::cornell_flush(size, size, 1, true).document, 64};
}

VersusScene bumpy_ball(int size, int level) {
  test::SceneMaker s(size, size, 1);
  Mesh mesh = icosphere(level);
  for (vec3& p : mesh.positions) {
    float height = 0, amplitude = 0.2f, frequency = 2;
    for (int octave = 0; octave < 7; ++octave, amplitude *= 0.47f, frequency *= 2.03f)
      height += amplitude * value_noise(frequency * p + 17.0f);
    p *= 1 + height;
  }
  std::string description = fmt::format("{} triangles, sky and sun", mesh.triangles.size());
  s.mesh(std::move(mesh), s.diffuse(vec3(0.6f)));
  auto panorama = std::make_shared<Panorama>();
  panorama->image = sky_with_sun();
  LightDesc sky;
  sky.model = EnvironmentLightModel{.panorama = std::move(panorama)};
  s.document.scene.lights.push_back(std::move(sky));
  s.camera({0, 0.5f, 4}, {0, 0.03f, 0}, 38);
  return {"Bumpy ball", std::move(description), std::move(s.document), 32};
}

VersusScene veach_plates(int size) {
  test::SceneMaker s(size, size, 1);
  const vec3 eye(0, 2.6f, 15), lamps(0, 3.8f, 1);
  s.camera(eye, {0, -0.9f, 0.3f}, 26);
  int stage = s.diffuse(vec3(0.4f));
  s.rectangle({0, -2.75f, 0}, {0, 0, 40}, {40, 0, 0}, stage);
  s.rectangle({0, 0, -3}, {40, 0, 0}, {0, 20, 0}, stage);
  struct Plate {
    float alpha, height, y, z;
  };
  for (Plate p : std::array<Plate, 4>{{{0.01f, 0.42f, -0.6f, 0.1f},
                                       {0.05f, 0.44f, -1.2f, 1},
                                       {0.1f, 0.48f, -1.7f, 2.05f},
                                       {0.2f, 0.54f, -2.1f, 3.3f}}}) {
    Material m;
    m.model = GgxMaterial{vec3(1), std::sqrt(p.alpha)};
    vec3 center(0, p.y, p.z); // turned to mirror the row of lamps into the camera
    vec3 normal = glm::normalize(glm::normalize(eye - center) + glm::normalize(lamps - center));
    s.rectangle(center, {2.6f, 0, 0}, p.height * glm::cross(normal, vec3(1, 0, 0)), s.material(m));
  }
  struct Lamp {
    float x, radius;
    vec3 color;
  };
  for (Lamp l : std::array<Lamp, 4>{{{-2.1f, 0.02f, {1, 0.7f, 0.55f}},
                                     {-0.8f, 0.06f, {0.95f, 1, 0.6f}},
                                     {0.6f, 0.15f, {0.6f, 0.9f, 1}},
                                     {2.1f, 0.35f, {0.9f, 0.65f, 1}}}})
    s.sphere(lamps + vec3(l.x, 0, 0), l.radius, s.diffuse(vec3(0), l.color * (2.0f / sqr(l.radius))));
  return {"Veach's plates", "GGX metal, four lamps", std::move(s.document), 64};
}

VersusScene rough_glass(int size) {
  test::SceneMaker s = test::cornell_flush(size, size, 1, false);
  Material m;
  m.model = RoughDielectricMaterial{.roughness = 0.3f, .energy_compensation = false};
  s.mesh(icosphere(6), s.material(m), glm::scale(glm::translate(mat4(1), vec3(278, 150, 260)), vec3(140)));
  return {"Rough glass", "a ball of GGX glass in the Cornell box", std::move(s.document), 64, 0.015, 0.1};
}

VersusScene principled_balls(int size) {
  test::SceneMaker s = test::cornell_flush(size, size, 1, false);
  Material metal, plastic;
  metal.model =
      PrincipledMaterial{.base_color = vec3(0.95f, 0.7f, 0.35f), .roughness = 0.35f, .metallic = 1.0f};
  plastic.model = PrincipledMaterial{.base_color = vec3(0.15f, 0.3f, 0.6f), .roughness = 0.3f};
  auto ball = [&](vec3 center, const Material& m) {
    s.mesh(icosphere(6), s.material(m), glm::scale(glm::translate(mat4(1), center), vec3(110)));
  };
  ball({400, 111, 330}, metal);
  ball({160, 111, 200}, plastic);
  return {"Principled", "metal and plastic in the Cornell box", std::move(s.document), 64};
}

namespace {

/// [-half, half]^3.
Mesh box_of(float half) {
  Mesh box;
  for (int corner = 0; corner < 8; ++corner)
    box.positions.push_back(
        half * vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1));
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

} // namespace

VersusScene foggy_spot(int size) {
  test::SceneMaker s(size, size, 1);
  const int wall = s.diffuse(vec3(0.5f)), black = s.diffuse(vec3(0));
  s.rectangle({0, -1, 0}, {0, 0, 1}, {1, 0, 0}, wall);
  s.rectangle({0, 0, -1}, {1, 0, 0}, {0, 1, 0}, s.diffuse({0.6f, 0.3f, 0.2f}));
  // The shade: a cone from above the lamp down to its rim.
  Mesh shade;
  constexpr std::uint32_t kSides = 32;
  shade.positions.emplace_back(0, 0.8f, 0);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const float phi = 2 * kPi * static_cast<float>(i) / kSides;
    shade.positions.emplace_back(0.14f * std::cos(phi), 0.5f, 0.14f * std::sin(phi));
    shade.triangles.emplace_back(0, i + 1, (i + 1) % kSides + 1);
  }
  s.mesh(std::move(shade), black);
  s.sphere({0, 0.7f, 0}, 0.02f, s.diffuse(vec3(0), vec3(1200)));
  MediumDesc fog;
  fog.name = "fog";
  fog.model = HomogeneousMediumModel{vec3(0.5f), vec3(0.9f)};
  fog.phase.model = HenyeyGreensteinPhase{0.4f};
  s.document.scene.media.push_back(fog);
  Material air;
  air.model = NullMaterial{};
  air.medium = fog.name;
  s.mesh(box_of(0.999f), s.material(air));
  s.camera({0.6f, 0.2f, 4}, {0, -0.1f, 0}, 38);
  return {"Fog", "a cone of light in a box of fog", std::move(s.document), 64, 0.02, 0.15};
}

float smoke_density(vec3 p) {
  const float wave = 0.3f + std::sin(9 * p.x + 4 * p.y) * std::cos(8 * p.z - 3 * p.x);
  return std::max(1 - glm::dot(p, p), 0.0f) * std::max(wave, 0.0f);
}

VersusScene smoke_ball(int size) {
  test::SceneMaker s(size, size, 1);
  s.rectangle({0, -1.05f, 0}, {0, 0, 3}, {3, 0, 0}, s.diffuse(vec3(0.5f)));
  s.rectangle({0, 0, -2}, {3, 0, 0}, {0, 3, 0}, s.diffuse({0.6f, 0.3f, 0.2f}));
  s.rectangle({0.8f, 2.2f, 1}, {0.4f, 0, 0}, {0, 0, 0.4f}, s.diffuse(vec3(0), vec3(40)));
  auto grid = std::make_shared<VolumeGrid>();
  constexpr int kCells = 128;
  grid->cells = glm::ivec3(kCells);
  grid->bounds.lo = vec3(-1), grid->bounds.hi = vec3(1);
  for (int z = 0; z < kCells; ++z)
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x)
        grid->density.push_back(smoke_density((vec3(x, y, z) + 0.5f) * (2.0f / kCells) - 1.0f));
  MediumDesc smoke;
  smoke.name = "smoke";
  GridMediumModel model;
  model.sigma_t = vec3(8), model.albedo = vec3(0.8f);
  model.grid = std::move(grid);
  smoke.model = model;
  smoke.phase.model = HenyeyGreensteinPhase{0.3f};
  s.document.scene.media.push_back(smoke);
  Material air;
  air.model = NullMaterial{};
  air.medium = smoke.name;
  s.mesh(box_of(1), s.material(air));
  s.camera({0.6f, 0.5f, 5}, {0, -0.1f, 0}, 34);
  return {"Smoke", "a ball of smoke, 128^3 cells", std::move(s.document), 64, 0.02, 0.15};
}

VersusScene furry_ball(int size, int strands) {
  test::SceneMaker s(size, size, 1);
  constexpr std::uint32_t kPoints = 8; // 5 segments
  auto hair = std::make_shared<Strands>();
  hair->widths = {0.012f, 0.004f};
  for (int i = 0; i < strands; ++i) {
    // Roots in a spiral of equal areas; strands bend down and sideways as they grow.
    const float z = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(strands);
    const float r = std::sqrt(1 - z * z), phi = 2.39996323f * static_cast<float>(i);
    const vec3 root(r * std::cos(phi), z, r * std::sin(phi));
    const std::uint64_t h = hash_combine(7, static_cast<std::uint64_t>(i));
    const vec3 bend(to_unit_float(static_cast<std::uint32_t>(h)) - 0.5f, -0.7f,
                    to_unit_float(static_cast<std::uint32_t>(h >> 32)) - 0.5f);
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      const float t = (static_cast<float>(k) - 1) / (kPoints - 3); // [0, 1] between the ends
      hair->points.push_back(root * (1 + 0.45f * t) + bend * (0.35f * t * t));
    }
    hair->counts.push_back(kPoints);
  }
  Material m;
  m.model = HairMaterial{.parametrization = static_cast<int>(HairAbsorption::absorption),
                         .sigma_a = vec3(0.25f, 0.45f, 0.9f)};
  s.document.scene.instances.push_back({"", CurvesShape{std::move(hair)}, mat4(1), {s.material(m)}});
  s.mesh(icosphere(5), s.diffuse(vec3(0.1f)), glm::scale(mat4(1), vec3(0.99f)));
  auto panorama = std::make_shared<Panorama>();
  panorama->image = sky_with_sun();
  LightDesc sky;
  sky.model = EnvironmentLightModel{.panorama = std::move(panorama)};
  s.document.scene.lights.push_back(std::move(sky));
  s.camera({0, 0.5f, 6}, {0, -0.05f, 0}, 32);
  return {"Hair", fmt::format("{} strands, sky and sun", strands), std::move(s.document), 32, 0.03, 0.35};
}

} // namespace candela::versus
