#include "io/scene_files.h"
#include "support/materials.h"

#include <algorithm>
#include <fstream>

namespace candela {
namespace {

using test::color;
using test::number;
using test::use_of;

using test::mesh_of;
using test::SceneFiles;

struct ObjReader : ::testing::Test {
  SceneFiles files;

  LoadedScene read(const std::string& obj, const std::string& mtl = "") {
    files.write("x.mtl", mtl);
    files.write("x.obj", obj);
    return files.read("x.obj");
  }
  std::string error(const std::string& obj, ExitCode code = ExitCode::bad_input) {
    files.write("x.obj", obj);
    return files.error("x.obj", code);
  }
  /// The material of a triangle's only slot.
  Material material(const std::string& mtl) {
    LoadedScene loaded = read(std::string(kTriangle), "newmtl m\n" + mtl);
    warnings = files.warnings(loaded);
    return loaded.document.scene.materials.at(0);
  }

  static constexpr const char* kTriangle = "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
  std::vector<std::string> warnings;
};

TEST_F(ObjReader, UnifiesCornersOfEqualIndices) {
  auto loaded = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvn 0 0 2\nvn 1 0 0\n"
                     "f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/1 4/2/1\nf 1/1/2 3/1/1 4/2/1\n");
  const Mesh& mesh = mesh_of(loaded);
  EXPECT_EQ(mesh.positions.size(), 5u) << "corner 1 once with each normal";
  EXPECT_EQ(mesh.triangles, (std::vector<uvec3>{{0, 1, 2}, {0, 2, 3}, {4, 2, 3}}));
  EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1)) << "unit";
  EXPECT_EQ(mesh.normals[4], vec3(1, 0, 0));
  EXPECT_EQ(mesh.uvs[1], vec2(1, 0));
  EXPECT_EQ(mesh.name, "x");
  EXPECT_EQ(mesh.source, std::filesystem::canonical(files / "x.obj"));
  EXPECT_TRUE(mesh.material_slots.empty());
}

TEST_F(ObjReader, NegativeIndicesCountBackwards) {
  auto loaded =
      read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nvn 0 0 1\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\n"
           "v 5 1 0\nf -4//-1 -3//-1 -1//-1\n");
  const Mesh& mesh = mesh_of(loaded);
  EXPECT_EQ(mesh.positions[0], vec3(0, 0, 0));
  EXPECT_EQ(mesh.positions[2], vec3(0, 1, 0));
  EXPECT_EQ(mesh.uvs[2], vec2(0.5f, 0.25f));
  EXPECT_EQ(mesh.positions[mesh.triangles[1].z], vec3(5, 1, 0));
  EXPECT_EQ(mesh.positions[mesh.triangles[1].x], vec3(0, 0, 0));
}

TEST_F(ObjReader, IndicesMayRunAhead) {
  auto loaded = read("f 1//1 2//1 3//1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n");
  EXPECT_EQ(mesh_of(loaded).positions[1], vec3(1, 0, 0));
  EXPECT_EQ(mesh_of(loaded).normals[1], vec3(0, 0, 1));
}

TEST_F(ObjReader, MissingNormalsAreFlatAndMissingUvsZero) {
  auto loaded = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 0\nvt 1 1\nf 1//1 2 3/1/2\n");
  EXPECT_EQ(mesh_of(loaded).normals, (std::vector<vec3>{{0, 0, 1}, vec3(0), vec3(0)}));
  EXPECT_EQ(mesh_of(loaded).uvs, (std::vector<vec2>{vec2(0), vec2(0), vec2(1)}));
  auto plain = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 1 1\nf 1 2 3\n");
  EXPECT_TRUE(mesh_of(plain).normals.empty());
  EXPECT_TRUE(mesh_of(plain).uvs.empty());
}

TEST_F(ObjReader, TriangulatesAConcavePentagon) {
  auto loaded = read("v 0 0 0\nv 4 0 0\nv 4 3 0\nv 2 1 0\nv 0 3 0\nf 1 2 3 4 5\n");
  const Mesh& mesh = mesh_of(loaded);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  float sum = 0;
  for (const uvec3& t : mesh.triangles) {
    float z =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).z;
    EXPECT_GT(z, 0);
    sum += 0.5f * z;
  }
  EXPECT_EQ(sum, 8);
}

