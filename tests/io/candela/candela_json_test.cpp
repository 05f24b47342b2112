#include "io/candela_json_files.h"
#include "support/materials.h"

namespace candela {
namespace {

using test::color;
using test::use_of;

using test::CandelaJson;
using test::mesh_of;

TEST_F(CandelaJson, ReadsEveryPart) {
  files.write("kite.png", test::tiny_png());
  auto loaded = read(R"({
    // comments are allowed
    "candela": 1, "description": "for people", /* and these */
    "instances": [
      {"name": "ball", "shape": "sphere", "radius": 0.5, "material": "red"},
      {"shape": "mesh", "mesh": "kite", "material": "red", "materials": {"b": "lamp"}},
      {"shape": "mesh", "mesh": "kite", "materials": ["lamp", 0]},
      {"shape": "rectangle", "material": 1, "transform": [1,0,0,5, 0,2,0,6, 0,0,3,7, 0,0,0,1]},
      {"shape": "disc"}
    ],
    "meshes": {"kite": {"positions": [[0,0,0],[1,0,0],[0,1,0],[1,1,1]], "triangles": [[0,1,2],[1,3,2]],
                        "normals": [[0,0,2],[0,0,1],[0,0,0],[1,0,0]], "uvs": [[0,0],[1,0],[0,1],[1,1]],
                        "slots": ["a","b"], "material_slots": [0,1]}},
    "materials": [{"name": "red", "type": "phong", "diffuse": [0.5,0.1,0.25], "specular": 0.25,
                   "diffuse_texture": "kite.png"},
                  {"name": "lamp", "emission": [17,12,4], "two_sided_emission": true}],
    "lights": [{"name": "sky", "type": "constant", "color": [1,2,3], "scale": 2},
               {"type": "directional", "direction": [0,-1,0]}],
    "camera": {"position": [0,1,4], "target": [0,1,0], "up": [0,1,0], "vertical_fov": 90, "aperture_radius": 0.5,
               "focus_distance": 3},
    "settings": {"path": {"max_depth": 8, "rr": "off"}, "view": "normal", "film": {"width": 640}}
  })");
  EXPECT_TRUE(loaded.warnings.empty());
  const SceneDesc& s = loaded.document.scene;
  ASSERT_EQ(s.instances.size(), 5u);
  EXPECT_EQ(s.instances[0].name, "ball");
  EXPECT_EQ(std::get<SphereShape>(s.instances[0].shape).radius, 0.5f);
  EXPECT_EQ(s.instances[0].materials, std::vector<int>{0});
  EXPECT_EQ(s.instances[1].materials, (std::vector<int>{0, 1}));
  EXPECT_EQ(s.instances[2].materials, (std::vector<int>{1, 0}));
  EXPECT_EQ(&mesh_of(loaded, 1), &mesh_of(loaded, 2)) << "one mesh for both";
  EXPECT_EQ(transform_point(s.instances[3].world_from_object, vec3(1)), vec3(6, 8, 10));
  EXPECT_EQ(s.instances[4].materials, std::vector<int>{2});
  EXPECT_EQ(s.materials[2].name, "default");

  const Mesh& kite = mesh_of(loaded, 1);
  EXPECT_EQ(kite.name, "kite");
  EXPECT_EQ(kite.normals[0], vec3(0, 0, 1)) << "made unit";
  EXPECT_EQ(kite.normals[2], vec3(0)) << "zero means flat";
  EXPECT_EQ(kite.triangles[1], uvec3(1, 3, 2));
  EXPECT_EQ(kite.uvs[3], vec2(1));
  EXPECT_EQ(kite.material_slots, (std::vector<std::uint32_t>{0, 1}));

