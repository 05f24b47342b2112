#pragma once
// Scenes of the CS123 format, and the result of reading them.

#include "io/scene_files.h"
#include "support/materials.h"

namespace candela::test {

/// Two triangles with the materials a and b; the MTL file has only a.
inline constexpr const char* kCs123Obj =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n";

struct Cs123Reader : ::testing::Test {
  SceneFiles files;

  Cs123Reader() {
    files.write("m/m.obj", kCs123Obj);
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
  /// A scene of one sphere with transformations.
  static std::string root(const std::string& transblock) {
    return "<object type=\"tree\" name=\"root\"><transblock>" + transblock + "</transblock></object>";
  }
  static std::string sphere(const std::string& transformations) {
    return root(transformations + "<object type=\"primitive\" name=\"sphere\"/>");
  }
  /// The transformed point of a primitive, whose axis is y; that of our shapes is z.
  vec3 transformed(const std::string& transformations, vec3 p) {
    return transform_point(read(sphere(transformations)).document.scene.instances.at(0).world_from_object,
                           {p.x, -p.z, p.y});
  }
  Material own(const std::string& inside, const std::string& before = "") {
    return read(before + root("<object type=\"primitive\" name=\"sphere\">" + inside + "</object>"))
        .document.scene.materials.at(0);
  }
};

} // namespace candela::test