TEST_F(ObjReader, DropsAndCountsWhatHasNoArea) {
  auto loaded = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 4\nf 1 5 3\nf 1 2\nf\nl 1 2\n");
  EXPECT_EQ(mesh_of(loaded).triangles.size(), 1u);
  EXPECT_EQ(files.warnings(loaded),
            (std::vector<std::string>{"2 x x.obj:10:1: faces with fewer than three corners are dropped",
                                      "1 x x.obj:12:1: 'l' is ignored",
                                      "3 x x.obj:7: triangles without area are dropped",
                                      "1 x x.obj: faces without a material: a grey one is used",
                                      "1 x x.obj: nothing emits light: a constant light is added"}));
}

TEST_F(ObjReader, ReadsEverySpelling) {
  auto loaded = read(
      "# comment\r\n\r\n  v\t+0 0. .0 # origin\r\nv 1e0 0 -0.0 1.0\r\nv \\\r\n 0 1E+0 \\\n 0 0.5 0.5 0.5\r\n"
      "o thing\r\ng a b\r\ns off\r\nusemtl a name\r\n f   1   2   3  # one\r\n");
  EXPECT_EQ(mesh_of(loaded).positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh_of(loaded).slot_names, std::vector<std::string>{"a name"});
  const float half = linear_from_srgb(0.5f);
  EXPECT_EQ(mesh_of(loaded).vertex_colors, (std::vector<vec3>{vec3(1), vec3(1), vec3(half)}));
  auto mac = read("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3");
  EXPECT_EQ(mesh_of(mac).positions.size(), 3u);
}

