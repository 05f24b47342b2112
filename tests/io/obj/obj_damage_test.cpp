// Errors in an OBJ only affect their own vertex, attribute or face, and are reported with a location.

#include "io/scene_files.h"
#include "support/materials.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {
namespace {

using test::color;

using test::mesh_of;
using test::SceneFiles;

struct ObjDamage : ::testing::Test {
  SceneFiles files;
  LoadedScene loaded;

  const Mesh& read(const std::string& obj) {
    files.write("x.obj", obj);
    loaded = files.read("x.obj");
    return mesh_of(loaded);
  }
  /// Whether there is a warning that begins so.
  bool warned(const std::string& start) {
    return std::ranges::any_of(files.warnings(loaded),
                               [&](const std::string& w) { return w.starts_with(start); });
  }
};

const std::string kQuad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

TEST_F(ObjDamage, EmptyPartsOfCornersAreMissingAttributes) {
  for (const char* face : {"f 1// 2// 3// 4//\n", "f 1/ 2/ 3/ 4/\n", "f 1/1/ 2/1/ 3/1/ 4/1/\n"}) {
    const Mesh& mesh = read(kQuad + "vt 0.5 0.5\nvn 0 0 1\n" + face);
    EXPECT_EQ(mesh.triangles.size(), 2u) << face;
    EXPECT_TRUE(mesh.normals.empty()) << "flat";
    EXPECT_EQ(loaded.warnings.size(), 2u) << "no material, no light, nothing else";
  }
}

TEST_F(ObjDamage, NormalsThatAreNoNumbersAreFlat) {
  const Mesh& mesh =
      read(kQuad + "vn 0 0 1\nvn nan nan nan\nvn 1 2\nvn -1.#IND 0 0\nf 1//1 2//2 3//3 4//4\n");
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(mesh.normals[i], vec3(0));
  EXPECT_TRUE(warned("3 x x.obj:6:1: normals that are no numbers: flat there"));
}

TEST_F(ObjDamage, TextureCoordinatesThatAreNoNumbersAreZero) {
  const Mesh& mesh = read(kQuad + "vt 0.5 0.5\nvt inf 0\nvt x y\nvt\nf 1/1 2/2 3/3 4/4\n");
  EXPECT_EQ(mesh.uvs, (std::vector<vec2>{vec2(0.5f), vec2(0), vec2(0), vec2(0)}));
  EXPECT_TRUE(warned("3 x x.obj:6:1: texture coordinates that are no numbers: 0 there"));
}

TEST_F(ObjDamage, VerticesThatAreNoNumbersCostTheirFaces) {
  const Mesh& mesh = read(kQuad + "v nan 0 0\nv 0 0\nf 1 2 3\nf 1 2 5\nf 1 6 3\nf 1 3 4\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_TRUE(warned("2 x x.obj:5:1: vertices that are no numbers are dropped"));
  EXPECT_TRUE(warned("2 x x.obj:8: faces that use vertices that are not there are dropped"));
}

TEST_F(ObjDamage, IndicesThatMeanNothingCostNoMoreThanTheyMust) {
  const Mesh& mesh =
      read(kQuad + "vt 0.25 0.75\nvn 0 0 1\nf 1/1/1 2/9/0 3/-5/7\nf 1 2 9\nf 1 x 3\nf 1 0 3\nf 1 2 -9\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.uvs, (std::vector<vec2>{vec2(0.25f, 0.75f), vec2(0), vec2(0)}));
  EXPECT_EQ(mesh.normals, (std::vector<vec3>{vec3(0, 0, 1), vec3(0), vec3(0)}));
  EXPECT_TRUE(warned("2 x x.obj:7: texture coordinates that are not there: 0 there"));
  EXPECT_TRUE(warned("2 x x.obj:7: normals that are not there: flat there"));
  EXPECT_TRUE(warned("1 x x.obj:8: faces that use vertices that are not there are dropped"));
  EXPECT_TRUE(warned("3 x x.obj:9:5: faces with a corner that is nowhere are dropped"));
}

TEST_F(ObjDamage, FillerAtTheEndsIsNoText) {
  for (const std::string& end : {std::string(3, '\0'), std::string("\x1a"), std::string("\x1a\0\0", 3)}) {
    EXPECT_EQ(read(fmt::format("{}f 1 2 3\n{}", kQuad, end)).triangles.size(), 1u);
    EXPECT_TRUE(warned("1 x x.obj: " + std::to_string(end.size()) + " bytes at the end that are no text"));
  }
  const std::string mark = "\xef\xbb\xbf";
  EXPECT_EQ(read(mark + kQuad + "f 1 2 3\n" + mark).positions[0], vec3(-1, -1, 0));
  EXPECT_EQ(loaded.warnings.size(), 2u);
}

// UTF-16 as saved by editors on Windows: U+00FC is in the name, U+1F600 takes two units.
TEST_F(ObjDamage, TextInUtf16IsRead) {
  const std::u16string text =
      u"\ufeffv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nusemtl gr\u00fcn\U0001F600\r\nf 1 2 3\r\n";
  for (bool big_endian : {false, true}) {
    std::string bytes;
    for (char16_t c : text) {
      const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
      bytes += {big_endian ? high : low, big_endian ? low : high};
    }
    EXPECT_EQ(read(bytes).slot_names[0], "gr\u00fcn\U0001F600");
  }
}

TEST_F(ObjDamage, DecimalCommasAreRead) {
  EXPECT_EQ(read("v 0,5 0 0\nv 1 0 0\nv 0 1,25 0\nf 1 2 3\n").positions[0], vec3(0.5f, 0, 0));
  EXPECT_TRUE(warned("2 x x.obj:1:1: decimal commas are read as points"));
}

TEST_F(ObjDamage, LinesEndInEveryWay) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string obj;
    for (char c : kQuad + "f 1 2 \\\n3 4\nl 1 2\n") obj += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(read(obj).triangles.size(), 2u);
    EXPECT_TRUE(warned("1 x x.obj:7:1: 'l' is ignored")) << "the continued line counts";
  }
}

TEST_F(ObjDamage, AMissingLibraryIsTheOneOfTheSameName) {
  files.write("x.mtl", "newmtl a\nKd 1 0 0\n");
  read("mtllib exported.mtl\n" + kQuad + "usemtl a\nf 1 2 3\n");
  EXPECT_EQ(color(loaded.document.scene.materials[0], "diffuse"), vec3(1, 0, 0));
  EXPECT_TRUE(warned("1 x x.obj:1:1: the material library 'exported.mtl' is missing"));
  EXPECT_TRUE(warned("1 x x.obj:1:1: the material library of the mesh's own name is taken: 'x.mtl'"));
  read(kQuad + "usemtl a\nf 1 2 3\n");
  EXPECT_EQ(color(loaded.document.scene.materials[0], "diffuse"), vec3(1, 0, 0)) << "none was named";
  files.write("good.mtl", "newmtl b\nKd 0 1 0\n");
  read("mtllib good.mtl\n" + kQuad + "usemtl a\nf 1 2 3\n");
  EXPECT_EQ(color(loaded.document.scene.materials[0], "diffuse"), vec3(0.5f))
      << "but what is named is what is meant";
}

TEST_F(ObjDamage, LibrariesOfOtherMachinesAndBrokenOnes) {
  files.write("My Lib.MTL", "newmtl a\nKd 1 0 0\n");
  for (const char* name : {"C:\\models\\My Lib.MTL", "/home/someone/My Lib.MTL", "my lib.mtl",
                           "\"My Lib.MTL\"", "export/My Lib.MTL"}) {
    read("mtllib " + std::string(name) + "\n" + kQuad + "usemtl a\nf 1 2 3\n");
    EXPECT_EQ(color(loaded.document.scene.materials[0], "diffuse"), vec3(1, 0, 0)) << name;
  }
  files.write("broken.mtl", std::string("newmtl a\0\nKd 1 0 0\n", 18));
  read("mtllib broken.mtl\n" + kQuad + "usemtl a\nf 1 2 3\n");
  EXPECT_TRUE(warned("1 x broken.mtl: the material library is left out: broken.mtl:1:9:"));
  files.write("x.obj", "mtllib ../outside.mtl\n" + kQuad + "f 1 2 3\n");
  EXPECT_TRUE(test::says(files.error("x.obj"), "x.obj:1:1: mtllib: ", {"outside"}));
}

} // namespace
} // namespace candela
