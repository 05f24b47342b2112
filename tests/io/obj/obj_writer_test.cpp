#include "core/error.h"
#include "io/obj/obj_writer.h"
#include "io/scene_reader.h"
#include "support/materials.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

using test::color;

Mesh folded_square() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3f}, {0, 1, 1e-5f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh read_back(const std::string& path) {
  const LoadedScene loaded = read_scene(path);
  return *std::get<std::shared_ptr<const Mesh>>(loaded.document.scene.instances.at(0).shape);
}

void expect_near(const Mesh& got, const Mesh& expected) {
  ASSERT_EQ(got.triangles, expected.triangles);
  ASSERT_EQ(got.positions.size(), expected.positions.size());
  ASSERT_EQ(got.normals.size(), expected.normals.size());
  ASSERT_EQ(got.uvs.size(), expected.uvs.size());
  for (std::size_t i = 0; i < got.positions.size(); ++i)
    EXPECT_LE(glm::distance(got.positions[i], expected.positions[i]), 1e-6f) << i;
  for (std::size_t i = 0; i < got.normals.size(); ++i)
    EXPECT_LE(glm::distance(got.normals[i], expected.normals[i]), 1e-6f) << i;
  for (std::size_t i = 0; i < got.uvs.size(); ++i)
    EXPECT_LE(glm::distance(got.uvs[i], expected.uvs[i]), 1e-6f) << i;
  ASSERT_EQ(got.vertex_colors.size(), expected.vertex_colors.size());
  for (std::size_t i = 0; i < got.vertex_colors.size(); ++i)
    EXPECT_LE(glm::distance(got.vertex_colors[i], expected.vertex_colors[i]), 1e-6f) << i;
}

TEST(ObjWriter, ReadsBackWithAnyAttributes) {
  test::ScratchFolder scratch;
  for (int attributes = 0; attributes < 8; ++attributes) {
    Mesh mesh = folded_square();
    if (attributes & 1) mesh.normals = {{0, 0, 1}, {0, 0.6f, 0.8f}, {1, 0, 0}, {0, 0, 1}};
    if (attributes & 2) mesh.uvs = {{0, 0}, {1, 0}, {0.123456f, 1}, {0, 1}};
    if (attributes & 4) mesh.vertex_colors = {{0, 0, 1}, {1, 0.001f, 0.2f}, {0.5f, 1, 0}, vec3(0.7f)};
    const std::string path = scratch / "mesh.obj";
    write_obj(mesh, "", path);
    expect_near(read_back(path), mesh);
  }
}

TEST(ObjWriter, NamesSlotsAndLibrary) {
  test::ScratchFolder scratch;
  Mesh mesh = folded_square();
  mesh.slot_names = {"left", "right"};
  mesh.material_slots = {1, 0};
  test::write_text(scratch / "some.mtl", "newmtl left\nKd 1 0 0\nnewmtl right\nKd 0 1 0\n");
  write_obj(mesh, "some.mtl", scratch / "mesh.obj");
  const LoadedScene loaded = read_scene(scratch / "mesh.obj");
  for (const Warning& w : loaded.warnings)
    EXPECT_NE(w.text.find("nothing emits light"), std::string::npos) << w.text;
  const Mesh got = read_back(scratch / "mesh.obj");
  EXPECT_EQ(got.slot_names, (std::vector<std::string>{"right", "left"})); // in the order of their use
  const Instance& instance = loaded.document.scene.instances.at(0);
  ASSERT_EQ(got.material_slots.size(), 2u);
  auto diffuse = [&](std::size_t triangle) {
    const auto material = static_cast<std::size_t>(instance.materials[got.material_slots[triangle]]);
    return color(loaded.document.scene.materials[material], "diffuse");
  };
  EXPECT_EQ(diffuse(0), vec3(0, 1, 0));
  EXPECT_EQ(diffuse(1), vec3(1, 0, 0));
}

TEST(ObjWriter, FailsWhereNothingCanBeWritten) {
  EXPECT_THROW(write_obj(folded_square(), "", "/nowhere/at/all/mesh.obj"), Error);
}

} // namespace
} // namespace candela
