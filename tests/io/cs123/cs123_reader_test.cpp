#include "io/scene_files.h"
#include "support/materials.h"

#include <fmt/format.h>

#include <numbers>

namespace candela {
namespace {

using test::color;
using test::number;
using test::use_of;

using test::mesh_of;
using test::SceneFiles;

constexpr const char* kObj =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n";

struct Cs123Reader : ::testing::Test {
  SceneFiles files;

  Cs123Reader() {
    files.write("m/m.obj", kObj);
    files.write("m/m.mtl", "newmtl a\nKd 0 1 0\nKe 1 1 1\n");
  }
  LoadedScene read(const std::string& inside) {
    files.write("s.xml", "<scenefile>\n" + inside + "\n</scenefile>\n");
    return files.read("s.xml");
  }
  std::string error(const std::string& inside, ExitCode code = ExitCode::bad_input) {
    files.write("s.xml", "<scenefile>\n" + inside + "\n</scenefile>\n");
    return files.error("s.xml", code);
  }
  /// A scene of one sphere under transformations.
  static std::string root(const std::string& transblock) {
    return "<object type=\"tree\" name=\"root\"><transblock>" + transblock + "</transblock></object>";
  }
  static std::string sphere(const std::string& transformations) {
    return root(transformations + "<object type=\"primitive\" name=\"sphere\"/>");
  }
  /// Where the point of a primitive goes, whose axis is y, while that of our shapes is z.
  vec3 transformed(const std::string& transformations, vec3 p) {
    return transform_point(read(sphere(transformations)).document.scene.instances.at(0).world_from_object,
                           {p.x, -p.z, p.y});
  }
  Material own(const std::string& inside, const std::string& before = "") {
    return read(before + root("<object type=\"primitive\" name=\"sphere\">" + inside + "</object>"))
        .document.scene.materials.at(0);
  }
};

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
  // The last one listed is the first to be applied.
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
  EXPECT_EQ(files.warnings(bare)[0], "1 x s.xml:2:82: there is no material 'b': a grey is taken");
}

TEST_F(Cs123Reader, GlassAbsorbsByTf) {
  files.write("m/g.obj", "mtllib g.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl g\nf 1 2 3\n");
  files.write("m/g.mtl", "newmtl g\nKd 0.01 0.01 0.01\nKs 0.3 0.3 0.3\nTf 0.1 0.2 0.3\nNi 2.5\nillum 7\n");
  Material glass =
      read(root("<object type='primitive' name='mesh' filename='m/g.obj'/>")).document.scene.materials[0];
  EXPECT_EQ(material_type_name(glass), "dielectric");
  EXPECT_EQ(color(glass, "absorption"), vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(color(glass, "transmittance"), vec3(1));
}

TEST_F(Cs123Reader, TfOfOnesIsClearAndAnyOtherIsToldOf) {
  files.write("m/g.obj", "mtllib g.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl g\nf 1 2 3\n");
  auto glass = [&](const std::string& tf) {
    files.write("m/g.mtl", "newmtl g\nTf " + tf + "\nNi 1.5\nillum 7\n");
    return read(root("<object type='primitive' name='mesh' filename='m/g.obj'/>"));
  };
  auto clear = glass("1 1 1");
  EXPECT_EQ(color(clear.document.scene.materials[0], "absorption"), vec3(0));
  EXPECT_EQ(clear.warnings.size(), 1u) << "that nothing shines";
  auto tinted = glass("0.9 0.5 0.25");
  EXPECT_EQ(color(tinted.document.scene.materials[0], "absorption"), vec3(0.9f, 0.5f, 0.25f));
  EXPECT_EQ(files.warnings(tinted)[0],
            "1 x m/g.mtl:1:1: material 'g': Tf 0.9 0.5 0.25 is read as absorption per unit of length");
}

TEST_F(Cs123Reader, KsIsAReflectance) {
  files.write("m/g.obj", "mtllib g.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl g\nf 1 2 3\n");
  files.write("m/g.mtl", "newmtl g\nKd 0.486 0.631 0.663\nKs 0.9 0.9 0.9\nNs 40\nillum 2\n");
  Material m =
      read(root("<object type='primitive' name='mesh' filename='m/g.obj'/>")).document.scene.materials[0];
  EXPECT_EQ(color(m, "specular"), vec3(0.9f));
  EXPECT_LT(glm::length(color(m, "diffuse") - vec3(0.1f)), 1e-6f);
}

TEST_F(Cs123Reader, PathsOfOtherMachinesMeanTheFileBeside) {
  files.write("t.png", test::tiny_png());
  auto loaded =
      read(root("<object type='primitive' name='sphere'><texture file='/course/cs123/data/t.png' u='2' "
                "v='3'/></object>"));
  const Material& m = loaded.document.scene.materials[0];
  EXPECT_EQ(use_of(m).texture, 0);
  EXPECT_EQ(use_of(m).uv.scale, vec2(2, 3));
  EXPECT_TRUE(test::says(files.without_folder(loaded.warnings[0].text), "s.xml:2:", {"'t.png' is taken"}));
  loaded = read(root("<object type='primitive' name='sphere'><texture file='/course/none.png'/></object>"));
  EXPECT_EQ(use_of(loaded.document.scene.materials[0]).texture, -1);
  files.write("broken.png", "no picture");
  loaded = read(root("<object type='primitive' name='sphere'><texture file='broken.png'/></object>"));
  EXPECT_EQ(use_of(loaded.document.scene.materials[0]).texture, -1);
  EXPECT_TRUE(
      test::says(files.without_folder(loaded.warnings[0].text), "s.xml:2:", {"no texture: ", "broken.png"}));
}

TEST_F(Cs123Reader, OwnMaterials) {
  Material m = own("<diffuse r='0.5' g='0.25' b='0'/><ambient r='1' g='1' b='1'/>");
  EXPECT_EQ(material_type_name(m), "diffuse");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.5f, 0.25f, 0));
  m = own("<diffuse r='0.5' g='0.5' b='0'/><specular r='0.25' g='0.75' b='1'/><shininess v='30'/>");
  EXPECT_EQ(material_type_name(m), "phong");
  EXPECT_EQ(number(m, "exponent"), 30);
  EXPECT_EQ(color(m, "diffuse"), vec3(0.5f, 0.25f, 0)) << "no more than 1 - specular";
  m = own("<reflective r='0.5' g='0.5' b='0.5'/><diffuse r='0.25' g='0.25' b='0.25'/>");
  EXPECT_EQ(material_type_name(m), "mirror");
  EXPECT_EQ(color(m, "specular"), vec3(0.5f));
  m = own("<transparent r='1' g='1' b='1'/><ior v='1.25'/>");
  EXPECT_EQ(material_type_name(m), "dielectric");
  EXPECT_EQ(number(m, "ior"), 1.25f);
  m = own("<diffuse r='1' g='1' b='1'/><specular r='1' g='1' b='1'/>",
          "<globaldata><diffusecoeff v='0.5'/><ks v='0.25'/><ambientcoeff v='0.5'/></globaldata>");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.5f));
  EXPECT_EQ(color(m, "specular"), vec3(0.25f));
  files.write("t.png", test::tiny_png());
  EXPECT_EQ(use_of(own("<texture file='t.png' u='1' v='1'/>")).texture, 0);
}

