// The files that a scene may name: those of its folder's tree, others only if allowed.

#include "io/scene_files.h"
#include "support/materials.h"

namespace candela {
namespace {

using test::color;

namespace fs = std::filesystem;
using test::SceneFiles;

constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

struct PathPolicyOfScenes : ::testing::Test {
  SceneFiles files;

  PathPolicyOfScenes() {
    files.write("inside/m.obj", kObj);
    files.write("inside/deep/m.obj", kObj);
    files.write("outside.obj", kObj);
    files.write("inside2/m.obj", kObj);
  }
  void scene(const std::string& file, const std::string& name = "inside/s.json") {
    files.write(name, "{\"candela\": 1, \"instances\": [{\"file\": \"" + file + "\"}]}");
  }
  void expect_refused(const std::string& file, const std::string& name = "inside/s.json") {
    scene(file, name);
    EXPECT_TRUE(test::says(files.error(name), name + ":1:39: instances[0].file: ", {"--allow-outside"}))
        << file;
  }
  void expect_allowed_outside(const std::string& file, const std::string& name = "inside/s.json") {
    expect_refused(file, name);
    EXPECT_EQ(files.read(name, {.allow_outside = true}).document.scene.instances.size(), 1u) << file;
  }
  void expect_read(const std::string& file, const std::string& name = "inside/s.json") {
    scene(file, name);
    EXPECT_EQ(files.read(name).document.scene.instances.size(), 1u) << file;
  }
};

TEST_F(PathPolicyOfScenes, FilesInTheTree) {
  expect_read("m.obj");
  expect_read("./deep/../m.obj");
  expect_read("deep/m.obj");
  expect_read("deep\\\\m.obj"); // a Windows path, escaped in JSON
}

TEST_F(PathPolicyOfScenes, FilesOutside) {
  expect_allowed_outside("../outside.obj");
  expect_allowed_outside("deep/../../outside.obj");
  expect_allowed_outside("../inside2/m.obj");
  expect_allowed_outside(files / "outside.obj");
  expect_allowed_outside(files / "inside/m.obj"); // absolute, wherever it leads
  expect_refused("../nowhere.obj");
  expect_refused("/dev/zero");
}

TEST_F(PathPolicyOfScenes, SymbolicLinksAreFollowed) {
  fs::create_symlink(files / "outside.obj", files / "inside/link.obj");
  expect_allowed_outside("link.obj");
  fs::create_directory_symlink(files.path(), files / "inside/up");
  expect_allowed_outside("up/outside.obj");
  expect_read("up/inside/m.obj"); // out and in again
  fs::create_symlink("deep/m.obj", files / "inside/near.obj");
  expect_read("near.obj");
  fs::create_symlink("loop.obj", files / "inside/loop.obj");
  scene("loop.obj");
  EXPECT_TRUE(test::says(files.error("inside/s.json"), "inside/s.json:1:39: instances[0].file: "));
  // The scene itself may be reached by a link: the user named it.
  fs::create_directory_symlink(files / "inside", files / "alias");
  expect_read("m.obj", "alias/s.json");
}

TEST_F(PathPolicyOfScenes, NoFilesAtAll) {
  for (const char* name : {"", "deep", ".", "none.obj", "m.obj/x.obj"}) {
    scene(name);
    EXPECT_TRUE(test::says(files.error("inside/s.json"), "inside/s.json:1:39: instances[0].file: ")) << name;
  }
  scene("\\u0000");
  EXPECT_TRUE(
      test::says(files.error("inside/s.json"), "inside/s.json:1:39: instances[0].file: ", {"no file name"}));
  scene(std::string(5000, 'x'));
  EXPECT_TRUE(
      test::says(files.error("inside/s.json"), "inside/s.json:1:39: instances[0].file: ", {"no file name"}));
}

TEST_F(PathPolicyOfScenes, HoldsForMtlAndTexturesToo) {
  files.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
  files.write("secret.png", test::tiny_png());
  files.write("inside/a.obj", std::string("mtllib ../secret.mtl\nusemtl m\n") + kObj);
  scene("a.obj");
  EXPECT_TRUE(test::says(files.error("inside/s.json"), "inside/a.obj:1:1: mtllib: ", {"--allow-outside"}));
  EXPECT_EQ(
      color(files.read("inside/s.json", {.allow_outside = true}).document.scene.materials[0], "diffuse"),
      vec3(1, 0, 0));
  files.write("inside/b.mtl", "newmtl m\nmap_Kd ../secret.png\n");
  files.write("inside/b.obj", std::string("mtllib b.mtl\nusemtl m\n") + kObj);
  scene("b.obj");
  EXPECT_TRUE(test::says(files.error("inside/s.json"), "inside/b.mtl:2:1: map_Kd: ", {"--allow-outside"}));
  EXPECT_EQ(files.read("inside/s.json", {.allow_outside = true}).document.scene.textures.size(), 1u);
  // Above the mesh, but below the scene.
  files.write("inside/deep/c.obj", std::string("mtllib ../b2.mtl\nusemtl m\n") + kObj);
  files.write("inside/b2.mtl", "newmtl m\nKd 0 1 0\n");
  scene("deep/c.obj");
  EXPECT_EQ(color(files.read("inside/s.json").document.scene.materials[0], "diffuse"), vec3(0, 1, 0));
}

TEST_F(PathPolicyOfScenes, HoldsForCs123) {
  files.write("inside/s.xml", "<scenefile><object type='tree' name='root'><transblock>\n"
                              "<object type='primitive' name='mesh' filename='../outside.obj'/>\n"
                              "</transblock></object></scenefile>");
  EXPECT_TRUE(test::says(files.error("inside/s.xml"), "inside/s.xml:2:38: filename: ", {"--allow-outside"}));
  EXPECT_EQ(files.read("inside/s.xml", {.allow_outside = true}).document.scene.instances.size(), 1u);
}

TEST_F(PathPolicyOfScenes, ReadsNoPipes) {
  ASSERT_EQ(std::system(("mkfifo " + files / "inside/pipe.obj").c_str()), 0);
  scene("pipe.obj");
  EXPECT_TRUE(test::says(files.error("inside/s.json"), "inside/s.json:1:39: instances[0].file: "));
}

} // namespace
} // namespace candela
