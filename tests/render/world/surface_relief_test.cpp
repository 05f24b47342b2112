// Normal maps, bump maps and the orientation of anisotropic closures, in pictures of one pixel.

#include "render/denoise/feature_film.h"
#include "render/render_testing.h"
#include "support/textures.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

constexpr Integrator kIntegrators[] = {Integrator::path, Integrator::whitted};

/// Looks at the middle of a rectangle of half sides x and y from `eye`, lit by a point light.
Document pixel_scene(Material m, vec3 x, vec3 y, vec3 eye, vec3 light,
                     std::shared_ptr<const Texture> texture = {}) {
  SceneMaker s(1, 1, 4);
  if (texture) s.document.scene.textures.push_back(std::move(texture));
  s.rectangle(vec3(0), x, y, s.material(std::move(m)));
  LightDesc lamp;
  PointLightModel point;
  point.position = light;
  lamp.model = point;
  s.document.scene.lights.push_back(lamp);
  s.camera(eye, vec3(0), 0.01f, std::abs(glm::normalize(eye).y) > 0.9f ? vec3(0, 0, 1) : vec3(0, 1, 0));
  s.document.settings.path.max_depth = 2;
  return s.document;
}

float pixel(Document d, Integrator integrator) {
  d.settings.integrator = integrator;
  return render(d).mean(0, 0).x;
}

TEST(SurfaceRelief, AnisotropicHighlightsFollowTheTextureCoordinates) {
  ConductorMaterial brushed;
  brushed.roughness = 0.6f, brushed.anisotropy = 0.8f;
  Material m;
  m.model = brushed;
  const vec3 eye(0.4f, 3, 0.8f), light(1.1f, 2, -0.5f);
  for (const float angle : {0.0f, 0.5f, 1.9f, -2.4f}) {
    // The surface turned about its normal, +y.
    const vec3 x(std::cos(angle), 0, std::sin(angle)), y = glm::cross(vec3(0, 1, 0), x);
    const Document d = pixel_scene(m, x, y, eye, light);
    const Conductor closure = brushed.closure([](const auto& parameter) { return parameter.value; }).closure;
    auto local = [&](vec3 w) {
      w = glm::normalize(w);
      return vec3(glm::dot(w, x), glm::dot(w, y), w.y);
    };
    const float expected = closure.eval(local(eye), local(light)).x / length_squared(light);
    for (const Integrator integrator : kIntegrators)
      EXPECT_NEAR(pixel(d, integrator), expected, 2e-3f * expected) << angle;
  }
}

/// Of a matte surface with that normal; +y is the geometric one.
float lit(vec3 normal, vec3 light) {
  return std::max(glm::dot(normal, glm::normalize(light)), 0.0f) * kInvPi / length_squared(light);
}

TEST(SurfaceRelief, BumpsAreTiltedPlanes) {
  // A height that grows along u by 0.3 from edge to edge, which lie 4 apart.
  GradientTexture ramp;
  ramp.color_a = vec3(0), ramp.color_b = vec3(1);
  Material m;
  m.model = DiffuseMaterial{vec3(1)};
  m.bump = 0.3f;
  m.bump.use.texture = 0;
  const vec3 light(0.7f, 2, 0.4f), x(2, 0, 0), z(0, 0, 2);
  const Document d =
      pixel_scene(m, x, -z, {0.1f, 3, 0.2f}, light, std::make_shared<const Texture>(Texture{"", ramp}));
  const float expected = lit(glm::normalize(vec3(-0.3f / 4, 1, 0)), light);
  ASSERT_GT(std::abs(expected / lit(vec3(0, 1, 0), light) - 1), 0.01f);
  for (const Integrator integrator : kIntegrators)
    EXPECT_NEAR(pixel(d, integrator), expected, 1e-3f * expected);
}

TEST(SurfaceRelief, NormalMapsTilt) {
  // Red 191: x = 0.498; green 89: y = -0.302; blue so that it is a unit vector.
  const std::uint8_t rgb[] = {191, 89, 231};
  vec3 n(rgb[0], rgb[1], rgb[2]);
  n = glm::normalize(2.0f * n / 255.0f - 1.0f);
  Material m;
  m.model = DiffuseMaterial{vec3(1)};
  m.normal_map.value = vec3(1);
  m.normal_map.use.texture = 0;
  const vec3 light(0.7f, 2, 0.4f), x(2, 0, 0), y(0, 0, -2); // x cross y: +y
  const Document d =
      pixel_scene(m, x, y, {0.1f, 3, 0.2f}, light, picture_texture(1, 1, {rgb[0], rgb[1], rgb[2]}));
  const vec3 tilted = n.x * vec3(1, 0, 0) + n.y * vec3(0, 0, -1) + n.z * vec3(0, 1, 0);
  const float expected = lit(tilted, light);
  for (const Integrator integrator : kIntegrators)
    EXPECT_NEAR(pixel(d, integrator), expected, 2e-3f * expected);

  Document seen = d;
  seen.settings.view = View::normal;
  EXPECT_LT(glm::distance(render(seen).mean(0, 0), 0.5f * tilted + 0.5f), 1e-3f);
  FeatureFilm features(1, 1); // what denoisers are told
  const std::atomic<bool> stop{false};
  ASSERT_TRUE(render_features(*RenderScene::build(d), d, 4, features, stop));
  NoisyImage albedo, normal, position;
  features.resolve(albedo, normal, position);
  EXPECT_LT(glm::distance(normal.half[0].pixels.at(0), tilted), 1e-3f);
}

TEST(SurfaceRelief, AFlatMapChangesNothing) {
  Material plain;
  plain.model = DiffuseMaterial{vec3(0.5f)};
  Material mapped = plain;
  mapped.normal_map.value = vec3(1);
  mapped.normal_map.use.texture = 0;
  const vec3 light(0.7f, 2, 0.4f), x(2, 0, 0), y(0, 0, -2);
  auto flat = std::make_shared<const Texture>(
      Texture{"", CheckerTexture{vec3(0.5f, 0.5f, 1), vec3(0.5f, 0.5f, 1), 2}});
  EXPECT_NEAR(pixel(pixel_scene(mapped, x, y, {0.1f, 3, 0.2f}, light, flat), Integrator::path),
              pixel(pixel_scene(plain, x, y, {0.1f, 3, 0.2f}, light), Integrator::path), 1e-6f);
}

} // namespace
} // namespace candela::test