TEST_F(Cs123Reader, Lights) {
  auto loaded = read("<lightdata><id v='3'/><type v='directional'/><direction x='0' y='-2' z='0'/><color "
                     "r='1' g='2' b='3'/></lightdata>"
                     "<lightdata><position x='1' y='2' z='3'/><color r='1' g='1' b='1'/><function v1='1' "
                     "v2='0' v3='0'/></lightdata>" +
                     sphere(""));
  const auto& lights = loaded.document.scene.lights;
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].name, "light 3");
  EXPECT_EQ(std::get<DirectionalLightModel>(lights[0].model).direction, vec3(0, -2, 0));
  EXPECT_EQ(lights[0].color, vec3(1, 2, 3));
  EXPECT_EQ(std::get<PointLightModel>(lights[1].model), (PointLightModel{{1, 2, 3}, {1, 0, 0}}));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(test::says(files.warnings(loaded)[0], "1 x s.xml:2:181: a light's function", {"not physical"}));
}

TEST_F(Cs123Reader, SpotsAndAreaLights) {
  auto loaded =
      read("<lightdata><type v='spot'/><position x='1' y='2' z='3'/><direction x='0' y='-1' z='1'/>"
           "<angle v='30'/><penumbra v='10'/><function a='0' b='0' c='2'/><color r='4' g='5' b='6'/>"
           "</lightdata><lightdata><id v='1'/><type v='area'/><position x='0' y='4' z='0'/>"
           "<direction x='0' y='-3' z='0'/><width v='2'/><height v='6'/><color r='7' g='8' b='9'/>"
           "</lightdata>" +
           sphere(""));
  const SceneDesc& scene = loaded.document.scene;
  EXPECT_EQ(files.warnings(loaded), std::vector<std::string>{});
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto& spot = std::get<SpotLightModel>(scene.lights[0].model);
  EXPECT_EQ(spot.position, vec3(1, 2, 3));
  EXPECT_EQ(spot.direction, vec3(0, -1, 1));
  EXPECT_NEAR(degrees(spot.cutoff_angle), 30, 1e-5f);
  EXPECT_NEAR(degrees(spot.beam_width), 20, 1e-5f);
  EXPECT_EQ(spot.attenuation, vec3(0, 0, 2));
  EXPECT_EQ(scene.lights[0].color, vec3(4, 5, 6));
  ASSERT_EQ(scene.instances.size(), 2u);
  const Instance& area = scene.instances[0];
  EXPECT_EQ(area.name, "light 1");
  EXPECT_TRUE(std::holds_alternative<RectangleShape>(area.shape));
  EXPECT_EQ(transform_point(area.world_from_object, {1, 1, 0}), vec3(1, 4, 3));
  EXPECT_EQ(transform_vector(area.world_from_object, {0, 0, 1}), vec3(0, -1, 0)) << "it faces down";
  const Material& shine = scene.materials[static_cast<std::size_t>(area.materials[0])];
  EXPECT_EQ(shine.emission, vec3(7, 8, 9));
  EXPECT_FALSE(shine.two_sided_emission);
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
                                "1 x s.xml: nothing in the scene shines: the picture will be black"}))
      << "in the order of reading";
}

