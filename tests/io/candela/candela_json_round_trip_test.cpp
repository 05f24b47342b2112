// Documents that are written and read back are equal, bit for bit.

#include "io/scene_files.h"
#include "support/materials.h"
#include "support/seed.h"
#include "support/textures.h"

#include <algorithm>
#include <cstring>
#include <random>

namespace candela {
namespace {

using test::use_of;

using test::mesh_of;
using test::SceneFiles;

struct CandelaJsonRoundTrip : ::testing::Test {
  SceneFiles files;

  /// Writes, reads, compares, writes again.
  LoadedScene check(const Document& document, const std::string& name = "out.json") {
    write_candela_json(document, files / name);
    LoadedScene again = files.read(name);
    EXPECT_TRUE(same_content(document, again.document)) << test::read_text(files / name).substr(0, 4000);
    EXPECT_EQ(candela_json(again.document, folder_of(files / name)), test::read_text(files / name));
    return again;
  }
};

/// A random value within the row's domain.
template <class Owner>
void randomise(const Field<Owner>& row, Owner& owner, std::mt19937& random) {
  void* address = row.address(owner);
  double low = std::max(row.minimum, -1e6), high = std::min(row.maximum, 1e6);
  auto real = [&] { return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random)); };
  std::uniform_int_distribution<int> coin(0, 1);
  switch (row.type) {
  case FieldType::boolean: *static_cast<bool*>(address) = coin(random) == 1; break;
  case FieldType::integer:
    *static_cast<int*>(address) =
        std::uniform_int_distribution<int>(static_cast<int>(low), static_cast<int>(high))(random);
    break;
  case FieldType::material: *static_cast<int*>(address) = coin(random) - 1; break; // none, or the first
  case FieldType::real: *static_cast<float*>(address) = real(); break;
  case FieldType::angle: *static_cast<float*>(address) = radians(real()); break;
  case FieldType::choice: {
    int value = std::uniform_int_distribution<int>(0, static_cast<int>(row.choices.size()) - 1)(random);
    std::memcpy(address, &value, sizeof value);
    break;
  }
  case FieldType::point:
  case FieldType::color: {
    vec3& v = *static_cast<vec3*>(address);
    for (int i = 0; i < 3; ++i) v[i] = real();
  }
  }
  if (!field_problem(row, address).empty()) { // rounding took it over the edge
    Owner standard;
    field_copy(row, address, row.address(standard));
  }
}

TEST_F(CandelaJsonRoundTrip, NothingIsNearlyNothing) {
  EXPECT_EQ(candela_json(Document{}, files.path()), "{\n  \"candela\": 1\n}\n");
  check(Document{});
}

TEST_F(CandelaJsonRoundTrip, TheDescriptionWithItsQuotesAndLines) {
  Document d;
  d.scene.description = "Try \"view\" = depth;\nand \\ more";
  check(d);
}

TEST_F(CandelaJsonRoundTrip, BookmarksWithEveryRowOfTheirCameras) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  Document document;
  for (const auto& row : settings_table()) {
    if (!row.key.starts_with("camera.")) continue;
    Document other;
    randomise(row, other, random);
    if (row.key == "camera.up") other.scene.camera.up.x += 1; // not along the view
    document.scene.bookmarks.push_back({"\"" + std::string(row.key) + "\"\n\xc3\xa4", other.scene.camera});
  }
  ASSERT_GT(document.scene.bookmarks.size(), 8u);
  const LoadedScene again = check(document);
  EXPECT_EQ(again.document.scene.bookmarks, document.scene.bookmarks);
  EXPECT_EQ(again.document.scene.camera, Camera{}) << "a bookmark's camera is not the scene's";
}

TEST_F(CandelaJsonRoundTrip, EveryRowOfEveryTableInIsolation) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  for (const auto& row : settings_table()) {
    Document document;
    randomise(row, document, random);
    SCOPED_TRACE(std::string(row.key));
    if (row.key == "camera.up") document.scene.camera.up.x += 1; // not along the view
    check(document);
  }
  for (int type = 0; type < kMaterialTypeCount; ++type)
    for (const auto& row : material_fields(type)) {
      Document document;
      document.scene.materials.resize(2);
      document.scene.materials[1] = default_material(type);
      check(document);
      randomise(row, document.scene.materials[1], random);
      check(document);
    }
  for (int type = 0; type < kLightTypeCount; ++type)
    for (const auto& row : light_fields(type)) {
      Document document;
      document.scene.lights = {default_light(0), default_light(type)};
      randomise(row, document.scene.lights[1], random);
      check(document);
    }
}