  EXPECT_EQ(material_type_name(s.materials[0]), "phong");
  EXPECT_EQ(color(s.materials[0], "diffuse"), vec3(0.5f, 0.1f, 0.25f));
  EXPECT_EQ(color(s.materials[0], "specular"), vec3(0.25f)) << "one number is a grey";
  EXPECT_EQ(use_of(s.materials[0]).texture, 0);
  EXPECT_TRUE(s.materials[1].two_sided_emission);
  ASSERT_EQ(s.textures.size(), 1u);
  EXPECT_EQ(srgb8_texels(*s.textures[0]->image()->texels), (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0}));
  EXPECT_EQ(light_type_name(s.lights[0]), "constant");
  EXPECT_EQ(s.lights[0].color, vec3(1, 2, 3));
  EXPECT_EQ(light_type_name(s.lights[1]), "directional");
  EXPECT_EQ(s.camera.vertical_fov, radians(90.0f));
  EXPECT_EQ(s.camera.aperture_radius, 0.5f);
  EXPECT_EQ(loaded.document.settings.path.max_depth, 8);
  EXPECT_EQ(loaded.document.settings.path.rr, RussianRoulette::off);
  EXPECT_EQ(loaded.document.settings.view, View::normal);
  EXPECT_EQ(loaded.document.settings.film.width, 640);
  EXPECT_EQ(loaded.document.settings.film.height, 512);
  EXPECT_EQ(document_problem(loaded.document), "");
}

TEST_F(CandelaJson, StepsOfATransformApplyInTheirOrder) {
  auto point = [&](const std::string& transform, vec3 p) {
    auto loaded = read(R"({"candela": 1, "instances": [{"shape": "disc", "transform": )" + transform + "}]}");
    return transform_point(loaded.document.scene.instances[0].world_from_object, p);
  };
  EXPECT_EQ(point(R"([{"scale": 2}, {"translate": [1, 0, 0]}])", vec3(1)), vec3(3, 2, 2));
  EXPECT_EQ(point(R"([{"translate": [1, 0, 0]}, {"scale": [2, 3, 4]}])", vec3(1)), vec3(4, 3, 4));
  EXPECT_EQ(point(R"([{"rotate": [0, 0, 2, 90]}])", vec3(1, 0, 5)), vec3(0, 1, 5))
      << "counter-clockwise, exact";
  EXPECT_EQ(point(R"([{"rotate": [1, 0, 0, -90]}])", vec3(0, 0, 1)), vec3(0, 1, 0));
  EXPECT_EQ(point(R"([{"matrix": [1,2,3,4, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])", vec3(1)), vec3(10, 1, 1))
      << "row-major";
  vec3 p = point(R"([{"rotate": [1, 1, 1, 120]}])", vec3(1, 0, 0));
  EXPECT_LT(glm::length(p - vec3(0, 1, 0)), 1e-6f);
  // look_at turns +z to the target and keeps +y in the plane of up.
  EXPECT_EQ(point(R"([{"look_at": {"origin": [1,2,3], "target": [1,2,9], "up": [0,1,0]}}])", vec3(0, 0, 2)),
            vec3(1, 2, 5));
  EXPECT_EQ(point(R"([{"look_at": {"origin": [0,5,0], "target": [0,0,0], "up": [0,0,1]}}])", vec3(0, 0, 1)),
            vec3(0, 4, 0));
  EXPECT_EQ(point(R"([{"look_at": {"origin": [0,5,0], "target": [0,0,0], "up": [0,0,1]}}])", vec3(0, 1, 0)),
            vec3(0, 5, 1));
}

TEST_F(CandelaJson, ImportsTheMaterialsOfAnObj) {
  files.write("m/tree.obj",
              "mtllib tree.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl leaf\nf 1 2 3\nusemtl bark\nf 3 2 1\n");
  files.write("m/tree.mtl", "newmtl leaf\nKd 0 1 0\nmap_Kd t.png\nnewmtl bark\nKd 0.5 0.25 0\n");
  files.write("m/t.png", test::tiny_png());
  auto loaded = read(R"({"candela": 1, "materials": [{"name": "gold"}],
    "instances": [{"file": "m/tree.obj"}, {"file": "m/tree.obj", "materials": {"leaf": "gold"}},
                  {"mesh": "oak"}], "meshes": {"oak": {"file": "m/tree.obj"}}})");
  const SceneDesc& s = loaded.document.scene;
  ASSERT_EQ(s.materials.size(), 5u);
  EXPECT_EQ(s.materials[1].name, "tree/leaf");
  EXPECT_EQ(use_of(s.materials[1]).texture, 0);
  EXPECT_EQ(s.materials[2].name, "tree/bark");
  EXPECT_EQ(s.instances[0].materials, (std::vector<int>{1, 2}));
  EXPECT_EQ(s.instances[1].materials, (std::vector<int>{0, 2}));
  EXPECT_EQ(&mesh_of(loaded, 0), &mesh_of(loaded, 1)) << "a file is read once";
  EXPECT_EQ(mesh_of(loaded, 2).name, "oak");
  EXPECT_EQ(s.materials[3].name, "oak/leaf");
  EXPECT_EQ(s.textures.size(), 1u) << "a texture is read once";
  EXPECT_EQ(
      files.warnings(loaded),
      std::vector<std::string>{"1 x s.json: nothing in the scene emits light: the picture will be black"});
}