TEST_F(ObjReader, VerticesMayHaveColors) {
  auto loaded = read("v 0 0 0 1 0 0.25\nv 1 0 0 0 2 0.5\nv 0 1 0 x 1 1\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  const auto& colors = mesh_of(loaded).vertex_colors;
  const float quarter = linear_from_srgb(0.25f), half = linear_from_srgb(0.5f);
  EXPECT_EQ(colors, (std::vector<vec3>{{1, 0, quarter}, {0, 1, half}, vec3(1), vec3(1)}))
      << "as screens show";
  EXPECT_EQ(files.warnings(loaded),
            (std::vector<std::string>{
                "1 x x.obj:2:11: vertex colours outside of [0, 1] are clamped",
                "1 x x.obj:3:9: vertex colours that are no numbers: white there",
                "1 x x.obj: faces without a material: one with the colours of its vertices is used",
                "1 x x.obj: nothing emits light: a constant light is added"}));
  // They are seen.
  const SceneDesc& scene = loaded.document.scene;
  const int material = scene.instances.at(0).materials.at(0);
  const TextureUse& use = use_of(scene.materials.at(static_cast<std::size_t>(material)), "diffuse");
  ASSERT_EQ(use.texture, 0);
  EXPECT_TRUE(std::holds_alternative<MeshAttributeTexture>(scene.textures.at(0)->model));
}

TEST_F(ObjReader, FloatsAreNearest) {
  auto loaded =
      read("v 0.1 0.2 0.3\nv 1.1754944e-38 16777217 3.3333333\nv -0.00012345678 123456.789 1e-50\nf 1 2 3\n");
  const auto& p = mesh_of(loaded).positions;
  EXPECT_EQ(p[0], vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(p[1], vec3(1.1754944e-38f, 16777216, 3.3333333f));
  EXPECT_EQ(p[2], vec3(-0.00012345678f, 123456.789f, 0));
}

TEST_F(ObjReader, LinesOfErrorsCountContinuedLinesAndAllLineEnds) {
  EXPECT_TRUE(
      test::says(error("v 0 0 0\r\nv 1 \\\r\n0 0\r\nv 0 1 x\r\n"), "x.obj:4:7: v: ", {"'x' is no number"}));
  EXPECT_TRUE(test::says(error("v 0 0 0\rv 1 0 0\rv 0 1\r"), "x.obj:3:6: v: ", {"2 of 3"}));
}

struct ObjError {
  const char* name;
  const char* obj;
  const char* start;
  const char* part;
};
class ObjReaderErrors : public ObjReader, public ::testing::WithParamInterface<ObjError> {};
TEST_P(ObjReaderErrors, AreLocated) {
  EXPECT_TRUE(test::says(error(GetParam().obj), GetParam().start, {GetParam().part}));
}
const ObjError kObjErrors[] = {
    {"Empty", "", "x.obj: mesh: ", "no face"},
    {"NoFaces", "v 0 0 0\n", "x.obj: mesh: ", "no face"},
    {"OnlyDegenerate", "v 0 0 0\nf 1 1 1\n", "x.obj: mesh: ", "no face"},
    {"Nan", "v 0 nan 0\n", "x.obj:1:5: v: ", "not a finite number"},
    {"Infinite", "v 0 0 0\nv 0 0 -inf\n", "x.obj:2:7: v: ", "not a finite number"},
    {"TooLarge", "v 1e39 0 0\n", "x.obj:1:3: v: ", "not a finite number"},
    {"OverflowOfDouble", "v 1e999 0 0\n", "x.obj:1:3: v: ", "not a finite number"},
    {"Hex", "v 0x10 0 0\n", "x.obj:1:3: v: ", "is no number"},
    {"Short", "v 1 2\n", "x.obj:1:6: v: ", "2 of 3"},
    {"IndexZero", "v 0 0 0\nf 1 0 1\n", "x.obj:2:5: f: ", "index 0"},
    {"IndexHigh", "v 0 0 0\nv 1 0 0\nf 1 2 3\n",
     "x.obj:3: f: ", "index 3 is out of range: there are 2 v lines"},
    {"IndexLow", "v 0 0 0\nf 1 1 -2\nv 0 0 0\n",
     "x.obj:2:7: f: ", "index -2 is out of range: there are 1 v lines so far"},
    {"IndexHuge", "v 0 0 0\nf 1 1 4294967297\n", "x.obj:2:7: f: ", "far out of range"},
    {"IndexMinusHuge", "v 0 0 0\nf 1 1 -99999999999999999999\n", "x.obj:2:7: f: ", "far out of range"},
    {"IndexWord", "v 0 0 0\nf 1 1 a\n", "x.obj:2:7: f: ", "'a' is no corner"},
    {"IndexFraction", "v 0 0 0\nf 1 1 1.5\n", "x.obj:2:7: f: ", "'1.5' is no corner"},
    {"CornerParts", "v 0 0 0\nvt 0 0\nvn 0 0 1\nf 1/1/1/1 1 1\n", "x.obj:4:3: f: ", "too many parts"},
    {"CornerNoPosition", "v 0 0 0\nvt 0 0\nf /1 1 1\n", "x.obj:3:3: f: ", "is no corner"},
};
INSTANTIATE_TEST_SUITE_P(All, ObjReaderErrors, ::testing::ValuesIn(kObjErrors),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(ObjReader, Caps) {
  std::string polygon = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 4097; ++i) polygon += " 1";
  EXPECT_TRUE(test::says(error(polygon, ExitCode::limit), "x.obj:4:8195: f: ", {"4096 corners"}));
  std::filesystem::resize_file(files / "x.obj", std::uintmax_t{3} << 30); // sparse
  EXPECT_TRUE(test::says(files.error("x.obj", ExitCode::limit), "x.obj: mesh: "));
  files.write("x.obj", std::string("v 0 0\0 0\n", 9));
  EXPECT_TRUE(test::says(files.error("x.obj"), "x.obj:1:6: mesh: ", {"NUL"}));
}

TEST_F(ObjReader, MaterialTypes) {
  Material m = material("Kd 0.1 0.2 0.3\n");
  EXPECT_EQ(m.name, "x/m");
  EXPECT_EQ(material_type_name(m), "diffuse");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.1f, 0.2f, 0.3f));
  m = material("Kd 0.25\nKs 0 0 0\nillum 2\n");
  EXPECT_EQ(material_type_name(m), "diffuse");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.25f)) << "one number is a grey";
  m = material("Kd 0.5 0.5 0.5\nKs 0.25 0 0.5\nNs 33\nillum 2\n");
  EXPECT_EQ(material_type_name(m), "phong");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.5f));
  EXPECT_EQ(color(m, "specular"), kPlasticSpecular * vec3(0.25f, 0, 0.5f)) << "the highlight of a plastic";
  EXPECT_EQ(number(m, "exponent"), 33);
  EXPECT_TRUE(warnings.back().find("nothing emits light") != std::string::npos && warnings.size() == 1u)
      << warnings[0];
  m = material("Kd 0.01 0.01 0.01\nKs 0.95 0.95 0.95\nNs 1000\nillum 5\n");
  EXPECT_EQ(material_type_name(m), "mirror");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.01f));
  EXPECT_EQ(color(m, "specular"), vec3(0.95f));
  EXPECT_EQ(material_type_name(material("Ks 1 1 1\nillum 3\n")), "mirror");
  for (const char* illum : {"4", "6", "7", "9"}) {
    m = material(std::string("Kd 0.01 0.01 0.01\nKs 0.3 0.3 0.3\nNi 2.5\nd 0\nTf 0.25 1 0.04\nillum ") +
                 illum + "\n");
    EXPECT_EQ(material_type_name(m), "dielectric");
    EXPECT_EQ(number(m, "ior"), 2.5f);
    EXPECT_EQ(m.opacity, 1) << "glass is not invisible";
    EXPECT_LT(glm::length(color(m, "transmittance") - vec3(0.5f, 1, 0.2f)), 1e-6f)
        << "the root, as light crosses twice";
    EXPECT_EQ(color(m, "absorption"), vec3(0));
  }
  EXPECT_EQ(color(material("Ni 1.5\nillum 7\n"), "transmittance"), vec3(1)) << "no Tf";
}