TEST_F(CandelaJsonRoundTrip, RandomDocuments) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  for (int round = 0; round < 30; ++round) {
    Document document;
    for (const auto& row : settings_table()) randomise(row, document, random);
    for (int i = 0; i < 5; ++i) {
      Material material = default_material(i % kMaterialTypeCount);
      material.name = i == 4 ? "material 3" : "material " + std::to_string(i); // two of one name
      if (i == 0) material.name.clear();
      for (const auto& row : material_fields(material)) randomise(row, material, random);
      document.scene.materials.push_back(material);
      LightDesc light = default_light(i % kLightTypeCount);
      for (const auto& row : light_fields(light)) randomise(row, light, random);
      document.scene.lights.push_back(light);
    }
    std::normal_distribution<float> normal(0, 100);
    auto mesh = std::make_shared<Mesh>();
    mesh->name = "a \"quoted\"\n näme";
    for (int i = 0; i < 50; ++i) {
      mesh->positions.emplace_back(normal(random), normal(random), normal(random) * 1e-30f);
      mesh->normals.push_back(i % 3 == 0 ? vec3(0) : glm::normalize(vec3(normal(random), normal(random), 1)));
      mesh->uvs.emplace_back(normal(random), normal(random));
      mesh->vertex_colors.push_back(glm::abs(vec3(normal(random), normal(random), 1e-30f)));
    }
    std::uniform_int_distribution<std::uint32_t> vertex(0, 49), slot(0, 2);
    mesh->slot_names = {"", "x", "y z"};
    for (int i = 0; i < 20; ++i) {
      mesh->triangles.emplace_back(vertex(random), vertex(random), vertex(random));
      mesh->material_slots.push_back(slot(random));
      mesh->face_colors.push_back(glm::abs(vec3(normal(random), 0, normal(random))));
    }
    auto twin = std::make_shared<Mesh>(*mesh); // another mesh of the same name
    twin->slot_names = {"s", "s", "t"};
    Shape shapes[] = {std::shared_ptr<const Mesh>(mesh),
                      std::shared_ptr<const Mesh>(twin),
                      std::shared_ptr<const Mesh>(mesh),
                      SphereShape{std::abs(normal(random))},
                      RectangleShape{},
                      DiscShape{},
                      PlaneShape{},
                      CubeShape{},
                      CylinderShape{std::abs(normal(random)), std::abs(normal(random)), round % 2 == 0},
                      ConeShape{std::abs(normal(random)), 1, round % 3 == 0},
                      TorusShape{200, std::abs(std::fmod(normal(random), 200.0f))}};
    for (const Shape& shape : shapes) {
      Instance instance;
      instance.name = round % 2 ? "i" : "";
      instance.shape = shape;
      std::uniform_int_distribution<int> material(0, 4);
      std::size_t slots = std::holds_alternative<std::shared_ptr<const Mesh>>(shape) ? 3 : 1;
      for (std::size_t i = 0; i < slots; ++i) instance.materials.push_back(material(random));
      for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) instance.world_from_object[c][r] = normal(random);
      document.scene.instances.push_back(instance);
    }
    LoadedScene again = check(document);
    EXPECT_EQ(&mesh_of(again, 0), &mesh_of(again, 2)) << "shared meshes are shared again";
    EXPECT_NE(&mesh_of(again, 0), &mesh_of(again, 1));
  }
}

TEST_F(CandelaJsonRoundTrip, AnglesAreExact) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  const auto* row = find_setting("camera.vertical_fov");
  std::uniform_real_distribution<float> angle(0.0018f, 3.1f);
  for (int i = 0; i < 100000; ++i) {
    Document document, again;
    document.scene.camera.vertical_fov = angle(random);
    field_from_text(*row, row->address(again), field_text(*row, document));
    ASSERT_EQ(document.scene.camera.vertical_fov, again.scene.camera.vertical_fov)
        << field_text(*row, document);
  }
  for (int degrees_value = 1; degrees_value < 180; ++degrees_value) {
    Document document;
    field_from_text(*row, row->address(document), std::to_string(degrees_value));
    EXPECT_EQ(field_text(*row, document), std::to_string(degrees_value)) << "what was typed is shown";
  }
}

