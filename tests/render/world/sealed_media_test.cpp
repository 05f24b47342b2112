#include "render/media_testing.h"
#include "render/world/sealed_media.h"

namespace candela::test {
namespace {

TEST(SealedMedia, AMeshIsClosedIfItsEdgesArePaired) {
  EXPECT_TRUE(hull_of(sphere_mesh(5, 7, false)).closed);
  EXPECT_TRUE(hull_of(sphere_mesh(5, 7, true)).closed) << "vertices at the seam are several";
  Mesh open = sphere_mesh(5, 7, false);
  open.triangles.pop_back();
  EXPECT_FALSE(hull_of(open).closed);
  Mesh inside_out = sphere_mesh(5, 7, false);
  std::swap(inside_out.triangles[3].x, inside_out.triangles[3].y);
  EXPECT_FALSE(hull_of(inside_out).closed);
  EXPECT_FALSE(hull_of(Mesh{}).closed);
  EXPECT_NEAR(hull_of(sphere_mesh(5, 7, false)).bounds.hi.z, 1, 1e-6f);
}

/// A ball of milk in glass, and whether it is sealed after a change of the scene.
bool is_sealed_after(const std::function<void(SceneMaker&)>& change) {
  SceneMaker s(1, 1, 1);
  Material glass;
  glass.model = DielectricMaterial{};
  glass.medium = add_medium(s, vec3(1), vec3(0.5f));
  s.sphere({0, 0, 0}, 1, s.material(glass));
  s.rectangle({0, 3, 0}, {1, 0, 0}, {0, 0, 1}, s.diffuse(vec3(0), vec3(1)));
  s.constant_light(vec3(1));
  change(s);
  const auto scene = RenderScene::build(s.document);
  return scene->is_sealed(scene->material(0).media.inside);
}

TEST(SealedMedia, LightSamplesDoNotReachAClosedBodyOfGlass) {
  EXPECT_TRUE(is_sealed_after([](SceneMaker&) {}));
  auto first = [](SceneMaker& s) -> Material& { return s.document.scene.materials[0]; };
  EXPECT_FALSE(is_sealed_after([&](SceneMaker& s) { first(s).model = NullMaterial{}; }));
  EXPECT_FALSE(is_sealed_after([&](SceneMaker& s) { first(s).opacity = 0.9f; }));
  EXPECT_FALSE(is_sealed_after([&](SceneMaker& s) { s.document.scene.medium = first(s).medium; }));
  EXPECT_FALSE(is_sealed_after([](SceneMaker& s) {
    s.rectangle({0, 0, 9}, {1, 0, 0}, {0, 1, 0}, 0);
  })) << "a second body that has no inside";
  EXPECT_FALSE(is_sealed_after([](SceneMaker& s) {
    LightDesc lamp;
    lamp.model = PointLightModel{.position = {0.5f, 0, 0}};
    s.document.scene.lights.push_back(lamp);
  }));
  EXPECT_FALSE(is_sealed_after([](SceneMaker& s) {
    s.sphere({0, 0.5f, 0}, 0.1f, s.diffuse(vec3(0), vec3(1)));
  }));
  EXPECT_FALSE(is_sealed_after([](SceneMaker& s) {
    s.document.scene.instances[0].motion.translate = {1, 0, 0};
  }));
  EXPECT_TRUE(is_sealed_after([](SceneMaker& s) { s.mesh(sphere_mesh(5, 7, true), 0); }));
  EXPECT_FALSE(is_sealed_after([](SceneMaker& s) {
    Mesh open = sphere_mesh(5, 7, true);
    open.triangles.pop_back();
    s.mesh(open, 0);
  }));
}

} // namespace
} // namespace candela::test
