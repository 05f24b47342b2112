#include "lights/light_desc.h"

#include <gtest/gtest.h>

#include <set>

namespace candela {
namespace {

TEST(LightModels, KnowTheirRows) {
  std::set<std::string_view> names;
  for (int type = 0; type < kLightTypeCount; ++type) {
    LightDesc light = default_light(type);
    SCOPED_TRACE(light_type_name(light));
    EXPECT_EQ(light_type(light), type);
    EXPECT_TRUE(names.insert(light_type_name(light)).second);
    EXPECT_EQ(light_problem(light), "");
    std::set<void*> addresses;
    for (const auto& row : light_fields(light)) {
      const auto* address = static_cast<const char*>(row.address(light));
      EXPECT_GE(address, reinterpret_cast<const char*>(&light)) << row.key;
      EXPECT_LT(address, reinterpret_cast<const char*>(&light + 1)) << row.key;
      EXPECT_TRUE(addresses.insert(row.address(light)).second) << row.key << " is another row's value";
    }
    EXPECT_EQ(light_position(light) != nullptr, std::ranges::any_of(light_fields(light), [](const auto& row) {
                return row.key == "position";
              }));
  }
}

TEST(LightModels, AChangeOfTheTypeKeepsEqualKeys) {
  LightDesc light;
  light.name = "lamp";
  light.color = vec3(1, 2, 3);
  light.scale = 5;
  light.model = PointLightModel{{7, 8, 9}, {0, 1, 0}};
  change_type(light, light_type(LightDesc{"", SpotLightModel{}}));
  EXPECT_EQ(std::get<SpotLightModel>(light.model),
            (SpotLightModel{.position = {7, 8, 9}, .attenuation = {0, 1, 0}}));
  std::get<SpotLightModel>(light.model).direction = {1, 0, 0};
  change_type(light, light_type(LightDesc{"", DirectionalLightModel{}}));
  EXPECT_EQ(std::get<DirectionalLightModel>(light.model).direction, vec3(1, 0, 0));
  change_type(light, light_type(LightDesc{"", ConstantLightModel{}}));
  EXPECT_EQ(light.name, "lamp");
  EXPECT_EQ(light.color, vec3(1, 2, 3));
  EXPECT_EQ(light.scale, 5);
}

TEST(LightModels, SayWhatTheirRowsCannot) {
  LightDesc light;
  light.model = PointLightModel{.attenuation = vec3(0)};
  EXPECT_EQ(light_problem(light), "attenuation: is zero; give 0 0 1 for 1 / r^2");
  light.model = SpotLightModel{.direction = vec3(0)};
  EXPECT_EQ(light_problem(light), "direction: has no length; give a direction");
  light.model = DirectionalLightModel{vec3(1e-30f)}; // its length is not a float's
  EXPECT_EQ(light_problem(light), "direction: has no length; give a direction");
  light.model = EnvironmentLightModel{.up = vec3(0)};
  EXPECT_EQ(light_problem(light), "up: has no length; give a direction");
  light.model = ConstantLightModel{};
  light.scale = -1;
  EXPECT_TRUE(light_problem(light).starts_with("scale: ")) << light_problem(light);
}

} // namespace
} // namespace candela
