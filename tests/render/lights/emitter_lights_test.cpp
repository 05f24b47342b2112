#include "render/lights/emitter_lights.h"
#include "render/world/render_scene.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

TEST(EmitterLights, KnowsWhatWasSetAndNothingElse) {
  EmitterLights table;
  EXPECT_EQ(table[12'345], kNoLight); // nothing shines
  constexpr std::uint64_t kCount = 10'000'000'000;
  table.reset(kCount);
  table.set(0, 7);
  table.set(1, 8);
  table.set(5'000'000'000, 9);
  table.set(kCount - 1, 10);
  EXPECT_EQ(table[0], 7u);
  EXPECT_EQ(table[1], 8u);
  EXPECT_EQ(table[5'000'000'000], 9u);
  EXPECT_EQ(table[kCount - 1], 10u);
  for (std::uint64_t other :
       {std::uint64_t{2}, std::uint64_t{4'096}, 5'000'000'000 % (std::uint64_t{1} << 32),
        std::uint64_t{5'000'000'001}, kCount - 2})
    EXPECT_EQ(table[other], kNoLight) << other;
  EXPECT_LT(table.memory_bytes(), 20u << 20);
  table.reset(10);
  EXPECT_EQ(table[0], kNoLight);
}

/// A square [0, 1]^2 of 2 cells^2 triangles, the last of them in a slot of its own.
std::shared_ptr<const Mesh> square(std::uint32_t cells) {
  auto mesh = std::make_shared<Mesh>();
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      mesh->positions.emplace_back(vec3(i, j, 0) / static_cast<float>(cells));
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
      mesh->triangles.emplace_back(a, a + 1, b + 1);
      mesh->triangles.emplace_back(a, b + 1, b);
    }
  mesh->slot_names = {"all", "last"};
  mesh->material_slots.resize(mesh->triangles.size(), 0);
  mesh->material_slots.back() = 1;
  return mesh;
}

TEST(EmitterLights, ALampAmongBillionsOfPlacedTrianglesIsFound) {
  constexpr std::uint32_t kInstances = 70'000, kCells = 180;
  test::SceneMaker s(8, 8, 1);
  const int grey = s.diffuse(vec3(0.5f)), lamp = s.diffuse(vec3(0), vec3(3));
  const auto mesh = square(kCells);
  auto corner = [](std::uint32_t i) { return vec3(2 * (i % 300), 2 * (i / 300), 0); };
  for (std::uint32_t i = 0; i < kInstances; ++i)
    s.document.scene.instances.push_back(
        {"", mesh, glm::translate(mat4(1), corner(i)), {grey, i + 1 == kInstances ? lamp : grey}});
  const auto scene = RenderScene::build(s.document);
  ASSERT_GT(scene->geometry().emitter_count(), std::uint64_t{1} << 32);
  ASSERT_EQ(scene->lights().size(), 1u);
  EXPECT_LT(scene->memory_bytes(), std::size_t{200} << 20);

  auto light_at = [&](std::uint32_t instance, vec3 in_square) {
    const Ray ray{corner(instance) + in_square + vec3(0, 0, 1), 0, {0, 0, -1}};
    const auto hit = scene->geometry().accel().intersect(ray);
    if (!hit) throw std::runtime_error("the ray met nothing");
    return scene->light_of(scene->geometry().surface(ray, *hit).emitter);
  };
  const vec3 last(1 - 0.7f / kCells, 1 - 0.3f / kCells, 0); // the upper left half of the last cell
  EXPECT_EQ(light_at(kInstances - 1, last), 0u);
  EXPECT_EQ(light_at(kInstances - 1, vec3(0.5f, 0.25f, 0)), kNoLight);
  EXPECT_EQ(light_at(0, last), kNoLight);
  EXPECT_EQ(light_at(kInstances / 2, last), kNoLight);
}

} // namespace
} // namespace candela
