// References between materials.

#include "materials/blend_parts.h"
#include "materials/material_parts.h"
#include "scene/document.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace candela {
namespace {

Material plain(std::string name) { return {std::move(name), DiffuseMaterial{}}; }
Material blend(std::string name, int first, int second) {
  return {std::move(name), BlendMaterial{first, second, 0.5f}};
}
Material two_sided(std::string name, int front, int back) {
  return {std::move(name), TwoSidedMaterial{front, back}};
}

std::string problem(const std::vector<Material>& materials) {
  const auto p = parts_problem(materials);
  Document document;
  document.scene.materials = materials;
  EXPECT_EQ(document_problem(document).empty(), !p);
  return p ? fmt::format("{}.{}: {}", p->material, p->key, p->cause) : "";
}

TEST(MaterialParts, GoodOnesHaveNoProblem) {
  EXPECT_EQ(problem({}), "");
  EXPECT_EQ(problem({blend("a", -1, -1)}), "");
  EXPECT_EQ(problem({blend("a", 1, 2), plain("b"), two_sided("c", 1, 3), blend("d", 1, 1)}), "")
      << "several may name one";
}

TEST(MaterialParts, CyclesAreNamed) {
  EXPECT_EQ(problem({plain("x"), blend("a", 0, 1)}), "1.second: the materials contain themselves: a -> a");
  EXPECT_EQ(problem({blend("a", 3, 1), two_sided("b", 2, 3), blend("c", 3, 0), plain("x")}),
            "2.second: the materials contain themselves: a -> b -> c -> a");
  EXPECT_EQ(problem({two_sided("", 0, -1)}),
            "0.front: the materials contain themselves: material 0 -> material 0");
}

TEST(MaterialParts, OnlyMaterialsOfTheSceneThatAreThere) {
  EXPECT_EQ(problem({blend("a", 0, 5)}).substr(0, 8), "0.first:");
  EXPECT_EQ(problem({blend("a", 1, 5), plain("b")}), "0.second: there is no material 5");
  EXPECT_EQ(problem({blend("a", -2, 1), plain("b")}).empty(), false);
  EXPECT_EQ(problem({two_sided("a", -1, 1), Material{"air", NullMaterial{}}}),
            "0.back: 'air' is invisible (null)");
}

TEST(MaterialParts, AreLimitedInNumberAndDepth) {
  std::vector<Material> wide = {plain("leaf")};
  for (int i = 0; i < 4; ++i) wide.push_back(blend(fmt::format("b{}", i), i, i)); // 1, 2, 4, 8, 16 leaves
  EXPECT_EQ(problem({wide.begin(), wide.end() - 1}), "");
  EXPECT_EQ(problem(wide), "4.second: more than 8 materials are blended");
  std::vector<Material> deep = {plain("leaf")};
  for (int i = 0; i < kMostNesting; ++i) deep.push_back(two_sided("t", i, i));
  EXPECT_EQ(problem(deep), "");
  deep.push_back(two_sided("t", kMostNesting, -1));
  EXPECT_EQ(problem(deep), "17.front: more than 16 combined materials contain each other");
  for (int i = 0; i < 200000; ++i) deep.push_back(two_sided("t", static_cast<int>(deep.size()) + 1, -1));
  deep.push_back(plain("end"));
  EXPECT_FALSE(problem(deep).empty()) << "and the check needs no deep stack";
}

TEST(MaterialParts, ContainmentGoesThroughOthers) {
  const std::vector<Material> all = {plain("x"), blend("a", 0, -1), two_sided("b", -1, 1), plain("y")};
  EXPECT_TRUE(contains_material(all, 2, 0));
  EXPECT_TRUE(contains_material(all, 2, 2));
  EXPECT_FALSE(contains_material(all, 2, 3));
  EXPECT_FALSE(contains_material(all, 0, 2));
}

TEST(MaterialParts, TheBodyIsThatOfTheFirstPartWithOne) {
  const Material water{"water", DielectricMaterial{1.33f, vec3(1), {1, 2, 3}, 0}},
      oil{"oil", DielectricMaterial{1.47f, vec3(1), {4, 5, 6}, 0}};
  const std::vector<Material> all = {
      water, oil, plain("x"), blend("a", 2, 1), two_sided("b", 3, 0), blend("c", 2, -1)};
  std::vector<const Material*> pointers;
  for (const Material& m : all) pointers.push_back(&m);
  EXPECT_EQ(interior(pointers, 3)->absorption, vec3(4, 5, 6));
  EXPECT_EQ(interior(pointers, 4)->absorption, vec3(4, 5, 6));
  EXPECT_FALSE(interior(pointers, 5));
  EXPECT_EQ(interior(pointers, 0)->ior, 1.33f);
}

} // namespace
} // namespace candela
