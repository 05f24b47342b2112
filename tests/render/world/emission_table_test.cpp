// What emitters with textures are chosen and sampled by.

#include "render/render_testing.h"
#include "render/world/render_scene.h"
#include "support/textures.h"

#include <random>

namespace candela::test {
namespace {

Material picture_lamp(TextureFilter filter) {
  Material m;
  m.model = DiffuseMaterial{vec3(0)};
  m.emission = vec3(4);
  m.emission.use.texture = 0;
  m.emission.use.filter = filter;
  m.two_sided_emission = true;
  return m;
}

/// The lamp over a floor.
SceneMaker scene_of(std::shared_ptr<const Texture> texture, const Material& material, const mat4& place) {
  SceneMaker s(8, 8, 1);
  s.document.scene.textures.push_back(std::move(texture));
  s.rectangle({0, 0, -2}, {5, 0, 0}, {0, 5, 0}, s.diffuse(vec3(0.5f)));
  s.document.scene.instances.push_back({"", RectangleShape{}, place, {s.material(material)}});
  s.camera({0, 0, 8}, {0, 0, 0}, 40);
  return s;
}
const RectangleLight& lamp_of(const RenderScene& scene) {
  return std::get<RectangleLight>(scene.lights().at(0));
}
float luminance_at(const RenderScene& scene, vec2 place) {
  const RectangleLight& light = lamp_of(scene);
  return luminance(scene.emitter_texture(0)->radiance(
      scene, light.at(place.x * light.length_x, place.y * light.length_y)));
}

TEST(EmissionTable, FollowsTheMaterialWhereverItsRectangleLies) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(fresh_seed()));
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> unit(0, 1);
  const auto texture = picture_texture(
      4, 2, {255, 255, 255, 0, 0, 0, 60, 0, 0, 0, 90, 30, 0, 0, 0, 200, 220, 0, 0, 0, 255, 128, 128, 128});
  Material plain = picture_lamp(TextureFilter::nearest), changed = plain;
  changed.emission.value = {2, 8, 1};
  changed.emission.offset = {-1, -0.5f, 0}; // some of it is clamped to black
  changed.emission.use.wrap = TextureWrap::mirror;
  changed.emission.use.channel = TextureChannel::green;
  changed.emission.use.uv = {{-1, 2}, {0.25f, 1.5f}, kPi};
  changed.opacity.use.texture = 0;
  changed.opacity.use.filter = TextureFilter::nearest;
  for (const Material& material : {plain, changed})
    for (bool mirrored : {false, true}) {
      mat4 place = glm::rotate(glm::translate(mat4(1), {1, 0.5f, 0.2f}), 1.1f, vec3(1, 2, 3));
      if (mirrored) place = glm::scale(place, vec3(2, -1, 1));
      const auto scene = RenderScene::build(scene_of(texture, material, place).document);
      const EmissionGrid* grid = lamp_of(*scene).picture;
      ASSERT_NE(grid, nullptr);
      const float mean = luminance(lamp_of(*scene).emission);
      int bright = 0;
      for (int i = 0; i < 1000; ++i) {
        const vec2 at(unit(random), unit(random)), edges = glm::abs(8.0f * at - glm::round(8.0f * at));
        if (std::min(edges.x, edges.y) < 1e-3f) continue; // between texels
        const float expected = luminance_at(*scene, at) / mean;
        ASSERT_NEAR(grid->pdf(at), expected, 1e-3f * expected + 1e-6f) << at.x << ' ' << at.y;
        bright += expected > 0;
      }
      EXPECT_TRUE(bright > 50 && bright < 950) << bright;
    }
}

TEST(EmissionTable, SamplesOfAMostlyBlackPictureShine) {
  std::vector<std::uint8_t> values(64 * 64, 0);
  for (std::size_t i : {70u, 1000u, 1001u, 4000u}) values[i] = 255;
  const auto scene = RenderScene::build(
      scene_of(picture_texture(64, 64, values, 1), picture_lamp(TextureFilter::bilinear), mat4(1)).document);
  RectangleLight light = lamp_of(*scene), even = light;
  even.picture = nullptr;
  const LightSamplingContext ctx{{0.3f, 1, -2}, {0, 0, 1}};
  auto shining = [&](const RectangleLight& l) {
    int count = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const auto s = l.sample(ctx, (vec2(x, y) + 0.5f) / 64.0f);
        count += s && !is_black(scene->emitter_texture(0)->radiance(*scene, s->point));
      }
    return count;
  };
  EXPECT_GT(shining(light), 64 * 64 * 3 / 4);
  EXPECT_LT(shining(even), 64 * 64 / 100);
}

