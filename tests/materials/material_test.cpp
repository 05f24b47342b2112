#include "scene/document.h"
#include "support/materials.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace candela {
namespace {

using test::color;
using test::has;
using test::material_of_type;
using test::number;

TEST(Material, RowsAddressTheParametersThatTheyName) {
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    Material m = default_material(type);
    EXPECT_EQ(material_type(m), type);
    std::set<void*> seen;
    for (const MaterialField& row : material_fields(type)) {
      SCOPED_TRACE(std::string(material_type_name(m)) + "." + std::string(row.key));
      EXPECT_TRUE(seen.insert(row.address(m)).second);
      if (row.parameter == nullptr) continue;
      const ParameterRef parameter = row.parameter(m);
      EXPECT_EQ(parameter.value(), row.address(m));
      EXPECT_EQ(parameter.number != nullptr, row.type == FieldType::real);
      EXPECT_EQ(parameter.color != nullptr, row.type == FieldType::color);
    }
  }
}

TEST(Material, KeysMeanTheSameToAllTypes) {
  std::map<std::string_view, const MaterialField*> known;
  for (int type = 0; type < kMaterialTypeCount; ++type)
    for (const MaterialField& row : material_fields(type)) {
      if (!row.kept) continue;
      SCOPED_TRACE(row.key);
      const MaterialField& first = *known.try_emplace(row.key, &row).first->second;
      EXPECT_EQ(row.type, first.type) << "or a change of the type could not keep the value";
      EXPECT_EQ(row.minimum, first.minimum);
      EXPECT_EQ(row.maximum, first.maximum);
      EXPECT_EQ(row.parameter == nullptr, first.parameter == nullptr);
    }
}

TEST(Material, AChangeOfTheTypeKeepsEqualKeys) {
  Material m = material_of_type("phong");
  m.name = "m";
  m.emission = vec3(3);
  m.opacity = 0.5f;
  color(m, "specular") = vec3(0.25f);
  color(m, "diffuse") = vec3(0.125f);
  find_parameter(m, "specular").use().texture = 7;
  const auto index = [](std::string_view name) { return material_type(material_of_type(name)); };
  change_type(m, index("ggx"));
  EXPECT_EQ(color(m, "specular"), vec3(0.25f));
  EXPECT_EQ(find_parameter(m, "specular").use().texture, 7) << "and its texture";
  EXPECT_EQ(number(m, "roughness"), 0.3f);
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.emission, vec3(3));
  EXPECT_EQ(m.opacity, 0.5f);
  change_type(m, index("diffuse"));
  EXPECT_EQ(color(m, "diffuse"), vec3(0.5f));
  EXPECT_FALSE(has(m, "specular"));
  color(m, "diffuse") = vec3(0.75f);
  change_type(m, index("mirror"));
  EXPECT_EQ(color(m, "diffuse"), vec3(0)) << "a mirror, not one that is half matte";
  color(m, "diffuse") = vec3(0.1f);
  change_type(m, index("phong"));
  EXPECT_EQ(color(m, "diffuse"), vec3(0.5f));
  EXPECT_EQ(color(m, "specular"), vec3(1)) << "that of the mirror";
}

TEST(MaterialChoice, HasEveryKeyOfEveryTypeOnce) {
  EXPECT_EQ(material_choice_fields().size(), kMaterialKeyCount);
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    MaterialChoice choice;
    choice.type = type;
    for (const auto& row : material_choice_fields()) {
      SCOPED_TRACE(row.key);
      const MaterialField* to = find_material_field(type, row.key);
      Material m = chosen_material(choice, true);
      ASSERT_EQ(material_type(m), type);
      if (to == nullptr) continue;
      if (row.type != to->type) continue; // another meaning: it stays at its default
      field_from_text(row, row.address(choice),
                      row.type == FieldType::color     ? "0.25 0.5 0.75"
                      : row.type == FieldType::integer ? "5"
                      : row.type == FieldType::boolean ? "true"
                      : row.type == FieldType::choice  ? row.choices.back()
                      : row.minimum > 0.5              ? "2"
                                                       : "0.5");
      if (!field_problem(*to, row.address(choice)).empty()) continue; // no room for that: its default
      m = chosen_material(choice, true);
      EXPECT_EQ(field_text(*to, m), field_text(row, choice));
      if (to->kept) { EXPECT_EQ(is_parameter_key(row.key), to->parameter != nullptr); }
    }
  }
}

TEST(MaterialChoice, TheOverrideHasASettingForEachKey) {
  Document d;
  for (const auto& row : material_choice_fields())
    EXPECT_NE(find_setting("override." + std::string(row.key)), nullptr) << row.key;
  apply_setting(d, "override.brdf=mirror");
  apply_setting(d, "override.diffuse=0.5");
  Material mirror = overriding_material(d.settings.override_brdf);
  EXPECT_EQ(color(mirror, "diffuse"), vec3(0)) << "a mirror reflects, and nothing else";
  EXPECT_EQ(color(mirror, "specular"), vec3(0.9f));
  apply_setting(d, "override.brdf=phong");
  apply_setting(d, "override.specular=0.25");
  apply_setting(d, "override.exponent=7");
  Material phong = overriding_material(d.settings.override_brdf);
  EXPECT_EQ(color(phong, "diffuse"), vec3(0.5f));
  EXPECT_EQ(color(phong, "specular"), vec3(0.25f));
  EXPECT_EQ(number(phong, "exponent"), 7);
  apply_setting(d, "override.brdf=ggx");
  EXPECT_EQ(color(overriding_material(d.settings.override_brdf), "specular"), vec3(0.25f)) << "of both";
}

TEST(Material, InsidesAbsorbWhereLightEnters) {
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    Material m = default_material(type);
    EXPECT_EQ(interior(m.model).has_value(),
              has(m, "absorption") || m.model == MaterialModel(SubsurfaceMaterial()));
  }
  const std::optional<Interior> inside = interior(DielectricMaterial{1.4f, vec3(1), {1, 2, 3}, 7});
  EXPECT_EQ(inside->absorption, vec3(1, 2, 3));
  EXPECT_EQ(inside->ior, 1.4f);
  EXPECT_EQ(inside->priority, 7);
}

/// What a random walk goes through follows from the colour and the mean free path; profiles fill no body.
TEST(Material, ARandomWalkHasAMedium) {
  SubsurfaceMaterial walk{.color = vec3(1, 0.5f, 0), .radius = vec3(0.5f, 1, 2), .scale = 0.5f, .ior = 1.0f};
  const std::optional<Interior> inside = interior(walk);
  ASSERT_TRUE(inside && inside->matter);
  const Spectrum sigma_t = inside->matter->sigma_t();
  EXPECT_NEAR(sigma_t.x, 4, 1e-5f);
  EXPECT_NEAR(sigma_t.y, 2, 1e-5f);
  EXPECT_NEAR(sigma_t.z, 1, 1e-5f);
  EXPECT_EQ(inside->matter->sigma_a.x, 0);
  EXPECT_NEAR(inside->matter->sigma_s.y, 2 * single_scattering_albedo(0.5f), 1e-5f);
  EXPECT_NEAR(inside->matter->sigma_s.z, 0, 1e-5f);
  for (const SubsurfaceMethod method : {SubsurfaceMethod::burley, SubsurfaceMethod::dipole}) {
    walk.method = static_cast<int>(method);
    EXPECT_FALSE(interior(walk));
  }
}

} // namespace
} // namespace candela
