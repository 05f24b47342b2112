#include "io/cs123/cs123_files.h"

namespace candela {
namespace {

using test::Cs123Reader;

TEST_F(Cs123Reader, Lights) {
  auto loaded = read("<lightdata><id v='3'/><type v='directional'/><direction x='0' y='-2' z='0'/><color "
                     "r='1' g='2' b='3'/></lightdata>"
                     "<lightdata><position x='1' y='2' z='3'/><color r='1' g='1' b='1'/><function v1='1' "
                     "v2='0' v3='0'/></lightdata>" +
                     sphere(""));
  const auto& lights = loaded.document.scene.lights;
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].name, "light 3");
  EXPECT_EQ(std::get<DirectionalLightModel>(lights[0].model).direction, vec3(0, -2, 0));
  EXPECT_EQ(lights[0].color, vec3(1, 2, 3));
  EXPECT_EQ(std::get<PointLightModel>(lights[1].model), (PointLightModel{{1, 2, 3}, {1, 0, 0}}));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(test::says(files.warnings(loaded)[0], "1 x s.xml:2:181: a light's function", {"not physical"}));
}

TEST_F(Cs123Reader, SpotsAndAreaLights) {
  auto loaded =
      read("<lightdata><type v='spot'/><position x='1' y='2' z='3'/><direction x='0' y='-1' z='1'/>"
           "<angle v='30'/><penumbra v='10'/><function a='0' b='0' c='2'/><color r='4' g='5' b='6'/>"
           "</lightdata><lightdata><id v='1'/><type v='area'/><position x='0' y='4' z='0'/>"
           "<direction x='0' y='-3' z='0'/><width v='2'/><height v='6'/><color r='7' g='8' b='9'/>"
           "</lightdata>" +
           sphere(""));
  const SceneDesc& scene = loaded.document.scene;
  EXPECT_EQ(files.warnings(loaded), std::vector<std::string>{});
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto& spot = std::get<SpotLightModel>(scene.lights[0].model);
  EXPECT_EQ(spot.position, vec3(1, 2, 3));
  EXPECT_EQ(spot.direction, vec3(0, -1, 1));
  EXPECT_NEAR(degrees(spot.cutoff_angle), 30, 1e-5f);
  EXPECT_NEAR(degrees(spot.beam_width), 20, 1e-5f);
  EXPECT_EQ(spot.attenuation, vec3(0, 0, 2));
  EXPECT_EQ(scene.lights[0].color, vec3(4, 5, 6));
  ASSERT_EQ(scene.instances.size(), 2u);
  const Instance& area = scene.instances[0];
  EXPECT_EQ(area.name, "light 1");
  EXPECT_TRUE(std::holds_alternative<RectangleShape>(area.shape));
  EXPECT_EQ(transform_point(area.world_from_object, {1, 1, 0}), vec3(1, 4, 3));
  EXPECT_EQ(transform_vector(area.world_from_object, {0, 0, 1}), vec3(0, -1, 0)) << "it faces down";
  const Material& shine = scene.materials[static_cast<std::size_t>(area.materials[0])];
  EXPECT_EQ(shine.emission, vec3(7, 8, 9));
  EXPECT_FALSE(shine.two_sided_emission);
}

} // namespace
} // namespace candela
