#include "core/error.h"
#include "scene/document.h"
#include "support/materials.h"
#include "support/textures.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace candela;
using test::use_of;

/// The value moved to another one that its row allows.
template <class T>
void change(const Field<T>& row, T& owner) {
  void* at = row.address(owner);
  std::string before = row.type == FieldType::choice ? "" : field_to_text(row, at);
  switch (row.type) {
  case FieldType::boolean: field_from_text(row, at, before == "true" ? "false" : "true"); break;
  case FieldType::choice:
    field_from_text(row, at, field_to_text(row, at) == row.choices[0] ? row.choices[1] : row.choices[0]);
    break;
  case FieldType::material: field_from_text(row, at, before == "none" ? "0" : "none"); break;
  case FieldType::point:
  case FieldType::color:
    field_from_text(row, at, before == "0.25 0.5 0.75" ? "0.5 0.25 0.75" : "0.25 0.5 0.75");
    break;
  default: {
    double lo = std::isfinite(row.minimum) ? row.minimum : 0,
           hi = std::isfinite(row.maximum) ? std::min(row.maximum, lo + 40) : lo + 40;
    for (double value : {std::ceil(lo), std::floor(hi), std::ceil(lo) + 1}) {
      std::string text = std::to_string(static_cast<int>(value));
      if (value < row.minimum || text == before) continue;
      field_from_text(row, at, text);
      break;
    }
  }
  }
}

template <class Row, class T>
void expect_sound_rows(std::span<const Row> rows, T owner) {
  std::set<std::string_view> keys;
  const T standard = owner;
  for (const auto& row : rows) {
    SCOPED_TRACE(row.key);
    EXPECT_TRUE(keys.insert(row.key).second) << "twice";
    EXPECT_GT(row.help.size(), 5u);
    EXPECT_FALSE(row.help.ends_with('.'));
    EXPECT_EQ(field_problem(row, row.address(owner)), "") << "the default breaks its row";
    EXPECT_LE(row.minimum, row.maximum);
    EXPECT_EQ(row.type == FieldType::choice, !row.choices.empty());
    EXPECT_TRUE(!row.logarithmic || row.minimum >= 0);
    std::string text = field_text(row, owner); // reads back to what it is
    T again = standard;
    change(row, again);
    EXPECT_FALSE(field_equal(row, row.address(owner), row.address(again)));
    field_from_text(row, row.address(again), text);
    EXPECT_TRUE(field_equal(row, row.address(owner), row.address(again)));
  }
}

template <class T>
void expect_sound_rows(std::span<const Field<T>> rows) {
  expect_sound_rows(rows, T());
}

TEST(SettingsTable, RowsAreSound) {
  expect_sound_rows(settings_table());
  for (int type = 0; type < kMaterialTypeCount; ++type)
    expect_sound_rows(material_fields(type), default_material(type));
  expect_sound_rows(texture_use_fields());
  for (int type = 0; type < kLightTypeCount; ++type)
    expect_sound_rows(light_fields(type), default_light(type));
}

TEST(SettingsTable, AddressesDiffer) {
  Document d;
  std::set<void*> seen;
  for (const auto& row : settings_table()) EXPECT_TRUE(seen.insert(row.address(d)).second) << row.key;
  EXPECT_EQ(find_setting("path.max_depth")->address(d), &d.settings.path.max_depth);
  EXPECT_EQ(find_setting("camera.vertical_fov")->address(d), &d.scene.camera.vertical_fov);
  EXPECT_EQ(find_setting("path.nothing"), nullptr);
}

TEST(SettingsTable, EveryChoiceIsTheEnumsName) {
  Document d;
  for (auto [text, value] :
       {std::pair{"bsdf", LightSampling::bsdf}, {"nee", LightSampling::nee}, {"mis", LightSampling::mis}}) {
    apply_setting(d, std::string("path.light_sampling=") + text);
    EXPECT_EQ(d.settings.path.light_sampling, value);
  }
  for (std::string_view type : scattering_type_names()) {
    apply_setting(d, std::string("override.brdf=") + std::string(type));
    EXPECT_EQ(material_type_name(overriding_material(d.settings.override_brdf)), type);
  }
  apply_setting(d, "override.brdf=none");
  EXPECT_FALSE(d.settings.override_brdf.is_on());
  apply_setting(d, "sampler.type=stratified");
  EXPECT_EQ(d.settings.sampler.type, SamplerType::stratified);
  apply_setting(d, "path.rr=fixed");
  EXPECT_EQ(d.settings.path.rr, RussianRoulette::fixed);
  apply_setting(d, "path.component=indirect");
  EXPECT_EQ(d.settings.path.component, PathComponent::indirect);
  apply_setting(d, "view=depth");
  EXPECT_EQ(d.settings.view, View::depth);
  apply_setting(d, "display.tone_map=filmic");
  EXPECT_EQ(d.settings.display.tone_map, ToneMap::filmic);
}

