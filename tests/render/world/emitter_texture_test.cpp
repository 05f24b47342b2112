// Textured emission and opacity.

#include "render/render_testing.h"
#include "render/world/render_scene.h"
#include "support/textures.h"

#include <random>
#include <set>

namespace candela::test {
namespace {

/// Emits what a texture shows, if `textured`.
Material lamp(bool textured) {
  Material m;
  m.model = DiffuseMaterial{vec3(0.3f)};
  m.emission = vec3{2, 4, 8};
  m.opacity = 0.5f;
  m.two_sided_emission = true;
  if (textured) m.emission.use.texture = m.opacity.use.texture = 0;
  return m;
}

/// Every kind of emitter, seen from above.
SceneMaker all_emitters(bool textured, std::shared_ptr<const Texture> texture) {
  SceneMaker s(24, 24, 2);
  s.document.scene.textures.push_back(std::move(texture));
  const int mat = s.material(lamp(textured)), grey = s.diffuse(vec3(0.5f));
  s.rectangle({0, 0, -2}, {5, 0, 0}, {0, 5, 0}, grey);
  s.rectangle({-1.5f, 1.5f, 0}, {0.5f, 0.2f, 0}, {-0.2f, 0.5f, 0.3f}, mat);
  s.rectangle({1.5f, 1.5f, 0}, {0.6f, 0, 0}, {0.3f, 0.6f, 0}, mat); // sheared: two triangles
  s.sphere({-1.5f, -1.5f, 0}, 0.6f, mat);
  s.disc({1.5f, -1.5f, 0}, 0.6f, {0.8f, 0.6f, 0}, {-0.6f, 0.8f, 0}, mat);
  const mat4 squeezed = glm::scale(glm::translate(mat4(1), vec3(0, 0, 0.5f)), {0.3f, 0.5f, 0.2f});
  s.document.scene.instances.push_back({"", SphereShape{1}, squeezed, {mat}});
  Mesh mesh = sphere_mesh(40, 50, false);
  for (vec3 p : mesh.positions) mesh.uvs.emplace_back(0.5f * p.x + 0.1f, 0.5f * p.y + 0.3f * p.z);
  const auto shared = std::make_shared<const Mesh>(std::move(mesh));
  for (float x : {-1.5f, 1.5f})
    s.mesh_shared(shared, mat, glm::scale(glm::translate(mat4(1), {x, 0, 0}), {0.4f * x, 0.5f, 0.3f}));
  s.camera({0, 0, 8}, {0, 0, 0}, 40);
  return s;
}

TEST(EmitterTexture, CoordinatesOfPointsAreThoseOfRays) {
  const SceneMaker s =
      all_emitters(true, picture_texture(2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 99, 200, 128}));
  const auto scene = RenderScene::build(s.document);
  const Geometry& geometry = scene->geometry();
  std::mt19937 random(static_cast<std::mt19937::result_type>(fresh_seed()));
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> unit(-1, 1);
  std::set<std::uint64_t> emitters;
  for (int i = 0; i < 20000; ++i) {
    const vec3 from(4 * unit(random), 4 * unit(random), 6), to(2.2f * unit(random), 2.2f * unit(random), 0);
    const Ray ray{from, 0, glm::normalize(to - from), kInfinity};
    const auto hit = geometry.accel().intersect(ray);
    if (!hit) continue;
    const SurfaceInteraction surface = geometry.surface(ray, *hit);
    const vec2 expected = geometry.uv(ray, *hit);
    vec2 apart = glm::abs(emitter_point(*scene, surface.emitter, surface.position, false).uv - expected);
    apart.x = std::min(apart.x, 1 - apart.x); // around a sphere
    ASSERT_LT(std::max(apart.x, apart.y), 2e-3f) << surface.emitter;
    emitters.insert(surface.emitter);
  }
  EXPECT_GT(emitters.size(), 1000u) << "this test shows nothing";
}

TEST(EmitterTexture, AWhiteTextureChangesNoBit) {
  const auto white = picture_texture(2, 1, std::vector<std::uint8_t>(6, 255));
  for (auto [how, integrator] : {std::pair{LightSampling::bsdf, Integrator::path},
                                 {LightSampling::nee, Integrator::path},
                                 {LightSampling::mis, Integrator::path},
                                 {LightSampling::mis, Integrator::whitted}}) {
    Film films[2] = {Film(1, 1), Film(1, 1)};
    for (bool textured : {false, true}) {
      SceneMaker s = all_emitters(textured, white);
      s.document.settings.path.light_sampling = how;
      s.document.settings.integrator = integrator;
      films[textured] = render(s.document);
    }
    float most = 0;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        ASSERT_EQ(films[0].mean(x, y), films[1].mean(x, y)) << x << ' ' << y;
        most = std::max(most, max_component(films[0].mean(x, y)));
      }
    EXPECT_GT(most, 0.1f);
  }
}

TEST(EmitterTexture, WhatIsSeenIsTheTexture) {
  SceneMaker s(2, 1, 1);
  s.document.scene.textures.push_back(picture_texture(2, 1, {255, 0, 0, 0, 0, 255}));
  Material m;
  m.model = DiffuseMaterial{vec3(0)};
  m.emission = vec3(10);
  m.emission.use.texture = 0;
  m.emission.use.filter = TextureFilter::nearest;
  s.rectangle({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, s.material(m));
  s.document.scene.camera.projection = Projection::orthographic;
  s.document.scene.camera.orthographic_height = 2;
  s.camera({0, 0, 4}, {0, 0, 0}, 40);
  for (Integrator integrator : {Integrator::path, Integrator::whitted, Integrator::direct}) {
    s.document.settings.integrator = integrator;
    const Film film = render(s.document);
    EXPECT_EQ(film.mean(0, 0), vec3(10, 0, 0));
    EXPECT_EQ(film.mean(1, 0), vec3(0, 0, 10));
  }
}

} // namespace
} // namespace candela::test
