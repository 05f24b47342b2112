// Where a material looks its texture up.

#include "render/world/render_scene.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

TEST(TextureTransform, ScalesThenMovesUv) {
  Texture texture;
  texture.width = 2, texture.height = 1;
  texture.srgb = {255, 0, 0, 0, 255, 0}; // red on the left
  SurfaceMaterial material;
  material.bsdf = Diffuse{vec3(1)};
  material.diffuse_texture = &texture;
  auto color = [&](vec2 uv) { return std::get<Diffuse>(evaluate_bsdf(material, uv)).reflectance; };
  const vec3 red(1, 0, 0), green(0, 1, 0);
  EXPECT_EQ(color({0.25f, 0.5f}), red);
  material.diffuse_uv = {vec2(2), vec2(0)};
  EXPECT_EQ(color({0.375f, 0.5f}), green);
  material.diffuse_uv = {vec2(2), vec2(0.5f)};
  EXPECT_EQ(color({0.375f, 0.5f}), red);
}

} // namespace
} // namespace candela