TEST(EmissionTable, EvenOnesAreSampledInSolidAngle) {
  for (std::uint8_t low : {255, 220}) {
    const auto scene = RenderScene::build(
        scene_of(picture_texture(2, 1, {255, low}, 1), picture_lamp(TextureFilter::bilinear), mat4(1))
            .document);
    EXPECT_EQ(lamp_of(*scene).picture, nullptr);
  }
}

TEST(EmissionTable, IsKeptWhereTheLampOnlyMoves) {
  SceneMaker s = scene_of(picture_texture(2, 1, {255, 0}, 1), picture_lamp(TextureFilter::bilinear), mat4(1));
  const auto scene = RenderScene::build(s.document);
  ASSERT_NE(lamp_of(*scene).picture, nullptr);
  Document moved = s.document;
  moved.scene.instances[1].world_from_object[3].x += 1;
  EXPECT_EQ(lamp_of(*RenderScene::build(moved, scene.get())).picture, lamp_of(*scene).picture);
  Document brighter = s.document;
  brighter.scene.materials[1].emission.offset = vec3(1);
  const auto after = RenderScene::build(brighter, scene.get());
  EXPECT_NE(lamp_of(*after).picture, lamp_of(*scene).picture);
  EXPECT_GT(lamp_of(*after).emission.x, lamp_of(*scene).emission.x + 0.9f);
  Document mirrored = s.document;
  mirrored.scene.instances[1].world_from_object[0] *= -1.0f;
  EXPECT_NE(lamp_of(*RenderScene::build(mirrored, scene.get())).picture, lamp_of(*scene).picture);
}

TEST(EmissionTable, TrianglesAreAsBrightAsTheirOwnPartOfThePicture) {
  SceneMaker s(8, 8, 1);
  s.document.scene.textures.push_back(picture_texture(2, 2, {255, 0, 128, 0}, 1)); // black on the right
  Material lamp = picture_lamp(TextureFilter::nearest);
  lamp.emission.use.color_space = ColorSpace::linear;
  Mesh mesh;
  // In the white texel, in the black ones, and in both of the left ones: 7/16 of it in the lower one.
  const vec2 uvs[3][3] = {{{0.1f, 0.6f}, {0.4f, 0.6f}, {0.1f, 0.9f}},
                          {{0.6f, 0.1f}, {0.9f, 0.1f}, {0.6f, 0.9f}},
                          {{0.1f, 0.35f}, {0.4f, 0.35f}, {0.1f, 0.95f}}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto base = 3 * i;
    const float x = 2 * static_cast<float>(i);
    for (vec2 p : {vec2(0, 0), vec2(1, 0), vec2(0, 1)}) mesh.positions.emplace_back(x + p.x, p.y, 0);
    mesh.uvs.insert(mesh.uvs.end(), std::begin(uvs[i]), std::end(uvs[i]));
    mesh.triangles.emplace_back(base, base + 1, base + 2);
  }
  const int material = s.material(lamp);
  const auto shared = std::make_shared<const Mesh>(mesh);
  for (bool instanced : {false, true}) {
    Document d = s.document;
    if (instanced) { // twice: a mesh with a tree of its own
      SceneMaker two = s;
      two.mesh_shared(shared, material, mat4(1));
      two.mesh_shared(shared, material, glm::translate(mat4(1), {0, 3, 0}));
      d = two.document;
    } else {
      SceneMaker one = s;
      one.mesh(Mesh(mesh), material);
      d = one.document;
    }
    const auto scene = RenderScene::build(d);
    ASSERT_EQ(scene->lights().size(), instanced ? 6u : 3u);
    auto emission = [&](std::size_t i) { return std::get<TriangleLight>(scene->lights()[i]).emission.x; };
    EXPECT_NEAR(emission(0), 4, 1e-5f);
    EXPECT_NEAR(emission(1), 1e-3f, 1e-6f) << "never 0, for lookups may miss something";
    EXPECT_NEAR(emission(2), 4 * (9 + 7 * 128 / 255.0f) / 16, 0.15f) << "of four lookups two are in each";
  }
}