TEST_F(CandelaJson, TakesAByteOrderMarkAndWindowsLineEnds) {
  auto loaded = read("\xef\xbb\xbf{\r\n\"candela\": 1,\r\n\"lights\": [{}]\r\n}\r\n");
  EXPECT_EQ(loaded.document.scene.lights.size(), 1u);
  EXPECT_TRUE(test::says(error("\xef\xbb\xbf{\"x\": 1}"), "s.json:1:2: scene: "));
}

TEST_F(CandelaJson, ReadsBookmarksAndRefusesOddOnes) {
  const auto loaded = read(R"({"candela": 1, "camera": {"vertical_fov": 30}, "bookmarks": [
    {"name": "plan", "camera": {"position": [0,9,0], "target": [0,0,0], "up": [0,0,-1], "projection": "orthographic",
                                "orthographic_height": 12}},
    {"name": "as it is", "camera": {}}, {"name": "no camera"}]})");
  const auto& bookmarks = loaded.document.scene.bookmarks;
  ASSERT_EQ(bookmarks.size(), 3u);
  EXPECT_EQ(bookmarks[0].name, "plan");
  EXPECT_EQ(bookmarks[0].camera.projection, Projection::orthographic);
  EXPECT_EQ(bookmarks[0].camera.orthographic_height, 12);
  EXPECT_EQ(bookmarks[1].camera, Camera{});
  EXPECT_EQ(loaded.document.scene.camera.vertical_fov, radians(30.0f));

  auto refused = [&](const std::string& bookmarks_json) {
    return error("{\"candela\": 1,\n\"bookmarks\": " + bookmarks_json + "}");
  };
  EXPECT_TRUE(test::says(refused("{}"), "s.json:2:14: bookmarks: "));
  EXPECT_TRUE(test::says(refused("[{}]"), "s.json:2:15: bookmarks[0]: ", {"the key \"name\" is missing"}));
  EXPECT_TRUE(test::says(refused(R"([{"name": ""}])"), "s.json:2:24: bookmarks[0].name: ", {"it is empty"}));
  EXPECT_TRUE(test::says(refused(R"([{"name": "a"}, {"name": "a"}])"),
                         "s.json:2:39: bookmarks[1].name: ", {"there is another bookmark 'a'"}));
  EXPECT_TRUE(test::says(refused(R"([{"name": "a", "camara": {}}])"),
                         "s.json:2:29: bookmarks[0]: ", {"did you mean 'camera'?"}));
  EXPECT_TRUE(test::says(refused(R"([{"name": "a", "camera": {"blades": 17}}])"),
                         "s.json:2:50: bookmarks[0].camera.blades: "));
  EXPECT_TRUE(test::says(refused(R"([{"name": "a", "camera": {"position": [1,1,1], "target": [1,1,1]}}])"),
                         "s.json:2:39: bookmarks[0].camera: ", {"position and target are the same"}));
  std::string many = "[";
  for (int i = 0; i <= 10000; ++i)
    many += (i > 0 ? ",{" : "{") + std::string("\"name\": \"") + std::to_string(i) + "\"}";
  EXPECT_TRUE(test::says(error("{\"candela\": 1, \"bookmarks\": " + many + "]}", ExitCode::limit),
                         "s.json:1:29: bookmarks: ", {"keep at most 10000"}));
}

TEST_F(CandelaJson, IgnoresALightsValuesOfOtherTypesWithAWarning) {
  auto loaded =
      read(R"({"candela": 1, "lights": [{"type": "constant", "color": 2, "position": [1, 2, 3]}]})");
  EXPECT_EQ(loaded.document.scene.lights.at(0), (LightDesc{"", ConstantLightModel{}, vec3(2)}));
  EXPECT_EQ(files.warnings(loaded)[0],
            "1 x s.json:1:60: lights[0].position: a light of the type constant has no such value");
}

} // namespace
} // namespace candela