TEST_F(CandelaJsonRoundTrip, MeshFilesInsideAreNamedOthersCopied) {
  files.write("scenes/m/x.obj", "v 0 0 0\nv 1 0 0\nv 0 0.1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n");
  files.write("scenes/s.json", R"({"candela": 1, "instances": [{"file": "m/x.obj"}, {"mesh": "y"}],
                                   "meshes": {"y": {"file": "m/x.obj"}}})");
  LoadedScene loaded = files.read("scenes/s.json");
  LoadedScene beside = check(loaded.document, "scenes/beside.json");
  EXPECT_NE(test::read_text(files / "scenes/beside.json").find("\"x\": {\"file\": \"m/x.obj\"}"),
            std::string::npos);
  check(loaded.document, "above.json");
  EXPECT_NE(test::read_text(files / "above.json").find("\"scenes/m/x.obj\""), std::string::npos);
  std::filesystem::create_directory(files / "elsewhere");
  LoadedScene elsewhere = check(loaded.document, "elsewhere/s.json");
  EXPECT_NE(test::read_text(files / "elsewhere/s.json").find("\"positions\""), std::string::npos);
  std::filesystem::remove_all(files / "scenes/m");
  EXPECT_TRUE(same_content(loaded.document, files.read("elsewhere/s.json").document)) << "it stands alone";
}

TEST_F(CandelaJsonRoundTrip, Textures) {
  files.write("t/a.png", test::tiny_png());
  files.write("t/b.png", test::tiny_png());
  files.write("s.json",
              R"({"candela": 1, "materials": [{"diffuse_texture": "t/a.png"}, {"diffuse_texture": "t/b.png"},
                                                        {"diffuse_texture": "t/a.png"}]})");
  Document document = files.read("s.json").document;
  ASSERT_EQ(document.scene.textures.size(), 2u);
  check(document);
  EXPECT_EQ(test::read_text(files / "out.json").find("\"textures\""), std::string::npos);
  std::swap(use_of(document.scene.materials[0]).texture, use_of(document.scene.materials[1]).texture);
  check(document); // an order that the materials do not give
  auto made = std::make_shared<Texture>(*test::picture_texture(1, 2, {1, 2, 3, 4, 5, 255}));
  made->name = "made";
  document.scene.textures.push_back(made);
  use_of(document.scene.materials[2]).texture = 2;
  check(document);
}

/// Every channel count and precision, and every other kind.
std::vector<std::shared_ptr<const Texture>> all_textures() {
  std::vector<std::shared_ptr<const Texture>> all;
  auto add = [&](const char* name, TextureModel model) {
    all.push_back(std::make_shared<const Texture>(Texture{name, std::move(model)}));
  };
  auto picture = [&](const char* name, int channels, Texels::Data data) {
    add(name, ImageTexture{"", std::make_shared<const Texels>(Texels{2, 1, channels, std::move(data)})});
  };
  picture("grey", 1, std::vector<std::uint8_t>{0, 255});
  picture("alpha", 4, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8});
  picture("deep", 3, std::vector<std::uint16_t>{1, 65535, 3, 4, 5, 6});
  picture("float", 1, std::vector<float>{-1.5f, 1e9f / 3});
  add("checker", CheckerTexture{{0.1f, 0.2f, 7}, {0.3f, 0.4f, 1 / 3.0f}, 2.5f});
  for (std::string_view kind : texture_kind_names())
    if (kind != ImageTexture::kName) add("default", *texture_of_kind(kind));
  return all;
}

TEST_F(CandelaJsonRoundTrip, EveryKindOfTexture) {
  Document document;
  document.scene.textures = all_textures();
  check(document);
}

TEST_F(CandelaJsonRoundTrip, EveryParameterAsATextureWithEveryRowOfItsUse) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  Document document;
  document.scene.textures = all_textures();
  for (int type = 0; type < kMaterialTypeCount; ++type) {
    const Material standard = default_material(type);
    each_parameter(standard, [&](const MaterialField& row, const ParameterRef&) {
      auto add = [&](auto edit) {
        Material m = standard;
        const ParameterRef parameter = find_parameter(m, row.key);
        parameter.use().texture = 4;
        edit(parameter);
        document.scene.materials.push_back(m);
      };
      add([](const ParameterRef&) {});
      add([&](const ParameterRef& p) { p.use().uv = {{2, 0.1f}, {-3, 1 / 3.0f}, 0.7f}; });
      add([&](const ParameterRef& p) {
        if (p.number != nullptr)
          p.number->offset = -0.7f;
        else
          p.color->offset = {1, -2, 1 / 3.0f};
      });
      for (const auto& part : texture_use_fields())
        add([&](const ParameterRef& p) {
          const TextureUse before = p.use();
          while (p.use() == before) randomise(part, p.use(), random);
        });
    });
  }
  EXPECT_GT(document.scene.materials.size(), 100u);
  const LoadedScene again = check(document);
  for (std::size_t i = 0; i < document.scene.materials.size(); ++i)
    EXPECT_EQ(again.document.scene.materials[i], document.scene.materials[i]) << i;
}