TEST_F(ObjReader, EmissionOpacityAndCorrections) {
  Material m = material("Kd 0 0 0\nKe 17 12 4\n");
  EXPECT_EQ(m.emission, vec3(17, 12, 4));
  EXPECT_TRUE(m.two_sided_emission);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(material("d 0.25\n").opacity, 0.25f);
  EXPECT_EQ(material("Tr 0.25\n").opacity, 0.75f);
  EXPECT_EQ(material("Tr 1\nd 1\n").opacity, 1) << "d counts";
  m = material("Kd 0.486 0.631 0.05\nKs 0.9 0.9 0.9\nNs 40\nillum 3\n");
  EXPECT_LT(glm::length(color(m, "diffuse") - vec3(0.1f, 0.1f, 0.05f)), 1e-6f);
  EXPECT_EQ(warnings[0], "1 x x.mtl:1:1: Kd + Ks is above 1: the diffuse part is reduced to 1 - Ks");
  m = material("Kd 1.5 -1 0.5\n");
  EXPECT_EQ(color(m, "diffuse"), vec3(1, 0, 0.5f));
  EXPECT_EQ(warnings[0], "1 x x.mtl:1:1: Kd is out of range: clamped to [0, 1]");
  EXPECT_EQ(color(material("Ka 1 1 1\nKd 0 0 0\nmap_bump b.png\nnorm n.png\nmap_bump c.png\n"), "diffuse"),
            vec3(0));
  EXPECT_EQ(warnings[0], "2 x x.mtl:4:1: 'map_bump' is ignored");
  EXPECT_EQ(number(material("illum 7\n"), "ior"), 1.5f);
  EXPECT_EQ(warnings[0], "1 x x.mtl:1:1: glass without Ni: 1.5 is taken");
}

TEST_F(ObjReader, Textures) {
  files.write("tex/a b.png", test::tiny_png());
  auto loaded = read(kTriangle, "newmtl m\nmap_Kd -clamp on tex\\a b.png\n");
  const SceneDesc& s = loaded.document.scene;
  ASSERT_EQ(s.textures.size(), 1u);
  EXPECT_EQ(s.textures[0]->image()->texels->width, 2);
  EXPECT_EQ(use_of(s.materials[0]).texture, 0);
  EXPECT_EQ(color(s.materials[0], "diffuse"), vec3(1)) << "without Kd";
  EXPECT_EQ(files.warnings(loaded)[0], "1 x x.mtl:2:1: map_Kd: the option -clamp is ignored");
  EXPECT_EQ(
      color(read(kTriangle, "newmtl m\nKd 0.5 0.5 0.5\nmap_Kd tex/a b.png\n").document.scene.materials[0],
            "diffuse"),
      vec3(0.5f));
  loaded = read(kTriangle, "newmtl m\nmap_Kd none.png\n");
  EXPECT_EQ(use_of(loaded.document.scene.materials[0]).texture, -1);
  EXPECT_EQ(files.warnings(loaded)[0], "1 x x.mtl:2:1: the texture 'none.png' is missing: no texture");
}