TEST(EmissionTable, SpheresAndDiscsAreAsBrightAsTheirArea) {
  SceneMaker s(8, 8, 1);
  s.document.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"", CheckerTexture{vec3(1), vec3(0), 2}}));
  // The northern half of v, a quarter of which is as far as 60 degrees from the pole: half of the hemisphere.
  std::vector<std::uint8_t> cap(6, 0);
  cap[0] = cap[1] = 255;
  s.document.scene.textures.push_back(picture_texture(1, 6, cap, 1));
  Material lamp = picture_lamp(TextureFilter::nearest);
  lamp.emission.use.texture = 1;
  s.sphere({0, 0, 0}, 1, s.material(lamp));
  lamp.emission.use.texture = 0;
  s.disc({3, 0, 0}, 1, {1, 0, 0}, {0, 1, 0}, s.material(lamp));
  const auto scene = RenderScene::build(s.document);
  ASSERT_EQ(scene->lights().size(), 2u);
  EXPECT_NEAR(std::get<SphereLight>(scene->lights()[0]).emission.x, 4 * 0.25f, 1e-5f);
  EXPECT_NEAR(std::get<DiscLight>(scene->lights()[1]).emission.x, 4 * 0.5f, 0.1f);
}

/// Whatever turns or mirrors them; but near the edges of texels, which cells of the table lie across.
TEST(EmissionTable, FollowsTheMaterialOnDiscsAndSpheres) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(fresh_seed()));
  SCOPED_TRACE(seed_note());
  std::uniform_real_distribution<float> unit(0, 1);
  const auto texture = picture_texture(2, 2, {255, 60, 0, 130}, 1);
  for (bool mirrored : {false, true}) {
    mat4 place = glm::rotate(glm::translate(mat4(1), {1, 0.5f, 0.2f}), 1.1f, vec3(1, 2, 3));
    if (mirrored) place = glm::scale(place, vec3(-1, 1, 1));
    for (const Shape& shape : {Shape(DiscShape{}), Shape(SphereShape{})}) {
      SceneMaker s(8, 8, 1);
      s.document.scene.textures.push_back(texture);
      s.document.scene.instances.push_back(
          {"", shape, place, {s.material(picture_lamp(TextureFilter::nearest))}});
      const auto scene = RenderScene::build(s.document);
      const auto* disc = std::get_if<DiscLight>(&scene->lights().at(0));
      const auto* sphere = std::get_if<SphereLight>(&scene->lights().at(0));
      const EmissionGrid* grid = disc != nullptr ? disc->picture : sphere->picture;
      ASSERT_NE(grid, nullptr);
      const float mean = luminance(disc != nullptr ? disc->emission : sphere->emission);
      int compared = 0;
      for (int i = 0; i < 2000; ++i) {
        const vec2 q(unit(random), unit(random));
        vec3 point;
        if (disc != nullptr) {
          const vec2 d = disc->radius * DiscLight::from_polar(q);
          point = disc->center + d.x * disc->axis_x + d.y * disc->axis_y;
        } else {
          point = sphere->center + sphere->radius * (SphereLight::from_square(q) * sphere->local_from_world);
        }
        const vec3 local = glm::inverse(mat3(place)) * (point - vec3(place[3]));
        const float from_edge = disc != nullptr ? std::min(std::abs(local.x), std::abs(local.y))
                                                : std::min(std::abs(local.y), std::abs(local.z));
        if (from_edge < 0.2f) continue;
        ++compared;
        const float expected = luminance(scene->emitter_texture(0)->radiance(*scene, point)) / mean;
        ASSERT_NEAR(grid->pdf(q), expected, 1e-3f * expected + 1e-6f) << local.x << ' ' << local.y;
      }
      EXPECT_GT(compared, 500);
    }
  }
}

} // namespace
} // namespace candela::test
