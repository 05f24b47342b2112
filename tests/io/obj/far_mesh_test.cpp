// Meshes far from their origin keep their shape.

#include "io/candela/candela_json.h"
#include "io/obj/obj_mesh.h"
#include "io/scene_files.h"

#include <fmt/format.h>

namespace candela {
namespace {

using test::mesh_of;
using test::SceneFiles;

/// A square of 0.1 in steps that floats do not have there.
const char* const kFar =
    "v 448000.1 5411000.2 312.3\nv 448000.2 5411000.2 312.3\nv 448000.2 5411000.3 312.3\n"
    "v 448000.1 5411000.3 312.3\nf 1 2 3 4\n";

struct FarMeshes : ::testing::Test {
  SceneFiles files;
  FarMeshes() { files.write("far.obj", kFar); }

  static void expect_square(const Mesh& mesh) {
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(glm::length(mesh.positions[i] - mesh.positions[(i + 1) % 4]), 0.1f, 1e-6f);
  }
  bool warns(const LoadedScene& loaded, const char* part) {
    for (const std::string& w : files.warnings(loaded))
      if (w.find(part) != w.npos) return true;
    return false;
  }
};

TEST(MeshOrigin, IsThatOfTheFileWhereFloatsSuffice) {
  using glm::dvec3;
  EXPECT_EQ(mesh_origin(dvec3(-1), dvec3(1)), dvec3(0));
  EXPECT_EQ(mesh_origin(dvec3(9, 9, 9), dvec3(10, 10, 10)), dvec3(0));
  EXPECT_EQ(mesh_origin(dvec3(5), dvec3(5)), dvec3(0)) << "one point has no shape";
  const dvec3 origin = mesh_origin(dvec3(447999.1, 5411000.3, 311), dvec3(448000.7, 5411001.9, 313));
  EXPECT_NEAR(origin.y, 5411001.1, 0.5);
  EXPECT_EQ(origin, dvec3(vec3(origin))) << "floats";
}

TEST_F(FarMeshes, AloneTheyAreMovedToTheOrigin) {
  auto loaded = files.read("far.obj");
  expect_square(mesh_of(loaded));
  EXPECT_EQ(loaded.document.scene.instances[0].world_from_object, mat4(1));
  EXPECT_LT(glm::length(loaded.document.scene.camera.position), 1);
  EXPECT_TRUE(warns(loaded, "is taken for the origin"));
  const Mesh& mesh = mesh_of(loaded);
  const glm::dvec3 corner = glm::dvec3(mesh.positions[0]) + mesh.origin;
  EXPECT_LT(glm::length(corner - glm::dvec3(448000.1, 5411000.2, 312.3)), 1e-6);
}

TEST_F(FarMeshes, InAScenePlacementCountsAndItsLossIsTold) {
  files.write("s.json", R"({"candela": 1, "instances": [{"file": "far.obj"},
    {"file": "far.obj", "transform": [{"translate": [-448000.1, -5411000.2, -312.3]}, {"scale": 10}]}]})");
  auto loaded = files.read("s.json");
  expect_square(mesh_of(loaded));
  const auto& instances = loaded.document.scene.instances;
  const Mesh& mesh = mesh_of(loaded);
  EXPECT_LT(glm::length(transform_point(instances[0].world_from_object, mesh.positions[0]) -
                        vec3(448000.1f, 5411000.2f, 312.3f)),
            1);
  EXPECT_LT(glm::length(transform_point(instances[1].world_from_object, mesh.positions[0])), 1e-5f);
  EXPECT_LT(glm::length(transform_point(instances[1].world_from_object, mesh.positions[2]) - vec3(1, 1, 0)),
            1e-5f);
  int told = 0;
  for (const Warning& w : loaded.warnings)
    told += w.text.find("floats are 0.5 apart") != w.text.npos ? w.count : 0;
  EXPECT_EQ(told, 1) << "of the first, not of the second";
}

TEST_F(FarMeshes, WrittenScenesReadBackToTheSamePlace) {
  files.write("s.json", R"({"candela": 1, "instances": [{"file": "far.obj",
    "transform": [{"translate": [-448000, -5411000, -312]}, {"rotate": [0, 1, 0, 30]}, {"scale": 3}]}]})");
  for (const char* name : {"s.json", "far.obj"}) {
    auto first = files.read(name);
    write_candela_json(first.document, files / "again.json");
    auto again = files.read("again.json");
    EXPECT_EQ(again.document.scene.instances[0].world_from_object,
              first.document.scene.instances[0].world_from_object)
        << name;
    EXPECT_EQ(mesh_of(again).positions, mesh_of(first).positions);
  }
}

TEST_F(FarMeshes, InCs123ScenesToo) {
  files.write("s.xml",
              "<scenefile><object type='tree' name='root'><transblock><translate x='-448000' y='-5411000' "
              "z='-312'/><object type='primitive' name='mesh' filename='far.obj'/></transblock></object>"
              "</scenefile>");
  auto loaded = files.read("s.xml");
  expect_square(mesh_of(loaded));
  const vec3 corner =
      transform_point(loaded.document.scene.instances[0].world_from_object, mesh_of(loaded).positions[0]);
  EXPECT_LT(glm::length(corner - vec3(0.1f, 0.2f, 0.3f)), 1e-5f);
}

} // namespace
} // namespace candela
