// Picking: the surface under a pixel.

#include "render/camera/picking.h"
#include "render/render_testing.h"
#include "render/world/render_scene.h"

namespace candela::test {
namespace {

TEST(Picking, FindsInstanceMaterialAndDepth) {
  SceneMaker s(100, 50, 1);
  int a = s.diffuse(vec3(1)), b = s.diffuse(vec3(1));
  auto mesh = std::make_shared<const Mesh>(sphere_mesh(40, 60, false));
  s.rectangle({0, 0, -5}, {50, 0, 0}, {0, 50, 0}, a);
  s.mesh_shared(mesh, b, glm::translate(mat4(1), {-2, 0, 0}));
  s.mesh_shared(mesh, b, glm::translate(mat4(1), {2, 0, 0}));
  s.sphere({0, 0, 0}, 0.5f, b);
  s.camera({0, 0, 10}, {0, 0, 0}, 30);
  s.document.scene.camera.aperture_radius = 3; // a hand picks through the middle of the lens
  auto scene = RenderScene::build(s.document);
  auto at = [&](vec3 p) { // film position of a point, by the definition of the field of view
    float scale = 25 / std::tan(radians(15.0f)) / (10 - p.z);
    return vec2(50 + p.x * scale, 25 - p.y * scale);
  };
  auto p = pick(*scene, s.document, at({0, 0, 0}));
  ASSERT_TRUE(p);
  EXPECT_EQ(p->instance, 3);
  EXPECT_EQ(p->material, b);
  EXPECT_NEAR(p->view_depth, 9.5f, 1e-4f);
  EXPECT_EQ(pick(*scene, s.document, at({-2, 0, 0}))->instance, 1);
  EXPECT_EQ(pick(*scene, s.document, at({2, 0.1f, 0}))->instance, 2);
  p = pick(*scene, s.document, at({-5, 3, -5}));
  EXPECT_EQ(p->instance, 0);
  EXPECT_NEAR(p->view_depth, 15, 1e-4f); // along the axis, not along the ray
  EXPECT_NEAR(glm::length(p->position - vec3(-5, 3, -5)), 0, 1e-3f);
  s.document.scene.camera.target = {0, 0, 20};
  EXPECT_FALSE(pick(*scene, s.document, {50, 25}));
}

TEST(Picking, AnOrthographicPickFindsWhatTheRayMeets) {
  SceneMaker s(40, 40, 1);
  const int mat = s.diffuse(vec3(0.5f));
  s.sphere({1.5f, 1.5f, 0}, 0.25f, mat);
  s.camera({0, 0, 10}, {0, 0, 0}, 45);
  Camera& camera = s.document.scene.camera;
  camera.projection = Projection::orthographic;
  camera.orthographic_height = 4;
  const auto scene = RenderScene::build(s.document);
  const auto hit = pick(*scene, s.document, {35, 5}); // 10 pixels a unit: (1.5, 1.5)
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->view_depth, 9.75f, 1e-4f);
  EXPECT_NEAR(hit->distance, 9.75f, 1e-4f);
  EXPECT_LT(glm::length(hit->geometric_normal - vec3(0, 0, 1)), 1e-2f);
  EXPECT_FALSE(pick(*scene, s.document, {20, 20}));
}

} // namespace
} // namespace candela::test
