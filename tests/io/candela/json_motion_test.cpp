// Motion in Candela JSON: of objects, meshes and the camera.

#include "io/candela_json_files.h"
#include "scene/motion.h"
#include "support/seed.h"

#include <random>

namespace candela {
namespace {

using test::says;

struct JsonMotion : test::CandelaJson {
  void check_round_trip(const Document& document) {
    write_candela_json(document, files / "out.json");
    const LoadedScene again = files.read("out.json");
    EXPECT_TRUE(same_content(document, again.document)) << test::read_text(files / "out.json");
    EXPECT_EQ(candela_json(again.document, folder_of(files / "out.json")),
              test::read_text(files / "out.json"));
  }
  void write_square(const std::string& name, const std::string& height, const std::string& last_face) {
    files.write(name, "v 0 0 " + height + "\nv 1 0 0\nv 1 1 0\nv 0 1 " + height + "\nf 1 2 3\n" + last_face);
  }
};

TEST_F(JsonMotion, OfObjectsIsRead) {
  const auto scene = read(R"({"candela": 1, "instances": [
    {"shape": "sphere", "motion": {"translate": [1, 2, 3], "axis": [0, 0, 2], "angle": 720, "scale": [1, 2, 1],
     "center": [0.5, 0, 0]}},
    {"shape": "cube"}]})")
                         .document.scene;
  const Motion& m = scene.instances[0].motion;
  EXPECT_EQ(m.translate, vec3(1, 2, 3));
  EXPECT_EQ(m.axis, vec3(0, 0, 2));
  EXPECT_FLOAT_EQ(m.angle, 4 * kPi);
  EXPECT_EQ(m.scale, vec3(1, 2, 1));
  EXPECT_EQ(m.center, vec3(0.5f, 0, 0));
  EXPECT_TRUE(m.any());
  EXPECT_FALSE(scene.instances[1].motion.any());
}

TEST_F(JsonMotion, TheAxisAndTheCentreAreTheObjects) {
  const auto scene = read(R"({"candela": 1, "instances": [{"shape": "cube",
    "transform": [{"scale": 2}, {"rotate": [0, 0, 1, 90]}, {"translate": [5, 0, 0]}],
    "motion": {"axis": [1, 0, 0], "angle": 90, "center": [1, 0, 0]}}]})")
                         .document.scene;
  const MovingTransform placed = placement_of(scene.instances[0]);
  EXPECT_LT(glm::length(placed.axis - glm::dvec3(0, 1, 0)), 1e-6); // x of the cube lies along y
  const glm::dvec4 center(1, 0, 0, 1), other(1, 0, 1, 1);
  EXPECT_LT(glm::length(placed.at(1) * center - glm::dvec4(5, 2, 0, 1)), 1e-6);
  EXPECT_LT(glm::length(placed.at(1) * other - glm::dvec4(7, 2, 0, 1)), 1e-6);
}

TEST_F(JsonMotion, IsWrittenAndReadBackToTheSameBits) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  auto real = [&] { return std::uniform_real_distribution<float>(0.01f, 10)(random); };
  auto vector = [&] {
    const float x = real(), y = real();
    return vec3(x, y, real());
  };
  for (int round = 0; round < 20; ++round) {
    Document d;
    d.scene.materials.resize(1);
    d.scene.instances.push_back(
        {"a", SphereShape{real()}, mat4(1), {0}, {vector(), vector(), real(), vector(), vector()}});
    Mesh mesh;
    mesh.name = std::string("m");
    for (int i = 0; i < 3; ++i) {
      mesh.positions.push_back(vector()), mesh.positions_end.push_back(vector());
      if (round % 2 == 0) continue;
      mesh.normals.push_back(glm::normalize(vector())), mesh.normals_end.push_back(glm::normalize(vector()));
    }
    mesh.triangles = {{0, 1, 2}};
    d.scene.instances.push_back({"b", std::make_shared<const Mesh>(mesh), mat4(1), {0}, {}});
    d.scene.camera.shutter_close = std::min(0.1f * real(), 1.0f);
    d.scene.camera.motion_position = vector(), d.scene.camera.motion_up = vector();
    check_round_trip(d);
  }
}