TEST_F(CandelaJsonRoundTrip, MaterialsOfMaterials) {
  files.write("s.json", R"({"candela": 1, "materials": [
      {"name": "rusty", "type": "blend", "first": "steel", "second": 2, "weight": {"texture": 0, "channel": "green"}},
      {"name": "steel", "type": "conductor"}, {"name": "twin"}, {"name": "twin"},
      {"type": "two_sided", "front": "rusty", "back": 3, "opacity": 0.5},
      {"name": "air", "type": "null", "absorption": [1, 2, 3]}, {"type": "blend", "second": "steel"}],
    "textures": [{"type": "checker", "name": "mask"}]})");
  const LoadedScene loaded = files.read("s.json");
  const auto& materials = loaded.document.scene.materials;
  const auto& rusty = std::get<BlendMaterial>(materials[0].model);
  EXPECT_EQ(rusty.first, 1) << "which comes later in the file";
  EXPECT_EQ(rusty.second, 2);
  EXPECT_EQ(rusty.weight.use.texture, 0);
  EXPECT_EQ(std::get<TwoSidedMaterial>(materials[4].model), (TwoSidedMaterial{0, 3}));
  EXPECT_EQ(std::get<NullMaterial>(materials[5].model).absorption, vec3(1, 2, 3));
  EXPECT_EQ(std::get<BlendMaterial>(materials[6].model).first, -1);
  const LoadedScene again = check(loaded.document);
  for (std::size_t i = 0; i < materials.size(); ++i)
    EXPECT_EQ(again.document.scene.materials[i], materials[i]) << i;
  EXPECT_NE(test::read_text(files / "out.json").find("\"first\": \"steel\", \"second\": 2"),
            std::string::npos)
      << "by name, where only one has it";
}

TEST_F(CandelaJsonRoundTrip, Panoramas) {
  files.write("sky/a.png", test::tiny_png());
  files.write("s.json", R"({"candela": 1, "lights": [
      {"type": "environment", "file": "sky/a.png", "rotation": 90, "scale": 2},
      {"type": "environment", "file": "sky/a.png", "mapping": "angular", "up": [0, 0, 1]},
      {"type": "environment", "files": ["sky/a.png", "sky/a.png", "sky/a.png", "sky/a.png", "sky/a.png", "sky/a.png"]}]})");
  Document document = files.read("s.json").document;
  const auto& lights = document.scene.lights;
  ASSERT_EQ(lights.size(), 3u);
  ASSERT_TRUE(light_panorama(lights[0]));
  EXPECT_EQ(light_panorama(lights[0]), light_panorama(lights[1])) << "one file is read once";
  EXPECT_EQ(light_panorama(lights[0])->image.pixels, (std::vector<vec3>{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(std::get<EnvironmentLightModel>(lights[2].model).mapping, EnvironmentMapping::faces);
  EXPECT_EQ(light_panorama(lights[2])->image.height, 6);
  check(document);
  EXPECT_NE(test::read_text(files / "out.json").find("\"file\": \"sky/a.png\""), std::string::npos);
  auto made = std::make_shared<Panorama>();
  made->name = "made";
  made->image = {2, 1, {{0, 1e-30f, 0.1f}, {1e9f, 3, 1.0f / 3}}};
  std::get<EnvironmentLightModel>(document.scene.lights[1].model).panorama = made;
  check(document);
}

TEST_F(CandelaJsonRoundTrip, AnInvalidDocumentIsNotWritten) {
  Document document;
  document.settings.film.width = 0;
  try {
    write_candela_json(document, files / "bad.json");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::output);
    EXPECT_NE(std::string(e.what()).find("film.width"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(std::filesystem::exists(files / "bad.json"));
}

} // namespace
} // namespace candela