std::string refusal(std::string_view assignment) {
  Document d;
  try {
    apply_setting(d, assignment);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_EQ(d, Document{});
    return e.what();
  }
  ADD_FAILURE() << assignment << " was taken";
  return {};
}

TEST(SettingsTable, BadAssignmentsAreUsageErrors) {
  EXPECT_EQ(refusal("path.max_depth"), "--set path.max_depth: there is no '=': write KEY=VALUE");
  EXPECT_NE(refusal("path.maxdepth=3").find("did you mean path.max_depth?"), std::string::npos);
  EXPECT_NE(refusal("zzzzzzzzzzzzzzzzz=3").find("candela settings"), std::string::npos);
  EXPECT_NE(refusal("path.max_depth=x").find("path.max_depth"), std::string::npos);
  EXPECT_NE(refusal("path.max_depth=-2").find("from -1"), std::string::npos);
  EXPECT_NE(refusal("sampler.type=magic").find("sobol"), std::string::npos);
  refusal("=3");
  refusal("path.max_depth=");
  refusal("film.width=0");
}

Document with_things() {
  Document d;
  d.scene.materials.resize(2);
  d.scene.lights.resize(1);
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh->triangles = {{0, 1, 2}};
  d.scene.instances.push_back({"mesh", std::shared_ptr<const Mesh>(mesh), mat4(1), {0}});
  d.scene.instances.push_back({"ball", SphereShape{2}, mat4(1), {1}});
  d.scene.textures.push_back(test::picture_texture(1, 1, {1, 2, 3}));
  return d;
}

TEST(CompareDocuments, AnEditCostsWhatItsRowSays) {
  Document before = with_things();
  EXPECT_EQ(compare_documents(before, before), Invalidates::nothing);
  for (const auto& row : settings_table()) {
    Document after = before;
    change(row, after);
    EXPECT_EQ(compare_documents(before, after), row.invalidates) << row.key;
    EXPECT_EQ(compare_documents(after, before), row.invalidates) << row.key;
  }
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    before.scene.materials[1] = default_material(type);
    for (const auto& row : material_fields(type)) {
      Document after = before;
      change(row, after.scene.materials[1]);
      EXPECT_EQ(compare_documents(before, after), row.invalidates) << row.key;
      if (row.parameter == nullptr) continue;
      after = before;
      row.parameter(after.scene.materials[1]).use().texture = 0;
      EXPECT_EQ(compare_documents(before, after), row.invalidates) << row.key << " as a texture";
    }
    Document after = before;
    change_type(after.scene.materials[1], (type + 1) % kMaterialTypeCount);
    EXPECT_EQ(compare_documents(before, after), Invalidates::scene);
  }
  for (int type = 0; type < kLightTypeCount; ++type) {
    Document of_type = before;
    of_type.scene.lights[0] = default_light(type);
    for (const auto& row : light_fields(type)) {
      Document after = of_type;
      change(row, after.scene.lights[0]);
      EXPECT_EQ(compare_documents(of_type, after), Invalidates::scene) << row.key;
    }
  }
}

TEST(CompareDocuments, TheHeaviestEditCounts) {
  Document before = with_things(), after = before;
  after.settings.stop.spp = 7;
  EXPECT_EQ(compare_documents(before, after), Invalidates::nothing);
  after.settings.display.exposure = 1;
  EXPECT_EQ(compare_documents(before, after), Invalidates::display);
  after.scene.camera.position.x = 9;
  EXPECT_EQ(compare_documents(before, after), Invalidates::image);
  after.scene.instances[1].world_from_object[3].x = 1;
  EXPECT_EQ(compare_documents(before, after), Invalidates::scene);
}

TEST(CompareDocuments, StructureRebuildsTheSceneAndNamesDoNot) {
  Document before = with_things();
  auto cost = [&](auto edit) {
    Document after = before;
    edit(after.scene);
    return compare_documents(before, after);
  };
  EXPECT_EQ(cost([](SceneDesc& s) { s.materials.emplace_back(); }), Invalidates::scene);
  EXPECT_EQ(cost([](SceneDesc& s) { s.instances.pop_back(); }), Invalidates::scene);
  EXPECT_EQ(cost([](SceneDesc& s) { s.instances[0].materials[0] = 1; }), Invalidates::scene);
  EXPECT_EQ(cost([](SceneDesc& s) { s.instances[1].shape = SphereShape{3}; }), Invalidates::scene);
  EXPECT_EQ(cost([](SceneDesc& s) { s.textures.clear(); }), Invalidates::scene);
  EXPECT_EQ(cost([](SceneDesc& s) { use_of(s.materials[0]).texture = 0; }), Invalidates::image);
  EXPECT_EQ(cost([](SceneDesc& s) { use_of(s.materials[0]).uv.offset.x = 1; }), Invalidates::image);
  EXPECT_EQ(cost([](SceneDesc& s) { s.materials[0].name = "x"; }), Invalidates::nothing);
}