TEST_F(JsonMotion, MeshesOfTwoFilesDeform) {
  write_square("a.obj", "0", "f 1 3 4\n");
  write_square("b.obj", "2.5", "f 1 3 4\n");
  const auto loaded = read(R"({"candela": 1, "meshes": {"m": {"file": "a.obj", "file_end": "b.obj"}},
                               "instances": [{"mesh": "m"}]})");
  const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(loaded.document.scene.instances[0].shape);
  ASSERT_TRUE(mesh.deforms());
  ASSERT_EQ(mesh.positions_end.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 moved = mesh.positions_end[i] - mesh.positions[i];
    EXPECT_EQ(moved, vec3(0, 0, mesh.positions[i].x == 0 ? 2.5f : 0.0f));
  }
  check_round_trip(loaded.document);
  EXPECT_NE(test::read_text(files / "out.json").find("\"file_end\": \"b.obj\""), std::string::npos);
}

TEST_F(JsonMotion, MeshesOfOtherTrianglesDoNot) {
  write_square("a.obj", "0", "f 1 3 4\n");
  write_square("b.obj", "1", "f 1 3 2\n");
  write_square("c.obj", "1", "");
  const std::string json = R"({"candela": 1, "meshes": {"m": {"file": "a.obj",
"file_end": "%.obj"}}, "instances": [{"mesh": "m"}]})";
  auto with = [&](const std::string& name) { return std::string(json).replace(json.find('%'), 1, name); };
  EXPECT_TRUE(says(error(with("b")), "s.json:2:13: meshes.m.file_end: ", {"its vertices alone may differ"}));
  EXPECT_TRUE(says(error(with("c")), "s.json:2:13: meshes.m.file_end: ", {"its vertices alone may differ"}));
}

TEST_F(JsonMotion, ErrorsAreLocated) {
  auto of_instance = [&](const std::string& motion) {
    return error("{\"candela\": 1, \"instances\": [{\"shape\": \"cube\",\n\"motion\": " + motion + "}]}");
  };
  EXPECT_TRUE(says(of_instance("[]"), "s.json:2:11: instances[0].motion: ", {"give an object"}));
  EXPECT_TRUE(
      says(of_instance("{\"rotate\": 3}"), "s.json:2:12: instances[0].motion: ", {"no key 'rotate'"}));
  EXPECT_TRUE(
      says(of_instance("{\"axis\": [0,0,0]}"), "s.json:2:11: instances[0].motion.axis: ", {"no length"}));
  EXPECT_TRUE(says(of_instance("{\"scale\": [1,0,1]}"), "s.json:2:21: instances[0].motion.scale: "));
  EXPECT_TRUE(says(of_instance("{\"angle\": 1e9}"), "s.json:2:21: instances[0].motion.angle: "));
  auto of_mesh = [&](const std::string& members) {
    return error(
        "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0],[1,0,0],[0,1,0]], \"triangles\": "
        "[[0,1,2]],\n" +
        members + "}}}");
  };
  EXPECT_TRUE(says(of_mesh("\"positions_end\": [[0,0,0]]"),
                   "s.json:2:18: meshes.m.positions_end: ", {"1 elements for 3 positions"}));
  EXPECT_TRUE(says(of_mesh("\"normals_end\": [[0,0,1],[0,0,1],[0,0,1]]"),
                   "s.json:2:16: meshes.m.normals_end: ", {"positions_end"}));
  EXPECT_TRUE(
      says(of_mesh("\"positions_end\": [[0,0,0],[1,0,0],[0,1,0]], \"normals\": [[0,0,1],[0,0,1],[0,0,1]]"),
           "s.json:2:18: meshes.m.normals_end: ", {"0 for 3 normals"}));
  EXPECT_TRUE(
      says(error("{\"candela\": 1,\n\"camera\": {\"position\": [0,0,5], \"motion_position\": [0,0,-5]}}"),
           "s.json:2:11: camera.motion_target: ", {"time 1"}));
  EXPECT_TRUE(says(error("{\"candela\": 1,\n\"camera\": {\"shutter_close\": 2}}"),
                   "s.json:2:29: camera.shutter_close: ", {"from 0 to 1"}));
}

} // namespace
} // namespace candela