TEST_F(ObjReader, SlotsAndLibraries) {
  files.write("second.mtl", "newmtl b\nKd 0 0 1\nnewmtl a\nKd 1 0 0\n");
  auto loaded = read("mtllib x.mtl second.mtl none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl b\nf 1 2 "
                     "3\nusemtl never\n"
                     "usemtl c\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n",
                     "newmtl a\nKd 0 1 0\n");
  const Mesh& mesh = mesh_of(loaded);
  EXPECT_EQ(mesh.slot_names, (std::vector<std::string>{"", "b", "c", "a"}));
  EXPECT_EQ(mesh.material_slots, (std::vector<std::uint32_t>{0, 1, 2, 3, 1}));
  const auto& materials = loaded.document.scene.materials;
  const auto& used = loaded.document.scene.instances[0].materials;
  auto diffuse = [&](std::size_t slot) {
    return color(materials[static_cast<std::size_t>(used[slot])], "diffuse");
  };
  EXPECT_EQ(diffuse(0), vec3(0.5f));
  EXPECT_EQ(diffuse(1), vec3(0, 0, 1));
  EXPECT_EQ(diffuse(2), vec3(0.5f));
  EXPECT_EQ(diffuse(3), vec3(0, 1, 0)) << "the first library's";
  EXPECT_EQ(used[0], used[2]);
  EXPECT_EQ(files.warnings(loaded),
            (std::vector<std::string>{
                "1 x second.mtl:3:1: a material of this name is there already: the first one counts",
                "1 x x.obj:1:1: the material library 'none.mtl' is missing",
                "1 x x.obj: faces without a material: a grey one is used",
                "1 x x.obj: there is no material 'c': a grey one is used",
                "1 x x.obj: nothing emits light: a constant light is added"}));
  files.write("my lib.mtl", "newmtl m\nKd 1 0 0\n");
  EXPECT_EQ(color(read("mtllib my lib.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
                      .document.scene.materials[0],
                  "diffuse"),
            vec3(1, 0, 0));
}

TEST_F(ObjReader, NamesThatAreNoUtf8) {
  auto loaded = read("mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl gr\xfcn\nf 1 2 3\n",
                     "newmtl gr\xfcn\nKd 0 1 0\n");
  EXPECT_EQ(mesh_of(loaded).slot_names[0], "grün");
  EXPECT_EQ(loaded.document.scene.materials[0].name, "x/grün");
  EXPECT_EQ(color(loaded.document.scene.materials[0], "diffuse"), vec3(0, 1, 0));
}

TEST_F(ObjReader, AloneItIsFramedAndLit) {
  auto loaded = read("v 10 20 30\nv 12 20 30\nv 10 24 30\nv 10 20 34\nf 1 2 3\nf 1 3 4\n");
  const Camera& c = loaded.document.scene.camera;
  EXPECT_EQ(c.target, vec3(11, 22, 32));
  vec3 view = glm::normalize(c.target - c.position);
  for (vec3 p : mesh_of(loaded).positions) // within the vertical angle, all around
    EXPECT_LT(std::acos(glm::dot(glm::normalize(p - c.position), view)), 0.5f * c.vertical_fov);
  ASSERT_EQ(loaded.document.scene.lights.size(), 1u);
  EXPECT_EQ(light_type_name(loaded.document.scene.lights[0]), "constant");
}

TEST_F(ObjReader, RealMeshes) {
  std::string folder = CANDELA_SHARED_DATA "/meshes/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  auto nefertiti = read_scene(folder + "nefertiti.obj");
  EXPECT_EQ(mesh_of(nefertiti).triangles.size(), 99938u);
  EXPECT_EQ(mesh_of(nefertiti).positions.size(), 49971u);
  auto spot = read_scene(folder + "spot.obj");
  EXPECT_EQ(mesh_of(spot).triangles.size(), 5856u);
  EXPECT_EQ(mesh_of(spot).uvs.size(), mesh_of(spot).positions.size());
  EXPECT_EQ(document_problem(spot.document), "");
}

} // namespace
} // namespace candela
