// Texture lookups of materials: coordinates and values.

#include "render/world/surface_material.h"
#include "support/textures.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

using test::picture_texture;

struct TextureTransform : ::testing::Test {
  std::vector<std::shared_ptr<const Texture>> textures = {
      picture_texture(2, 1, {255, 0, 0, 0, 255, 0}), // red on the left
      picture_texture(2, 1, {0, 255}, 1)};
  SurfaceMaterials materials;
  BlendArena blends;

  const SurfaceMaterial& added(const Material& material) {
    materials.add(material, textures);
    return materials[0];
  }
  vec3 reflectance(const Material& material, vec2 uv) {
    materials = {};
    return std::get<Diffuse>(evaluate_bsdf(added(material), uv, blends)).reflectance;
  }
};

Material matte(const UvTransform& uv) {
  ColorParameter diffuse = vec3(1);
  diffuse.use.texture = 0;
  diffuse.use.uv = uv;
  return {"", DiffuseMaterial{diffuse}};
}

TEST_F(TextureTransform, ScalesThenTurnsThenMovesUv) {
  const vec3 red(1, 0, 0), green(0, 1, 0);
  EXPECT_EQ(reflectance(matte({}), {0.25f, 0.5f}), red);
  EXPECT_EQ(reflectance(matte({vec2(2), vec2(0)}), {0.375f, 0.5f}), green);
  EXPECT_EQ(reflectance(matte({vec2(2), vec2(0.5f)}), {0.375f, 0.5f}), red);
  // A quarter turn takes (0, 0.375) to (-0.375, 0), which repeats at 0.625.
  EXPECT_NEAR(reflectance(matte({vec2(1), vec2(0), 0.5f * kPi}), {0, 0.25f}).g, 1, 1e-6f);
  EXPECT_NEAR(reflectance(matte({vec2(1, 2), vec2(0.5f, 0), 0.5f * kPi}), {0, 0.125f}).r, 1, 1e-6f);
}

TEST_F(TextureTransform, FactorAndOffsetStayWithinTheRow) {
  Material m = matte({});
  auto& diffuse = std::get<DiffuseMaterial>(m.model).diffuse;
  diffuse.value = {0.5f, 1, 1};
  diffuse.offset = {0.25f, 0, 3};
  EXPECT_EQ(reflectance(m, {0.25f, 0.5f}), vec3(0.75f, 0, 1));
  diffuse.value = vec3(1);
  diffuse.offset = vec3(-0.75f);
  EXPECT_EQ(reflectance(m, {0.25f, 0.5f}), vec3(0.25f, 0, 0));
}

TEST_F(TextureTransform, EveryParameterMayBeATexture) {
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    Material m = default_material(type);
    each_parameter(m, [&](const MaterialField& row, const ParameterRef& parameter) {
      if (parameter.number == &m.opacity || parameter.color == &m.emission) return;
      if (parameter.number == &m.bump || parameter.color == &m.normal_map) return; // no part of the BSDF
      SCOPED_TRACE(std::string(material_type_name(m)) + "." + std::string(row.key));
      Material textured = m, low = m, high = m;
      auto set = [&](Material& to, float factor, int texture) {
        const ParameterRef p = find_parameter(to, row.key);
        if (p.number != nullptr)
          *p.number = factor;
        else
          *p.color = vec3(factor);
        p.use().texture = texture;
      };
      set(textured, 0.5f, 1);
      auto within = [&](double value) {
        return static_cast<float>(std::clamp(value, row.minimum, row.maximum));
      };
      set(low, within(0), -1);
      set(high, within(0.5), -1);
      materials = {};
      const SurfaceMaterial& s = added(textured);
      ASSERT_NE(s.textured, nullptr);
      auto same = [](const Bsdf& a, const Bsdf& b) {
        const vec3 wo = glm::normalize(vec3(0.3f, 0.1f, 0.8f)),
                   wi = glm::normalize(vec3(-0.28f, -0.1f, 0.8f));
        auto through = [&](const Bsdf& x) {
          const auto sample = bsdf_sample(x, wo, {vec2(0.1f), 0.99f});
          return sample ? sample->weight + sample->wi : vec3(0);
        };
        return bsdf_eval(a, wo, wi) == bsdf_eval(b, wo, wi) && bsdf_albedo(a) == bsdf_albedo(b) &&
               through(a) == through(b);
      };
      EXPECT_TRUE(same(evaluate_bsdf(s, vec2(0.25f, 0.5f), blends), make_bsdf(low)));
      EXPECT_TRUE(same(evaluate_bsdf(s, vec2(0.75f, 0.5f), blends), make_bsdf(high)));
    });
  }
}

TEST_F(TextureTransform, OpacityAndEmissionAreLookedUpWhereTheyAreTextured) {
  Material m;
  m.opacity.use.texture = 1;
  m.emission = vec3(8);
  m.emission.use.texture = 0;
  const SurfaceMaterial& s = added(m);
  EXPECT_EQ(s.textured, nullptr) << "its closure is a constant";
  EXPECT_EQ(opacity_at(s, [] { return vec2(0.25f, 0); }), 0);
  EXPECT_EQ(opacity_at(s, [] { return vec2(0.75f, 0); }), 1);
  EXPECT_EQ(emission_at(s, [] { return vec2(0.75f, 0); }), vec3(0, 8, 0));
  Material plain;
  materials = {};
  auto never = []() -> vec2 { throw std::logic_error("asked for a constant"); };
  EXPECT_EQ(opacity_at(added(plain), never), 1);
  EXPECT_EQ(emission_at(materials[0], never), vec3(0));
}

} // namespace
} // namespace candela
