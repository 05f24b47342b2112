// CS123 scenes: camera, transformations, objects, meshes.

#include "io/cs123/cs123_files.h"

#include <fmt/format.h>

#include <numbers>

namespace candela {
namespace {

using test::color;
using test::Cs123Reader;
using test::mesh_of;

TEST_F(Cs123Reader, Camera) {
  auto camera = [&](const std::string& data) {
    return read("<cameradata>" + data + "</cameradata>" + sphere("")).document.scene.camera;
  };
  Camera c = camera(
      "<pos x='1' y='2' z='3'/><focus x='4' y='5' z='6'/><up x='0' y='0' z='1'/><heightangle v='60'/>");
  EXPECT_EQ(c.position, vec3(1, 2, 3));
  EXPECT_EQ(c.target, vec3(4, 5, 6));
  EXPECT_EQ(c.up, vec3(0, 0, 1));
  EXPECT_EQ(c.vertical_fov, static_cast<float>(std::numbers::pi / 3));
  c = camera(
      "<pos x='1' y='2' z='3'/><look x='0' y='0' z='-2'/><heightangle angle='60'/><aspectratio v='1'/>");
  EXPECT_EQ(c.target, vec3(1, 2, 1));
  Camera standard = read(sphere("")).document.scene.camera;
  EXPECT_EQ(standard.position, vec3(5));
  EXPECT_EQ(standard.target, vec3(4));
}

TEST_F(Cs123Reader, TransformationsComposeInTheOrderListed) {
  EXPECT_EQ(transformed("", vec3(1, 2, 3)), vec3(1, 2, 3));
  // The last listed transformation is applied first.
  EXPECT_EQ(transformed("<translate x='1' y='0' z='0'/><scale x='2' y='3' z='4'/>", vec3(1)), vec3(3, 3, 4));
  EXPECT_EQ(transformed("<scale x='2' y='3' z='4'/><translate x='1' y='0' z='0'/>", vec3(1)), vec3(4, 3, 4));
  EXPECT_EQ(transformed("<rotate x='0' y='0' z='1' angle='90'/>", vec3(1, 0, 0)), vec3(0, 1, 0));
  const char* rows = "<matrix><row a='1' b='2' c='3' d='4'/><row a='0' b='1' c='0' d='0'/>"
                     "<row a='0' b='0' c='1' d='0'/><row a='0' b='0' c='0' d='1'/></matrix>";
  EXPECT_EQ(transformed(rows, vec3(1)), vec3(10, 1, 1)) << "row-major";
  EXPECT_EQ(transformed("<matrix>1 2 3 4\n0 1 0 0\n0 0 1 0\n0 0 0 1</matrix>", vec3(1)), vec3(10, 1, 1));
  auto nested =
      read(root("<translate x='10' y='0' z='0'/><object type='tree'><transblock><scale x='2' y='2' z='2'/>"
                "<object type='primitive' name='sphere'/></transblock></object>"));
  EXPECT_EQ(transform_point(nested.document.scene.instances[0].world_from_object, {1, -1, 1}),
            vec3(12, 2, 2));
}

TEST_F(Cs123Reader, Meshes) {
  std::string mesh =
      "<object type='primitive' name='mesh' filename='m/m.obj'><diffuse r='0' g='0' b='1'/></object>";
  auto loaded =
      read("<object type='tree' name='root'><transblock>" + mesh +
           "</transblock><transblock><translate x='1' y='0' z='0'/>" + mesh + "</transblock></object>");
  const SceneDesc& s = loaded.document.scene;
  ASSERT_EQ(s.instances.size(), 2u);
  EXPECT_EQ(&mesh_of(loaded, 0), &mesh_of(loaded, 1)) << "a file is read once";
  auto diffuse = [&](std::size_t instance, std::size_t slot) {
    return color(s.materials[static_cast<std::size_t>(s.instances[instance].materials[slot])], "diffuse");
  };
  EXPECT_EQ(diffuse(0, 0), vec3(0, 1, 0)) << "the MTL wins";
  EXPECT_EQ(diffuse(0, 1), vec3(0, 0, 1)) << "what it lacks is the object's";
  EXPECT_EQ(diffuse(1, 1), vec3(0, 0, 1));
  EXPECT_TRUE(loaded.warnings.empty());
  auto bare = read(root("<object type='primitive' name='mesh' filename='m\\m.obj'/>"));
  EXPECT_EQ(files.warnings(bare)[0], "1 x s.xml:2:82: there is no material 'b': a grey one is used");
}

TEST_F(Cs123Reader, PrimitivesFillTheUnitCube) {
  for (const char* kind : {"cube", "cylinder", "cone", "sphere", "torus"}) {
    SCOPED_TRACE(kind);
    auto loaded = read(root(std::string("<translate x='5' y='0' z='0'/><object type='primitive' name='") +
                            kind + "'><diffuse r='1' g='0' b='0'/></object>"));
    const SceneDesc& scene = loaded.document.scene;
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(shape_name(scene.instances[0].shape), kind);
    EXPECT_EQ(color(scene.materials[static_cast<std::size_t>(scene.instances[0].materials[0])], "diffuse"),
              vec3(1, 0, 0));
    Bounds3 box = scene_bounds(scene);
    float height = std::string(kind) == "torus" ? 0.125f : 0.5f;
    EXPECT_LT(glm::length(box.lo - vec3(4.5f, -height, -0.5f)), 1e-6f);
    EXPECT_LT(glm::length(box.hi - vec3(5.5f, height, 0.5f)), 1e-6f);
  }
  for (const char* kind : {"cylinder", "cone", "sphere", "torus"}) {
    auto round = read(root(fmt::format("<object type='primitive' name='{}'/>", kind)));
    const mat4& m = round.document.scene.instances[0].world_from_object;
    EXPECT_EQ(transform_vector(m, {0, 0, 1}), vec3(0, 1, 0))
        << kind << ": the axis, and so its textures, is y";
    EXPECT_EQ(transform_vector(m, {0, -1, 0}), vec3(0, 0, 1)) << kind << ": the middle of them faces +z";
  }
  auto cone = read(root("<object type='primitive' name='cone'/>"));
  vec3 apex = transform_point(cone.document.scene.instances[0].world_from_object, {0, 0, 1});
  EXPECT_LT(glm::length(apex - vec3(0, 0.5f, 0)), 1e-6f) << "upright";
}

TEST_F(Cs123Reader, MasterObjects) {
  auto loaded = read("<object type='tree' name='pair'><transblock><object type='primitive' "
                     "name='sphere'><diffuse r='1' g='0' b='0'/></object></transblock>"
                     "<transblock><translate x='0' y='1' z='0'/><object type='primitive' "
                     "name='sphere'/></transblock></object>"
                     "<object type='tree' name='root'><transblock><translate x='5' y='0' z='0'/><object "
                     "type='master' name='pair'/></transblock>"
                     "<transblock><object type='tree' name='pair'/></transblock></object>");
  const auto& instances = loaded.document.scene.instances;
  ASSERT_EQ(instances.size(), 4u);
  EXPECT_EQ(std::get<SphereShape>(instances[0].shape).radius, 0.5f);
  EXPECT_EQ(vec3(instances[1].world_from_object[3]), vec3(5, 1, 0));
  EXPECT_EQ(vec3(instances[3].world_from_object[3]), vec3(0, 1, 0));
  EXPECT_EQ(instances[0].materials, instances[2].materials) << "instances share materials";
}

TEST_F(Cs123Reader, IgnoresAndCounts) {
  auto loaded = read("<cameradata><aspectratio v='1'/></cameradata><hut/><hut/>" +
                     root("<object type='primitive' name='sphere'><diffuse r='1' g='1' b='1'/><blend "
                          "v='1'/></object><translate x='1' y='0' z='0'/>"));
  EXPECT_EQ(
      files.warnings(loaded),
      (std::vector<std::string>{"1 x s.xml:2:13: <aspectratio> is ignored",
                                "2 x s.xml:2:46: <hut> is ignored", "1 x s.xml:2:169: <blend> is ignored",
                                "1 x s.xml:2:192: what follows the object of a transblock is ignored",
                                "1 x s.xml: nothing in the scene emits light: the picture will be black"}))
      << "in the order of reading";
}

TEST_F(Cs123Reader, TheAssignmentsScenes) {
  std::string folder = CANDELA_SHARED_DATA "/cs123/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  struct Expected {
    const char* file;
    std::size_t triangles, materials;
    std::string_view one_of;
  };
  for (const Expected& e : {Expected{"CornellBox.xml", 36, 8, "diffuse"},
                            {"CornellBox-Mirror.xml", 36, 8, "mirror"},
                            {"CornellBox-Glossy.xml", 0, 8, "phong"},
                            {"CornellBox-Sphere.xml", 0, 8, "dielectric"},
                            {"ColoredBox.xml", 14, 7, "diffuse"},
                            {"MedievalBoat.xml", 0, 3, "mirror"}}) {
    SCOPED_TRACE(e.file);
    auto loaded = read_scene(folder + e.file);
    const SceneDesc& s = loaded.document.scene;
    EXPECT_EQ(document_problem(loaded.document), "");
    EXPECT_EQ(s.materials.size(), e.materials) << "the objects' own attributes are not used";
    ASSERT_EQ(s.instances.size(), 1u);
    if (e.triangles > 0) { EXPECT_EQ(mesh_of(loaded).triangles.size(), e.triangles); }
    EXPECT_GT(mesh_of(loaded).triangles.size(), 13u);
    EXPECT_TRUE(std::ranges::any_of(s.materials,
                                    [&](const Material& m) { return material_type_name(m) == e.one_of; }));
    EXPECT_TRUE(std::ranges::any_of(
        s.materials, [](const Material& m) { return m.emission.value.x > 0 && !m.two_sided_emission; }));
  }
  auto box = read_scene(folder + "CornellBox.xml").document.scene.camera;
  EXPECT_EQ(box.position, vec3(0, 1, 3.6f));
  EXPECT_EQ(box.target, vec3(0, 1, 0));
  EXPECT_EQ(box.vertical_fov, radians(45.0f));
}

} // namespace
} // namespace candela
