// The list of all files that a scene depends on, in every format.

#include "io/files/path_policy.h"
#include "io/images/image_file.h"
#include "io/picture_state.h"
#include "scene/scene_files.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <set>

namespace candela::test {
namespace {

void write_picture(const std::string& path) {
  write_srgb8_image(1, 1, std::vector<std::uint8_t>{255, 0, 0}, path);
}

std::set<std::string> names(const FileStamps& files) {
  std::set<std::string> out;
  for (const auto& [name, stamp] : files) {
    EXPECT_EQ(stamp, file_stamp(name)) << name;
    EXPECT_EQ(stamp.exists, name.find("lost") == std::string::npos) << name;
    out.insert(name);
  }
  return out;
}

class SceneFiles : public testing::Test {
protected:
  ScratchFolder folder;
  std::set<std::string> named(std::initializer_list<const char*> names) const {
    std::set<std::string> out;
    for (const char* name : names) out.insert(canonical_path(folder / name));
    return out;
  }
  void write_mesh() {
    write_text(folder / "kite.obj",
               "mtllib kite.mtl\nmtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    write_text(folder / "kite.mtl", "newmtl a\nKd 1 1 1\nmap_Kd kite.png\n");
    write_picture(folder / "kite.png");
  }
  void write_scene() {
    write_mesh();
    std::string faces;
    for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
      write_linear_image({2, 2, std::vector<vec3>(4, vec3(0.5f))}, folder / (std::string(face) + ".hdr"));
      faces += (faces.empty() ? "\"" : ", \"") + std::string(face) + ".hdr\"";
    }
    write_linear_image({2, 1, std::vector<vec3>(2, vec3(0.5f))}, folder / "sky.exr");
    write_picture(folder / "wood.png");
    write_text(folder / "scene.json",
               R"({"candela": 1, "materials": [{"name": "wood", "diffuse_texture": "wood.png"}],
 "lights": [{"type": "environment", "file": "sky.exr"},
            {"type": "environment", "mapping": "faces", "files": [)" +
                   faces + R"(]}],
 "instances": [{"file": "kite.obj"}, {"shape": "sphere", "material": "wood"}]})");
  }
};

TEST_F(SceneFiles, OfAJsonSceneAreAllThatItNamesAndThatTheyName) {
  write_scene();
  const LoadedScene loaded = read_scene(folder / "scene.json");
  EXPECT_EQ(names(loaded.files),
            named({"scene.json", "kite.obj", "kite.mtl", "lost.mtl", "kite.png", "wood.png", "sky.exr",
                   "px.hdr", "nx.hdr", "py.hdr", "ny.hdr", "pz.hdr", "nz.hdr"}));
  for (const std::string& source : source_files(loaded.document.scene))
    EXPECT_TRUE(loaded.files.contains(source)) << source;
  EXPECT_EQ(source_files(loaded.document.scene),
            named({"kite.obj", "kite.png", "wood.png", "sky.exr", "px.hdr", "nx.hdr", "py.hdr", "ny.hdr",
                   "pz.hdr", "nz.hdr"}));
}

TEST_F(SceneFiles, OfAMeshAreItsLibrariesAndTheirPictures) {
  write_mesh();
  EXPECT_EQ(names(read_scene(folder / "kite.obj").files),
            named({"kite.obj", "kite.mtl", "lost.mtl", "kite.png"}));
}

TEST_F(SceneFiles, OfAJobAreTheJobAndItsScenes) {
  write_mesh();
  write_text(folder / "job.ini", "[IO]\nscene = kite.obj\n");
  EXPECT_EQ(names(read_scene(folder / "job.ini").files),
            named({"job.ini", "kite.obj", "kite.mtl", "lost.mtl", "kite.png"}));
}

TEST_F(SceneFiles, OfAPictureAreItselfAndWhatItsSceneNames) {
  write_scene();
  const LoadedScene scene = read_scene(folder / "scene.json");
  const std::string shot = folder / "shot.exr";
  write_linear_image({1, 1, {vec3(1)}}, shot, picture_state_texts({scene.document, 1, {}}, shot));
  std::set<std::string> expected = names(scene.files);
  expected.erase(canonical_path(folder / "scene.json"));
  expected.insert(canonical_path(shot));
  EXPECT_EQ(names(read_scene(shot).files), expected);
}

TEST_F(SceneFiles, OfACs123SceneAreItsMeshesAndTextures) {
  write_mesh();
  write_picture(folder / "wood.png");
  write_text(folder / "scene.xml", R"(<scenefile>
  <globaldata><diffusecoeff v="1"/></globaldata>
  <object type="tree" name="root">
    <transblock><object type="primitive" name="mesh" filename="kite.obj"/></transblock>
    <transblock><object type="primitive" name="sphere"><texture file="wood.png" u="1" v="1"/></object></transblock>
  </object>
</scenefile>
)");
  EXPECT_EQ(names(read_scene(folder / "scene.xml").files),
            named({"scene.xml", "kite.obj", "kite.mtl", "lost.mtl", "kite.png", "wood.png"}));
}

} // namespace
} // namespace candela::test
