// Materials of CS123 scenes, from MTL files and from objects.

#include "io/cs123/cs123_files.h"

namespace candela {
namespace {

using test::color;
using test::Cs123Reader;
using test::number;
using test::use_of;

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
  EXPECT_EQ(clear.warnings.size(), 1u) << "that nothing emits light";
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

} // namespace
} // namespace candela
