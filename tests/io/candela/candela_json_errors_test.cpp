// Invalid Candela JSON, and the locations of the errors.

#include "io/candela_json_files.h"

namespace candela {
namespace {

using test::CandelaJson;

struct JsonError {
  const char* name;
  const char* json;
  const char* start; ///< of the message: place and element
  const char* part;  ///< of its cause or remedy
};

class CandelaJsonErrors : public CandelaJson, public ::testing::WithParamInterface<JsonError> {};

TEST_P(CandelaJsonErrors, AreLocated) {
  const JsonError& e = GetParam();
  EXPECT_TRUE(test::says(error(e.json), e.start, {e.part}));
}

const JsonError kJsonErrors[] = {
    {"Empty", "", "s.json:1:1: JSON: ", "unexpected end of input"},
    {"Truncated", "{\"candela\": 1,\n \"lights\": [", "s.json:2:13: JSON: ", "unexpected end of input"},
    {"MissingComma", "{\"candela\": 1\n  \"lights\": []}", "s.json:2:3: JSON: ", "unexpected string literal"},
    {"MaterialInItself",
     "{\"candela\": 1, \"materials\": [{\"name\": \"a\", \"type\": \"blend\", \"first\": \"b\"},\n"
     "{\"name\": \"b\", \"type\": \"two_sided\", \"back\": \"a\"}]}",
     "s.json:2:44: materials[1].back: ", "a -> b -> a"},
    {"NoSuchMaterial",
     "{\"candela\": 1, \"materials\": [{\"name\": \"steel\"},\n"
     "{\"name\": \"b\", \"type\": \"two_sided\", \"back\": \"steal\"}]}",
     "s.json:2:44: materials[1].back: ", "steel"},
    {"InvisiblePart",
     "{\"candela\": 1, \"materials\": [{\"name\": \"air\", \"type\": \"null\"},\n"
     "{\"name\": \"b\", \"type\": \"two_sided\", \"back\": \"air\"}]}",
     "s.json:2:44: materials[1].back: ", "'air' is invisible"},
    {"NoSuchMedium",
     "{\"candela\": 1, \"media\": [{\"name\": \"fog\"}],\n \"materials\": [{\"medium\": \"frog\"}]}",
     "s.json:2:16: materials[0].medium: ", "did you mean 'fog'?"},
    {"NoSuchWorld", "{\"candela\": 1,\n \"medium\": \"fog\"}",
     "s.json:2:12: medium: ", "there is no medium 'fog'"},
    {"MediumWithoutName", "{\"candela\": 1,\n \"media\": [{}]}", "s.json:2:12: media[0]: ", "is empty"},
    {"AlbedoOverOne", "{\"candela\": 1,\n \"media\": [{\"name\": \"a\", \"albedo\": 2}]}",
     "s.json:2:36: media[0].albedo: ", "from 0 to 1"},
    {"NoSuchPhase", "{\"candela\": 1,\n \"media\": [{\"name\": \"a\", \"phase\": {\"type\": \"mie\"}}]}",
     "s.json:2:44: media[0].phase.type: ", "rayleigh"},
    {"GOfAnotherPhase", "{\"candela\": 1,\n \"media\": [{\"name\": \"a\", \"phase\": {\"g\": 0.5}}]}",
     "s.json:2:36: media[0].phase: ", "there is no key 'g'"},
    {"DoubleComma", "{\"candela\": 1,\n \"lights\": [1,, 2]}", "s.json:2:15: JSON: ", "unexpected ','"},
    {"LeadingComma", "{,}", "s.json:1:2: JSON: ", "unexpected ','"},
    {"MissingValue", "{\"candela\": }", "s.json:1:13: JSON: ", "unexpected '}'"},
    {"WrongLiteral", "{\"candela\": 1, \"camera\": nul}", "s.json:1:26: JSON: ", "invalid literal"},
    {"NotANumber", "{\"candela\": 1, \"camera\": NaN}", "s.json:1:26: JSON: ", "invalid literal"},
    {"TooLargeNumber", "{\"candela\": 1, \"camera\":\n 1e999}", "s.json:2:2: JSON: ", "too large"},
    {"OpenString", "{\"candela", "s.json:1:2: JSON: ", "missing closing quote"},
    {"OpenComment", "{ /* x", "s.json:1:3: JSON: ", "comment"},
    {"TrailingText", "{\"candela\": 1} x", "s.json:1:16: JSON: ", "invalid literal"},
    {"AfterComment", "{\"candela\": 1, // , : x\n /* , */ 7}", "s.json:2:10: JSON: ", "unexpected number"},
    {"NoObject", "[1]", "s.json:1:1: scene: ", "give an object"},
    {"NoVersion", "{\"lights\": []}", "s.json:1:1: scene: ", "\"candela\": 1"},
    {"LaterVersion", "{\"candela\": 2}", "s.json:1:13: candela: ", "integer from 1 to 1"},
    {"UnknownKey", "{\"candela\": 1,\n  \"ligts\": []}", "s.json:2:3: scene: ", "did you mean 'lights'?"},
    {"DuplicateKey", "{\"candela\": 1,\n \"candela\": 1}", "s.json:2:2: key 'candela': ", "second time"},
    {"DuplicateInside", "{\"candela\": 1, \"camera\": {\"up\": [0,1,0], \"up\": [0,1,0]}}",
     "s.json:1:42: key 'up': ", "second"},
    {"NumericDescription", "{\"candela\": 1, \"description\": 5}",
     "s.json:1:31: description: ", "give a string"},
    {"CameraType", "{\"candela\": 1, \"camera\": []}", "s.json:1:26: camera: ", "give an object"},
    {"CameraKey", "{\"candela\": 1, \"camera\": {\"fov\": 3}}", "s.json:1:27: camera: ", "no key 'fov'"},
    {"FovRange", "{\"candela\": 1, \"camera\": {\"vertical_fov\": 180}}",
     "s.json:1:43: camera.vertical_fov: ", "from 0.1 to 179"},
    {"PointLength", "{\"candela\": 1, \"camera\": {\"up\": [0,1]}}",
     "s.json:1:33: camera.up: ", "give [x, y, z]"},
    {"PointGrey", "{\"candela\": 1, \"camera\": {\"up\": 1}}", "s.json:1:33: camera.up: ", "give [x, y, z]"},
    {"PointOverflow", "{\"candela\": 1, \"camera\": {\"up\": [0, 1e39, 0]}}",
     "s.json:1:33: camera.up: ", "does not fit"},
    {"CameraNowhere", "{\"candela\": 1, \"camera\": {\"position\": [0,0,0]}}",
     "s.json:1:26: camera: ", "the same"},
    {"CameraUp", "{\"candela\": 1, \"camera\": {\"up\": [0,0,3]}}", "s.json:1:26: camera: ", "parallel"},
    {"SettingKey", "{\"candela\": 1, \"settings\": {\"path\": {\"maxdepth\": 3}}}",
     "s.json:1:38: settings.path: ", "did you mean 'max_depth'?"},
    {"SettingGroup", "{\"candela\": 1, \"settings\": {\"pth\": {}}}",
     "s.json:1:29: settings: ", "did you mean 'path'?"},
    {"SettingGroupType", "{\"candela\": 1, \"settings\": {\"path\": 1}}",
     "s.json:1:37: settings.path: ", "give an object"},
    {"SettingCamera", "{\"candela\": 1, \"settings\": {\"camera\": {}}}",
     "s.json:1:29: settings: ", "beside \"settings\""},
    {"SettingChoice", "{\"candela\": 1, \"settings\": {\"view\": \"nomal\"}}",
     "s.json:1:37: settings.view: ", "radiance, albedo, normal"},
    {"SettingFraction", "{\"candela\": 1, \"settings\": {\"film\": {\"width\": 1.5}}}",
     "s.json:1:47: settings.film.width: ", "an integer"},
    {"MaterialKey", "{\"candela\": 1, \"materials\": [{}, {\"roughnes\": 1}]}",
     "s.json:1:35: materials[1]: ", "did you mean 'roughness'?"},
    {"MaterialRange", "{\"candela\": 1, \"materials\": [{\"diffuse\": [0, 0, 1.5]}]}",
     "s.json:1:42: materials[0].diffuse: ", "from 0 to 1"},
    {"MaterialType", "{\"candela\": 1, \"materials\": [{\"type\": 3}]}",
     "s.json:1:39: materials[0].type: ", "one of diffuse"},
    {"MaterialBool", "{\"candela\": 1, \"materials\": [{\"two_sided_emission\": 1}]}",
     "s.json:1:53: materials[0].two_sided_emission: ", "true or false"},
    {"MaterialNoObject", "{\"candela\": 1, \"materials\": [7]}",
     "s.json:1:30: materials[0]: ", "give an object"},
    {"TextureMissing", "{\"candela\": 1, \"materials\": [{\"diffuse_texture\": \"no.png\"}]}",
     "s.json:1:50: materials[0].diffuse_texture: ", "no file 'no.png'"},
    {"TextureIndex", "{\"candela\": 1, \"materials\": [{\"diffuse_texture\": 0}]}",
     "s.json:1:50: materials[0].diffuse_texture: ", "integer from 0 to -1"},
    {"TextureCount", "{\"candela\": 1, \"textures\": [{\"width\": 1, \"height\": 1, \"srgb\": [1, 2]}]}",
     "s.json:1:63: textures[0]: ", "3 width height"},
    {"TextureByte", "{\"candela\": 1, \"textures\": [{\"width\": 1, \"height\": 1, \"srgb\": [1, 2, 256]}]}",
     "s.json:1:70: textures[0].srgb: ", "from 0 to 255"},
    {"LightKey", "{\"candela\": 1, \"lights\": [{\"colour\": 1}]}",
     "s.json:1:28: lights[0]: ", "did you mean 'color'?"},
    {"LightDirection", "{\"candela\": 1, \"lights\": [{\"type\": \"directional\", \"direction\": [0,0,0]}]}",
     "s.json:1:27: lights[0]: ", "no length"},
    {"MeshEmpty", "{\"candela\": 1, \"meshes\": {\"m\": {}}}", "s.json:1:32: meshes.m: ", "no triangles"},
    {"MeshKey", "{\"candela\": 1, \"meshes\": {\"m\": {\"position\": []}}}",
     "s.json:1:33: meshes.m: ", "did you mean 'positions'?"},
    {"MeshBothKinds", "{\"candela\": 1, \"meshes\": {\"m\": {\"file\": \"x.obj\", \"uvs\": []}}}",
     "s.json:1:50: meshes.m: ", "no key 'uvs'"},
    {"MeshColors",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"vertex_colors\": [[0,0,1],[0,0,1]], "
     "\"triangles\": [[0,0,0]]}}}",
     "s.json:1:74: meshes.m.vertex_colors: ", "2 elements for 1 positions"},
    {"MeshFaceColors",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"face_colors\": [[0,-1,1]], "
     "\"triangles\": [[0,0,0]]}}}",
     "s.json:1:72: meshes.m.face_colors: ", "colour 0 is negative"},
    {"MeshIndex",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"triangles\": [[0,0,1]]}}}",
     "s.json:1:76: meshes.m.triangles: ", "from 0 to 0"},
    {"MeshNegative",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"triangles\": [[0,-1,0]]}}}",
     "s.json:1:74: meshes.m.triangles: ", "'-1'"},
    {"MeshCorners",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"triangles\": [[0,0,0,0]]}}}",
     "s.json:1:71: meshes.m.triangles: ", "4 corners"},
    {"MeshPoint", "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0],[0,0]]}}}",
     "s.json:1:55: meshes.m.positions: ", "2 elements"},
    {"MeshString", "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,\"0\",0]]}}}",
     "s.json:1:50: meshes.m.positions: ", "give a number"},
    {"MeshNormals",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"normals\": [[0,0,1],[0,0,1]], "
     "\"triangles\": [[0,0,0]]}}}",
     "s.json:1:68: meshes.m.normals: ", "2 elements for 1 positions"},
    {"MeshSlots",
     "{\"candela\": 1, \"meshes\": {\"m\": {\"positions\": [[0,0,0]], \"triangles\": [[0,0,0]], "
     "\"material_slots\": [1]}}}",
     "s.json:1:100: meshes.m.material_slots: ", "from 0 to 0"},
    {"MeshNoFile", "{\"candela\": 1, \"meshes\": {\"m\": {\"file\": \"x.obj\"}}}",
     "s.json:1:41: meshes.m.file: ", "no file 'x.obj'"},
    {"MeshEnding", "{\"candela\": 1, \"instances\": [{\"file\": \"s.json\"}]}",
     "s.json:1:39: instances[0].file: ", "give an OBJ file"},
    {"InstanceKey", "{\"candela\": 1, \"instances\": [{\"shap\": \"disc\"}]}",
     "s.json:1:31: instances[0]: ", "did you mean 'shape'?"},
    {"InstanceNoShape", "{\"candela\": 1, \"instances\": [{\"name\": \"x\"}]}",
     "s.json:1:30: instances[0]: ", "no shape"},
    {"InstanceShape", "{\"candela\": 1, \"instances\": [{\"shape\": \"teapot\"}]}",
     "s.json:1:40: instances[0].shape: ", "mesh, sphere, rectangle, disc, plane"},
    {"InstanceMesh", "{\"candela\": 1, \"meshes\": {}, \"instances\": [{\"mesh\": \"x\"}]}",
     "s.json:1:53: instances[0].mesh: ", "no mesh 'x'"},
    {"InstanceNoMesh", "{\"candela\": 1, \"instances\": [{\"shape\": \"mesh\"}]}",
     "s.json:1:30: instances[0]: ", "names no mesh"},
    {"InstanceTwoMeshes", "{\"candela\": 1, \"instances\": [{\"mesh\": \"x\", \"file\": \"y\"}]}",
     "s.json:1:52: instances[0]: ", "both"},
    {"SphereMesh", "{\"candela\": 1, \"instances\": [{\"shape\": \"sphere\", \"mesh\": \"x\"}]}",
     "s.json:1:58: instances[0]: ", "a sphere has no mesh"},
    {"DiscRadius", "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"radius\": 1}]}",
     "s.json:1:58: instances[0]: ", "a disc has no radius"},
    {"TorusHeight", "{\"candela\": 1, \"instances\": [{\"shape\": \"torus\", \"height\": 1}]}",
     "s.json:1:59: instances[0]: ", "a torus has no height"},
    {"TorusTube", "{\"candela\": 1, \"instances\": [{\"shape\": \"torus\", \"minor_radius\": 1}]}",
     "s.json:1:65: instances[0].minor_radius: ", "not below the radius"},
    {"CylinderCaps", "{\"candela\": 1, \"instances\": [{\"shape\": \"cylinder\", \"caps\": 1}]}",
     "s.json:1:60: instances[0].caps: ", "true"},
    {"LightNoObject", "{\"candela\": 1, \"lights\": [7]}", "s.json:1:27: lights[0]: ", "give an object"},
    {"LightType", "{\"candela\": 1, \"lights\": [{\"type\": 3}]}",
     "s.json:1:36: lights[0].type: ", "one of point"},
    {"LightScaleType", "{\"candela\": 1, \"lights\": [{\"scale\": \"2\"}]}",
     "s.json:1:37: lights[0].scale: ", "a string does not fit"},
    {"LightScaleRange", "{\"candela\": 1, \"lights\": [{\"scale\": -1}]}",
     "s.json:1:37: lights[0].scale: ", "from 0"},
    {"LightColorUnit", "{\"candela\": 1, \"lights\": [{\"color\": [1, 2]}]}",
     "s.json:1:37: lights[0].color: ", "in W/sr"},
    {"LightColorOverflow", "{\"candela\": 1, \"lights\": [{\"color\": [1, 2, 1e39]}]}",
     "s.json:1:37: lights[0].color: ", "does not fit"},
    {"LightNaN", "{\"candela\": 1, \"lights\": [{\"scale\": NaN}]}",
     "s.json:1:37: JSON: ", "invalid literal"},
    {"LightPosition", "{\"candela\": 1, \"lights\": [{\"position\": 0}]}",
     "s.json:1:40: lights[0].position: ", "give [x, y, z]"},
    {"OtherLightsType", "{\"candela\": 1, \"lights\": [{\"type\": \"constant\", \"position\": \"here\"}]}",
     "s.json:1:60: lights[0].position: ", "give [x, y, z]"},
    {"OtherLightsRange", "{\"candela\": 1, \"lights\": [{\"cutoff_angle\": 181}]}",
     "s.json:1:44: lights[0].cutoff_angle: ", "180"},
    {"OtherMaterialsType", "{\"candela\": 1, \"materials\": [{\"roughness\": \"rough\"}]}",
     "s.json:1:44: materials[0].roughness: ", "a string does not fit"},
    {"SpotAxis", "{\"candela\": 1, \"lights\": [{\"type\": \"spot\", \"direction\": [0,0,0]}]}",
     "s.json:1:27: lights[0]: ", "no length"},
    {"SpotCutoff", "{\"candela\": 1, \"lights\": [{\"type\": \"spot\", \"cutoff_angle\": 181}]}",
     "s.json:1:60: lights[0].cutoff_angle: ", "180"},
    {"Attenuation", "{\"candela\": 1, \"lights\": [{\"attenuation\": [0,0,0]}]}",
     "s.json:1:27: lights[0]: ", "1 / r^2"},
    {"PictureOfASpot",
     "{\"candela\": 1, \"lights\": [{\"image\": {\"width\": 1, \"height\": 1, \"pixels\": [1,1,1]}, "
     "\"type\": \"spot\"}]}",
     "s.json:1:37: lights[0]: ", "only an environment"},
    {"PanoramaMissing", "{\"candela\": 1, \"lights\": [{\"type\": \"environment\", \"file\": \"sky.exr\"}]}",
     "s.json:1:59: lights[0].file: ", "no file 'sky.exr'"},
    {"PanoramaOutside",
     "{\"candela\": 1, \"lights\": [{\"type\": \"environment\", \"file\": \"../sky.exr\"}]}",
     "s.json:1:59: lights[0].file: ", ""},
    {"PanoramaFaces", "{\"candela\": 1, \"lights\": [{\"type\": \"environment\", \"files\": [\"a.png\"]}]}",
     "s.json:1:60: lights[0].files: ", "+x, -x"},
    {"PanoramaMapping", "{\"candela\": 1, \"lights\": [{\"type\": \"environment\", \"mapping\": \"cube\"}]}",
     "s.json:1:62: lights[0].mapping: ", "latlong"},
    {"PanoramaPixels",
     "{\"candela\": 1, \"lights\": [{\"type\": \"environment\", \"image\": {\"width\": 2, \"height\": 1, "
     "\"pixels\": [1,1,1]}}]}",
     "s.json:1:96: lights[0].image: ", "it is no picture"},
    {"PanoramaNegative",
     "{\"candela\": 1, \"lights\": [{\"type\": \"environment\", \"image\": {\"width\": 1, \"height\": 1, "
     "\"pixels\": [1,-1,1]}}]}",
     "s.json:1:99: lights[0].image.pixels: ", "negative"},
    {"SphereRadius", "{\"candela\": 1, \"instances\": [{\"shape\": \"sphere\", \"radius\": 0}]}",
     "s.json:1:60: instances[0].radius: ", "above 0"},
    {"MaterialName",
     "{\"candela\": 1, \"materials\": [{\"name\": \"red\"}], \"instances\": [{\"shape\": \"disc\", "
     "\"material\": \"rod\"}]}",
     "s.json:1:92: instances[0].material: ", "did you mean 'red'?"},
    {"MaterialAmbiguous",
     "{\"candela\": 1, \"materials\": [{\"name\": \"a\"}, {\"name\": \"a\"}], \"instances\": [{\"shape\": "
     "\"disc\", \"material\": \"a\"}]}",
     "s.json:1:105: instances[0].material: ", "several"},
    {"MaterialIndex",
     "{\"candela\": 1, \"materials\": [{}], \"instances\": [{\"shape\": \"disc\", \"material\": 1}]}",
     "s.json:1:79: instances[0].material: ", "from 0 to 0"},
    {"MaterialSlot",
     "{\"candela\": 1, \"materials\": [{\"name\": \"a\"}], \"instances\": [{\"shape\": \"disc\", "
     "\"materials\": {\"x\": \"a\"}}]}",
     "s.json:1:92: instances[0].materials: ", "no key 'x'"},
    {"MaterialList",
     "{\"candela\": 1, \"materials\": [{}], \"instances\": [{\"shape\": \"disc\", \"materials\": [0, 0]}]}",
     "s.json:1:80: instances[0].materials: ", "2 materials for 1 slots"},
    {"TransformSize", "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [1,2,3]}]}",
     "s.json:1:61: instances[0].transform: ", "array of 16 numbers"},
    {"TransformStep",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [{\"move\": 1}]}]}",
     "s.json:1:63: instances[0].transform[0]: ", "no key 'move'"},
    {"TransformTwo",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [{\"scale\": 1, \"translate\": "
     "[0,0,0]}]}]}",
     "s.json:1:62: instances[0].transform[0]: ", "2 keys"},
    {"TransformAxis",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [{\"rotate\": [0,0,0,90]}]}]}",
     "s.json:1:73: instances[0].transform[0].rotate: ", "no length"},
    {"TransformFlat",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [{\"scale\": [1,0,1]}]}]}",
     "s.json:1:61: instances[0].transform: ", "flattens"},
    {"TransformProjective",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": "
     "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,1,1]}]}",
     "s.json:1:61: instances[0].transform: ", "0 0 0 1"},
    {"TransformHuge",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [{\"scale\": 1e30}, {\"scale\": "
     "1e30}]}]}",
     "s.json:1:61: instances[0].transform: ", "not finite"},
    {"LookAt",
     "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"transform\": [{\"look_at\": {\"target\": "
     "[0,1,0]}}]}]}",
     "s.json:1:74: instances[0].transform[0].look_at: ", "parallel"},
};

INSTANTIATE_TEST_SUITE_P(All, CandelaJsonErrors, ::testing::ValuesIn(kJsonErrors),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(CandelaJson, CapsNesting) {
  std::string deep(65, '[');
  EXPECT_TRUE(test::says(error("{\"candela\": 1, \"lights\": " + deep, ExitCode::limit),
                         "s.json:1:89: JSON: ", {"64 levels"}));
}

TEST_F(CandelaJson, CapsTheFile) {
  files.write("big.json", "{}");
  std::filesystem::resize_file(files / "big.json", std::uintmax_t{600} << 20); // sparse
  EXPECT_TRUE(test::says(files.error("big.json", ExitCode::limit), "big.json: scene: "));
}

TEST_F(CandelaJson, RefusesBinaryAndMissingFiles) {
  EXPECT_TRUE(test::says(error(std::string("{\n\"a\0b", 6)), "s.json:2:3: scene: ", {"NUL"}));
  EXPECT_TRUE(test::says(files.error("none.json"), "none.json: scene: "));
  std::filesystem::create_directory(files / "folder.json");
  EXPECT_TRUE(test::says(files.error("folder.json"), "folder.json: scene: "));
  files.write("x.blend", "");
  EXPECT_TRUE(test::says(files.error("x.blend"), "x.blend: scene: ", {"'.blend'"}));
}

} // namespace
} // namespace candela
