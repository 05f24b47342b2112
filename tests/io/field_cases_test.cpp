// Inputs similar to those of common bug reports.

#include "io/images/texels_reader.h"
#include "io/scene_files.h"
#include "support/materials.h"

namespace candela {
namespace {

using test::color;
using test::use_of;

using test::mesh_of;

struct FieldCases : ::testing::Test {
  const std::string folder = CANDELA_SHARED_DATA "/field/";
  void SetUp() override {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  }
  LoadedScene read(const std::string& name) const { return read_scene(folder + name); }
};

TEST_F(FieldCases, EveryModelIsRead) {
  for (const char* name : {"mtl_tex_tif", "mtl_unix_abs", "mtl_opt_2d", "mtl_s_o", "obj_face_slash2",
                           "obj_vn_nan", "obj_trailing_nul", "mtl_empty_map", "mtl_cont",
                           "mtl_lib_missing_same", "mtl_ns0", "mtl_blender_default", "mtl_pbr"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(mesh_of(read(std::string(name) + "/q.obj")).triangles.size(), 2u);
  }
  auto material = [&](const char* name) {
    return read(std::string(name) + "/q.obj").document.scene.materials.at(0);
  };
  EXPECT_EQ(use_of(material("mtl_unix_abs")).texture, 0);
  EXPECT_EQ(use_of(material("mtl_opt_2d")).uv, (UvTransform{vec2(2), vec2(0.5f)}));
  EXPECT_EQ(use_of(material("mtl_s_o")).uv, (UvTransform{vec2(2), vec2(0.5f, 0)}));
  EXPECT_EQ(color(material("mtl_ns0"), "diffuse"), vec3(0.6f));
  EXPECT_EQ(color(material("mtl_cont"), "diffuse"), vec3(1, 0, 0));
  EXPECT_EQ(color(material("mtl_lib_missing_same"), "diffuse"), vec3(1, 0, 0));
}

TEST_F(FieldCases, PicturesAndJobs) {
  const auto depth_first = read("exr_mp_depth_first/s.json");
  EXPECT_GT(max_component(light_panorama(depth_first.document.scene.lights.at(0))->image.pixels.at(0)), 0);
  float brightest = 0;
  for (const LightDesc& light : read("exr_half_inf/s.json").document.scene.lights)
    if (const auto panorama = light_panorama(light))
      for (vec3 p : panorama->image.pixels) brightest = std::max(brightest, max_component(p));
  EXPECT_EQ(brightest, 65504);
  EXPECT_EQ(read("ini_inline/j.ini").document.settings.film.width, 32);
}

// A ball of radius 1, 5411 km from the origin of its file, where floats are half a unit apart.
TEST_F(FieldCases, AMeshInUtmCoordinatesIsRound) {
  const auto loaded = read("utm_local/b.obj");
  const Mesh& mesh = mesh_of(loaded);
  const vec3 center = shape_bounds(loaded.document.scene.instances[0].shape).center();
  for (vec3 p : mesh.positions) EXPECT_NEAR(glm::length(p - center), 1, 1e-4f);
}

} // namespace
} // namespace candela