TEST(SameContent, LooksIntoMeshesAndTextures) {
  Document a = with_things(), b = with_things(); // equal data at other addresses
  EXPECT_NE(a, b);
  EXPECT_TRUE(same_content(a, b));
  auto differs = [&](auto edit) {
    Document c = with_things();
    edit(c);
    return !same_content(a, c);
  };
  EXPECT_TRUE(differs([](Document& d) {
    auto mesh = std::make_shared<Mesh>(*std::get<std::shared_ptr<const Mesh>>(d.scene.instances[0].shape));
    mesh->positions[2].y = 2;
    d.scene.instances[0].shape = std::shared_ptr<const Mesh>(mesh);
  }));
  EXPECT_TRUE(differs([](Document& d) { d.scene.textures[0] = test::picture_texture(1, 1, {1, 9, 3}); }));
  EXPECT_TRUE(differs([](Document& d) { d.scene.instances[1].shape = DiscShape{}; }));
  EXPECT_TRUE(differs([](Document& d) { d.scene.instances[1].name = "other"; }));
  EXPECT_TRUE(differs([](Document& d) { d.scene.instances[0].world_from_object[3].x = 1; }));
  EXPECT_TRUE(differs([](Document& d) { d.settings.stop.spp += 1; }));
  EXPECT_TRUE(differs([](Document& d) { d.scene.camera.up.x = 1; }));
}

TEST(DocumentProblem, NamesWhatIsWrong) {
  EXPECT_EQ(document_problem(Document{}), "");
  EXPECT_EQ(document_problem(with_things()), "");
  auto problem = [](auto edit) {
    Document d = with_things();
    edit(d);
    return document_problem(d);
  };
  auto starts = [](const std::string& text, std::string_view with) { return text.starts_with(with); };
  EXPECT_EQ(problem([](Document& d) { d.settings.path.max_depth = -7; }),
            "path.max_depth: -7 is out of range; give an integer from -1 to 1000000, in segments");
  EXPECT_PRED2(starts, problem([](Document& d) {
                 d.scene.materials[1].model = GgxMaterial{vec3(0), NAN};
               }),
               "materials[1].roughness: is not a number");
  EXPECT_PRED2(starts, problem([](Document& d) { use_of(d.scene.materials[0]).uv.scale.y = kInfinity; }),
               "materials[0].diffuse.uv_scale");
  EXPECT_PRED2(starts, problem([](Document& d) { use_of(d.scene.materials[0]).texture = 1; }),
               "materials[0].diffuse.texture");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.materials[0].opacity.use.texture = -2; }),
               "materials[0].opacity.texture");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.materials[0].emission.offset.b = NAN; }),
               "materials[0].emission.offset");
  EXPECT_PRED2(starts, problem([](Document& d) {
                 d.scene.textures[0] = test::picture_texture(2, 1, {1, 2, 3});
               }),
               "textures[0].its pixels");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.lights[0].color.g = INFINITY; }), "lights[0].color");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.lights[0].model = DirectionalLightModel{vec3(0)}; }),
               "lights[0].direction");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.instances[0].materials = {2}; }),
               "instances[0].materials");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.instances[0].materials = {-1}; }),
               "instances[0].materials");
  EXPECT_PRED2(starts, problem([](Document& d) {
                 d.scene.instances[0].materials = {0, 1};
               }),
               "instances[0].materials");
  EXPECT_PRED2(starts,
               problem([](Document& d) { d.scene.instances[0].shape = std::shared_ptr<const Mesh>(); }),
               "instances[0]");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.instances[1].shape = SphereShape{0}; }),
               "instances[1].radius");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.instances[1].world_from_object[2][1] = NAN; }),
               "instances[1].transform");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.camera.target = d.scene.camera.position; }),
               "camera.target");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.camera.up = {0, 0, 3}; }), "camera.up");
  EXPECT_PRED2(starts, problem([](Document& d) { d.scene.camera.up = vec3(0); }), "camera.up");
  for (int field : {0, 1, 2})
    EXPECT_PRED2(starts, problem([&](Document& d) {
                   auto mesh = std::make_shared<Mesh>(
                       *std::get<std::shared_ptr<const Mesh>>(d.scene.instances[0].shape));
                   mesh->triangles[0][field] = 3;
                   d.scene.instances[0].shape = std::shared_ptr<const Mesh>(mesh);
                 }),
                 "instances[0].mesh");
}

TEST(SettingsTable, CameraMotionThatEndsWithoutAViewIsAProblem) {
  Document document;
  EXPECT_EQ(document_problem(document), "");
  Camera& camera = document.scene.camera;
  camera.motion_target = camera.position - camera.target; // at time 1 the target is where the camera stands
  EXPECT_EQ(document_problem(document).rfind("camera.motion_", 0), 0u) << document_problem(document);
  camera.motion_target = vec3(0);
  camera.motion_position = {1, 2, 3};
  EXPECT_EQ(document_problem(document), "");
}
} // namespace
