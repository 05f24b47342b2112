// MTL as written by various programs.

#include "io/obj/map_statement.h"
#include "io/scene_files.h"
#include "support/materials.h"

#include <algorithm>

namespace candela {
namespace {

using test::color;
using test::number;
using test::use_of;

using test::SceneFiles;

struct MtlReader : ::testing::Test {
  SceneFiles files;
  LoadedScene loaded;

  /// The material "m" of the library.
  const Material& material(const std::string& statements) {
    files.write("x.mtl", "newmtl m\n" + statements);
    files.write("x.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    loaded = files.read("x.obj");
    return loaded.document.scene.materials.at(0);
  }
  bool warned(const std::string& start) {
    return std::ranges::any_of(files.warnings(loaded),
                               [&](const std::string& w) { return w.starts_with(start); });
  }
};

struct MapCase {
  const char* words;
  const char* file;
  vec2 scale, offset;
};
class MapStatements : public ::testing::TestWithParam<MapCase> {};
TEST_P(MapStatements, AreRead) {
  const MapStatement m = read_map_statement(GetParam().words);
  EXPECT_EQ(m.file, GetParam().file);
  EXPECT_EQ(m.scale, GetParam().scale);
  EXPECT_EQ(m.offset, GetParam().offset);
}
INSTANTIATE_TEST_SUITE_P(
    All, MapStatements,
    ::testing::Values(MapCase{" a b.png ", "a b.png", vec2(1), vec2(0)}, MapCase{"", "", vec2(1), vec2(0)},
                      MapCase{"-s 2 3 1 -o 0.5 0.25 0 t.png", "t.png", vec2(2, 3), vec2(0.5f, 0.25f)},
                      MapCase{"-o .5 .5 -s 2 2 tex.png", "tex.png", vec2(2), vec2(0.5f)},
                      MapCase{"-s 2 t.png", "t.png", vec2(2, 1), vec2(0)},
                      MapCase{"-s 2 2 1 3", "3", vec2(2), vec2(0)},
                      MapCase{"-s 2 3", "3", vec2(2, 1), vec2(0)},
                      MapCase{
                          "-blendu off -blendv on -bm 0.3 -boost 2 -cc on -clamp on -imfchan l -mm 0 1 -t 1 "
                          "-texres 512 -type sphere wood grain.png",
                          "wood grain.png", vec2(1), vec2(0)},
                      MapCase{"-mm 0.1 0.9 1.png", "1.png", vec2(1), vec2(0)},
                      MapCase{"-strange name.png", "-strange name.png", vec2(1), vec2(0)},
                      MapCase{"-clamp on", "", vec2(1), vec2(0)}));

TEST_F(MtlReader, ScaleAndOffsetOfMapsReachTheMaterial) {
  files.write("t.png", test::tiny_png());
  const Material& m = material("map_Kd -s 2 3 1 -o 0.5 0.25 0 t.png\n");
  EXPECT_EQ(use_of(m).texture, 0);
  EXPECT_EQ(use_of(m).uv, (UvTransform{vec2(2, 3), vec2(0.5f, 0.25f)}));
  EXPECT_EQ(loaded.warnings.size(), 1u) << "no light, nothing else";
}

TEST_F(MtlReader, ContinuedLinesAreJoined) {
  EXPECT_EQ(color(material("Kd 1 \\\n0 0.5\nKe 1 2 3\n"), "diffuse"), vec3(1, 0, 0.5f));
  EXPECT_EQ(color(material("Kd 1 \\\r\n0 0.5\r\nNonsense\r\n"), "diffuse"), vec3(1, 0, 0.5f));
  EXPECT_TRUE(warned("1 x x.mtl:4:1: 'Nonsense' is ignored"));
}

TEST_F(MtlReader, StatementsThatDoNotFitAreIgnoredAlone) {
  const struct {
    const char* statement;
    const char* warning;
  } kCases[] = {{"Kd", "'Kd' is ignored: a number is missing"},
                {"Kd 1 1", "'Kd' is ignored: a number is missing"},
                {"Kd 1 a 1", "'Kd' is ignored: 'a' is no number"},
                {"Kd spectral x.rfl", "'Kd' is ignored: colours are read as r g b, not spectral"},
                {"Ns nan", "'Ns' is ignored: 'nan' is not a finite number"},
                {"Ni", "'Ni' is ignored: a number is missing"},
                {"illum 999999999999", "'illum' is ignored: there is no illumination model"},
                {"map_Kd", "'map_Kd' is ignored: it names no file"},
                {"map_Kd -s 1 1 1", "the texture '1' is missing"}};
  for (const auto& c : kCases) {
    EXPECT_EQ(color(material(std::string("Kd 0.25 0.5 0.75\n") + c.statement + "\n"), "diffuse"),
              vec3(0.25f, 0.5f, 0.75f));
    EXPECT_TRUE(warned(std::string("1 x x.mtl:3:1: ") + c.warning)) << c.statement;
  }
  files.write("y.mtl", "Kd 1 1 1\nnewmtl\nKd 1 0 0\nnewmtl m\nKd 0 1 0\n");
  files.write("y.obj", "mtllib y.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
  loaded = files.read("y.obj");
  EXPECT_EQ(color(loaded.document.scene.materials[0], "diffuse"), vec3(0, 1, 0));
  EXPECT_TRUE(warned("1 x y.mtl:1:1: 'Kd' is ignored: it stands before the first newmtl"));
  EXPECT_TRUE(warned("1 x y.mtl:2:1: newmtl without a name"));
}

TEST_F(MtlReader, AMapOfNsMultipliesTheExponent) {
  files.write("t.png", test::tiny_png());
  const std::string map = "map_Ns -s 2 3 t.png\n";
  const Material& phong = material("Kd 0.5 0.5 0.5\nKs 1 1 1\nNs 250\n" + map);
  for (const std::string& w : files.warnings(loaded)) EXPECT_EQ(w.find("map_Ns"), std::string::npos) << w;
  EXPECT_EQ(number(phong, "exponent"), 250);
  EXPECT_EQ(use_of(phong, "exponent").texture, 0);
  EXPECT_EQ(use_of(phong, "exponent").uv.scale, vec2(2, 3));
  EXPECT_EQ(use_of(phong, "exponent").color_space, ColorSpace::linear) << "a number is not encoded";
  EXPECT_EQ(number(material("Ks 1 1 1\n" + map), "exponent"), 1) << "where it is missing";
  EXPECT_EQ(number(material("Ks 1 1 1\nNs 0\n" + map), "exponent"), 1);
  EXPECT_TRUE(warned("1 x x.mtl:1:1: Ns is 0 beside map_Ns: it is taken for 1"));
  // Matte, a mirror, glass: nothing that could have it.
  for (const char* other : {"Kd 1 1 1\n", "illum 3\nKs 1 1 1\n", "illum 7\nNi 1.5\n"}) {
    EXPECT_FALSE(is_textured(material(other + map))) << other;
    EXPECT_TRUE(loaded.document.scene.textures.empty()) << other;
    const std::string line = other[0] == 'K' ? "3" : "4";
    EXPECT_TRUE(warned("1 x x.mtl:" + line +
                       ":1: 'map_Ns' is ignored: the material has no highlight with an exponent"))
        << other;
  }
}

// Kd .8, Ks .5, Ns 250 is Blender's output for its default material.
TEST_F(MtlReader, KsBesideKdIsTheHighlightOfAPlastic) {
  Material m =
      material("Ns 250\nKa 1 1 1\nKd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\nKe 0 0 0\nNi 1.45\nd 1\nillum 2\n");
  EXPECT_EQ(material_type_name(m), "phong");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.8f));
  EXPECT_FLOAT_EQ(color(m, "specular").x, 0.04f);
  EXPECT_EQ(number(m, "exponent"), 250);
  m = material("Kd 0.6 0.6 0.6\nKs 1 1 1\nNs 0\nillum 2\n");
  EXPECT_EQ(color(m, "diffuse"), vec3(0.6f));
  m = material("Kd 1 1 1\nKs 1 1 1\nNs 10\n");
  EXPECT_LE(color(m, "diffuse").x + color(m, "specular").x, 1) << "but no surface reflects more than it gets";
  EXPECT_TRUE(warned("1 x x.mtl:1:1: Kd leaves no room for the highlight"));
  m = material("Kd 0 0 0\nKs 0.9 0.7 0.3\nNs 100\nillum 2\n");
  EXPECT_EQ(color(m, "specular"), vec3(0.9f, 0.7f, 0.3f)) << "a metal";
  EXPECT_EQ(material_type_name(material("Kd 0.5 0.5 0.5\nKs 1 1 1\nillum 1\n")), "diffuse") << "no highlight";
}

TEST_F(MtlReader, TexturesThatCannotBeReadAreLeftOut) {
  const std::string png = test::tiny_png();
  const std::pair<const char*, std::string> kFiles[] = {{"t.tif", "II*"},
                                                        {"empty.png", ""},
                                                        {"cut.png", png.substr(0, 40)},
                                                        {"zero.ppm", "P6 0 0 255\n"},
                                                        {"large.ppm", "P6 70000 70000 255\n"},
                                                        {"text.jpg", "no picture"}};
  for (const auto& [name, bytes] : kFiles) {
    files.write(name, bytes);
    const Material& m = material(std::string("Kd 1 0 0\nmap_Kd ") + name + "\n");
    EXPECT_EQ(use_of(m).texture, -1) << name;
    EXPECT_EQ(color(m, "diffuse"), vec3(1, 0, 0));
    EXPECT_TRUE(warned("1 x x.mtl:3:1: no texture: ")) << name;
  }
}

TEST_F(MtlReader, PathsOfOtherMachinesMeanTheFileBeside) {
  files.write("tex 1.png", test::tiny_png());
  for (const char* name : {"/home/user/project/tex 1.png", "C:\\Users\\me\\tex 1.png", "D:/maps/tex 1.png",
                           "\\\\server\\maps\\tex 1.png", "textures/tex 1.png", "TEX 1.PNG"}) {
    EXPECT_EQ(use_of(material(std::string("map_Kd ") + name + "\n")).texture, 0) << name;
    EXPECT_TRUE(
        warned("1 x x.mtl:2:1: map_Kd: '" + std::string(name) + "' is not there: 'tex 1.png' is taken"));
  }
  const std::string inside = files / "tex 1.png";
  EXPECT_EQ(use_of(material("map_Kd " + inside + "\n")).texture, 0) << "absolute, but in the tree";
  EXPECT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(use_of(material("map_Kd \"tex 1.png\"\n")).texture, 0);
  EXPECT_EQ(use_of(material("map_Kd /etc/passwd\n")).texture, -1) << "nothing outside the tree";
  EXPECT_TRUE(warned("1 x x.mtl:2:1: the texture '/etc/passwd' is missing"));
  files.write("x.mtl", "newmtl m\nmap_Kd ../tex.png\n");
  EXPECT_TRUE(test::says(files.error("x.obj"), "x.mtl:2:1: map_Kd: ", {"outside"}));
}

TEST_F(MtlReader, ABlackKdDoesNotHideItsTexture) {
  files.write("t.png", test::tiny_png());
  EXPECT_EQ(color(material("Kd 0 0 0\nmap_Kd t.png\n"), "diffuse"), vec3(1));
  EXPECT_TRUE(warned("1 x x.mtl:1:1: Kd is black although there is a map_Kd"));
}

TEST_F(MtlReader, HowTfWasReadIsTold) {
  EXPECT_EQ(color(material("Tf 1 1 1\nNi 1.5\nillum 7\n"), "transmittance"), vec3(1));
  EXPECT_EQ(loaded.warnings.size(), 1u);
  material("Tf 0.25 1 1\nNi 1.5\nillum 7\n");
  EXPECT_TRUE(warned("1 x x.mtl:1:1: material 'm': Tf 0.25 1 1 is read as transmittance of the whole body"));
}

} // namespace
} // namespace candela
