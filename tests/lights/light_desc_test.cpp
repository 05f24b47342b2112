#include "lights/light_desc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

TEST(LightModels, FindWhatTheirRowsCannotCheck) {
  LightDesc light;
  light.model = PointLightModel{.attenuation = vec3(0)};
  EXPECT_EQ(light_problem(light), "attenuation: is zero; give 0 0 1 for 1 / r^2");
  light.model = SpotLightModel{.direction = vec3(0)};
  EXPECT_EQ(light_problem(light), "direction: has no length; give a direction");
  light.model = DirectionalLightModel{vec3(1e-30f)}; // its length is not a float's
  EXPECT_EQ(light_problem(light), "direction: has no length; give a direction");
  light.model = EnvironmentLightModel{.up = vec3(0)};
  EXPECT_EQ(light_problem(light), "up: has no length; give a direction");
}

TEST(LightModels, RefuseValuesThatDoNotFitTheirRows) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  for (int type = 0; type < kLightTypeCount; ++type)
    for (const auto& row : light_fields(type)) {
      SCOPED_TRACE(std::string(light_type_names()[static_cast<std::size_t>(type)]) + "." +
                   std::string(row.key));
      auto problem_with = [&](auto set) {
        LightDesc light = default_light(type);
        set(row.address(light));
        return light_problem(light);
      };
      const std::string start = std::string(row.key) + ": ";
      if (row.type == FieldType::choice) {
        EXPECT_TRUE(problem_with([](void* v) { *static_cast<int*>(v) = 99; }).starts_with(start));
        continue;
      }
      const bool is_vector = row.type == FieldType::point || row.type == FieldType::color;
      for (float wrong : {nan, infinite, -1e30f}) {
        if (wrong == -1e30f && !std::isfinite(row.minimum)) continue; // every number fits
        const std::string problem = problem_with([&](void* v) {
          if (is_vector)
            static_cast<vec3*>(v)->y = wrong;
          else
            *static_cast<float*>(v) = wrong;
        });
        EXPECT_TRUE(problem.starts_with(start)) << wrong << ": '" << problem << "'";
      }
    }
}

TEST(LightModels, StateTheUnitOfTheirColour) {
  auto color_row = [](const LightDescModel& model) -> const Field<LightDesc>& {
    return *std::ranges::find(light_fields(light_type(LightDesc{"", model})), "color", &FieldInfo::key);
  };
  EXPECT_EQ(color_row(PointLightModel{}).unit, "W/sr");
  EXPECT_EQ(color_row(SpotLightModel{}).unit, "W/sr");
  EXPECT_EQ(color_row(DirectionalLightModel{}).unit, "W/m^2");
  EXPECT_EQ(color_row(ConstantLightModel{}).unit, "W/(m^2 sr)");
  EXPECT_EQ(color_row(EnvironmentLightModel{}).unit, "");
  for (std::string_view name : light_type_names())
    EXPECT_NE(light_type_field().help.find(std::string(name) + ": "), std::string_view::npos) << name;
}

TEST(Panoramas, HaveFinitePixelsThatFitTheirSize) {
  Panorama panorama;
  EXPECT_NE(panorama_problem(panorama), "");
  panorama.image = {2, 1, {vec3(0), vec3(1e9f)}};
  EXPECT_EQ(panorama_problem(panorama), "");
  panorama.image.height = 2;
  EXPECT_TRUE(panorama_problem(panorama).starts_with("its pixels do not fit"));
  panorama.image.height = 1;
  for (float wrong :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    panorama.image.pixels[1].z = wrong;
    EXPECT_TRUE(panorama_problem(panorama).starts_with("a pixel is negative or not finite")) << wrong;
  }
}

} // namespace
} // namespace candela