struct XmlError {
  const char* name;
  const char* xml; ///< line 2 of the file
  const char* start;
  const char* part;
};
class Cs123Errors : public Cs123Reader, public ::testing::WithParamInterface<XmlError> {};
TEST_P(Cs123Errors, AreLocated) {
  EXPECT_TRUE(test::says(error(GetParam().xml), GetParam().start, {GetParam().part}));
}
#define CANDELA_ROOT(inside) "<object type='tree' name='root'><transblock>" inside "</transblock></object>"
const XmlError kErrors[] = {
    {"NoRoot", "", "s.xml:1:1: scenefile: ", "no tree named root"},
    {"Syntax", "<object type='tree'", "s.xml:3:1: XML: ", ""},
    {"Unclosed", "<object>", "s.xml:3:3: XML: ", "mismatch"},
    {"TwoCameras", "<cameradata/><cameradata/>", "s.xml:2:14: cameradata: ", "second camera"},
    {"CameraNumber", "<cameradata><pos x='1' y='2' z='c'/></cameradata>",
     "s.xml:2:30: pos: ", "'c' is no finite number"},
    {"CameraMissing", "<cameradata><pos x='1' z='2'/></cameradata>",
     "s.xml:2:13: pos: ", "the attribute y is missing"},
    {"CameraInfinite", "<cameradata><up x='1' z='2' y = \"1e99\"/></cameradata>",
     "s.xml:2:29: up: ", "no finite number"},
    {"HeightAngle", "<cameradata><heightangle v='180'/></cameradata>",
     "s.xml:2:13: heightangle: ", "0.1 to 179"},
    {"LooksNowhere", "<cameradata><look x='0' y='0' z='0'/></cameradata>",
     "s.xml:2:1: cameradata: ", "nowhere"},
    {"UpAlongView", "<cameradata><look x='0' y='3' z='0'/></cameradata>",
     "s.xml:2:1: cameradata: ", "parallel"},
    {"Coefficient", "<globaldata><kd v='-1'/></globaldata>", "s.xml:2:13: kd: ", "negative"},
    {"SpotAngle", "<lightdata><type v='spot'/><angle v='200'/></lightdata>",
     "s.xml:2:28: angle: ", "from 0.01 to 180"},
    {"Penumbra", "<lightdata><type v='spot'/><penumbra v='-1'/></lightdata>",
     "s.xml:2:28: penumbra: ", "out of range"},
    {"SpotDirection", "<lightdata><type v='spot'/><direction x='0' y='0' z='0'/></lightdata>",
     "s.xml:2:1: lightdata: ", "no length"},
    {"AreaWidth", "<lightdata><type v='area'/><width v='0'/></lightdata>",
     "s.xml:2:28: width: ", "no length"},
    {"FunctionZero", "<lightdata><function a='0' b='0' c='0'/></lightdata>",
     "s.xml:2:12: function: ", "infinite"},
    {"FunctionNegative", "<lightdata><function a='0' b='-1' c='1'/></lightdata>",
     "s.xml:2:12: function: ", "negative"},
    {"LightType", "<lightdata><type v='sun'/></lightdata>", "s.xml:2:18: lightdata: ", "no light type 'sun'"},
    {"LightColor", "<lightdata><color r='1' g='-1' b='1'/></lightdata>", "s.xml:2:12: color: ", "negative"},
    {"LightDirection", "<lightdata><type v='directional'/><direction x='0' y='0' z='0'/></lightdata>",
     "s.xml:2:1: lightdata: ", "no length"},
    {"TopPrimitive", "<object type='primitive' name='sphere'/>", "s.xml:2:1: object: ", "only named trees"},
    {"SecondTree", "<object type='tree' name='a'/><object type='tree' name='a'/>",
     "s.xml:2:31: object: ", "second tree 'a'"},
    {"ObjectType", CANDELA_ROOT("<object type='group'/>"), "s.xml:2:53: object: ", "no object type 'group'"},
    {"Primitive", CANDELA_ROOT("<object type='primitive' name='teapot'/>"),
     "s.xml:2:70: object: ", "no primitive 'teapot'"},
    {"MeshNoFile", CANDELA_ROOT("<object type='primitive' name='mesh'/>"),
     "s.xml:2:45: object: ", "without a file"},
    {"MeshMissing", CANDELA_ROOT("<object type='primitive' name='mesh' filename='x.obj'/>"),
     "s.xml:2:82: filename: ", "no file 'x.obj'"},
    {"RotateAxis", CANDELA_ROOT("<rotate x='0' y='0' z='0' angle='1'/>"),
     "s.xml:2:45: rotate: ", "no length"},
    {"MatrixSize", CANDELA_ROOT("<matrix>1 2 3</matrix>"), "s.xml:2:45: matrix: ", "3 numbers"},
    {"MatrixRow", CANDELA_ROOT("<matrix><row a='1' b='2' c='3'/></matrix>"),
     "s.xml:2:53: row: ", "attribute d is missing"},
    {"Flat", CANDELA_ROOT("<scale x='0' y='1' z='1'/><object type='primitive' name='sphere'/>"),
     "s.xml:2:71: transblock: ", "flattens"},
    {"NoMaster", "<object type='tree' name='tree'/>" CANDELA_ROOT("<object type='master' name='tre'/>"),
     "s.xml:2:78: object: ", "did you mean 'tree'?"},
    {"Cycle", CANDELA_ROOT("<object type='master' name='root'/>"),
     "s.xml:2:45: object: ", "'root' contains itself"},
    {"LongCycle",
     "<object type='tree' name='a'><transblock><object type='master' name='b'/></transblock></object>"
     "<object type='tree' name='b'><transblock><object type='master' "
     "name='a'/></transblock></object>" CANDELA_ROOT("<object type='master' name='a'/>"),
     "s.xml:2:137: object: ", "'a' contains itself"},
    {"TextureNoFile", CANDELA_ROOT("<object type='primitive' name='sphere'><texture/></object>"),
     "s.xml:2:84: texture: ", "names no file"},
};
#undef CANDELA_ROOT
INSTANTIATE_TEST_SUITE_P(All, Cs123Errors, ::testing::ValuesIn(kErrors),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(Cs123Reader, OtherXml) {
  files.write("s.xml", "<?xml version='1.0'?>\n<scene version='0.6'/>");
  EXPECT_TRUE(test::says(files.error("s.xml"), "s.xml:2:1: scene: ", {"<scene> is no CS123 scene"}));
  files.write("s.xml", "");
  EXPECT_TRUE(test::says(files.error("s.xml"), "s.xml:1:1: XML: "));
  files.write("s.xml", std::string("<\0s\0c\0", 6));
  EXPECT_TRUE(test::says(files.error("s.xml"), "s.xml:1:2: scene: ", {"NUL"}));
}

TEST_F(Cs123Reader, CapsDepthAndGrowth) {
  std::string deep, shut;
  for (int i = 0; i < 70; ++i) deep += "<object type='tree'><transblock>", shut += "</transblock></object>";
  EXPECT_TRUE(
      test::says(error(root(deep + "<object type='primitive' name='sphere'/>" + shut), ExitCode::limit),
                 "s.xml:2:", {"64 levels"}));
  // Each master holds two of the one before: 2^40 spheres in 40 lines.
  auto doubling = [](const std::string& first) {
    std::string trees = "<object type='tree' name='t0'>" + first + "</object>\n";
    for (int i = 1; i <= 40; ++i) {
      std::string half =
          "<transblock><object type='master' name='t" + std::to_string(i - 1) + "'/></transblock>";
      trees += "<object type='tree' name='t" + std::to_string(i) + "'>" + half + half + "</object>\n";
    }
    return trees + root("<object type='master' name='t40'/>");
  };
  EXPECT_TRUE(test::says(
      error(doubling("<transblock><object type='primitive' name='sphere'/></transblock>"), ExitCode::limit),
      "s.xml:2:", {"1000000 instances"}));
  EXPECT_TRUE(test::says(error(doubling(""), ExitCode::limit), "s.xml:", {"4000000"}));
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
