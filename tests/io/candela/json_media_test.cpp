// Media in Candela JSON.

#include "io/candela/candela_json.h"
#include "io/scene_files.h"
#include "support/seed.h"

namespace candela {
namespace {

using test::SceneFiles;

TEST(JsonMedia, AreReadByName) {
  SceneFiles files;
  files.write("s.json", R"({"candela": 1, "medium": "fog", "media": [
      {"name": "fog", "sigma_t": 0.1, "albedo": [0.9, 0.8, 0.7], "scale": 2, "emission": 3,
       "phase": {"type": "droplets", "diameter": 12}},
      {"name": "milk", "type": "measured", "material": "whole_milk",
       "phase": {"g": 0.8, "type": "henyey_greenstein"}}],
      "materials": [{"type": "null", "medium": "milk"}]})");
  const SceneDesc scene = files.read("s.json").document.scene;
  EXPECT_EQ(scene.medium, "fog");
  ASSERT_EQ(scene.media.size(), 2u);
  EXPECT_EQ(std::get<HomogeneousMediumModel>(scene.media[0].model),
            (HomogeneousMediumModel{vec3(0.1f), {0.9f, 0.8f, 0.7f}}));
  EXPECT_EQ(scene.media[0].scale, 2);
  EXPECT_EQ(scene.media[0].emission, vec3(3));
  EXPECT_EQ(std::get<DropletsPhase>(scene.media[0].phase.model).diameter, 12);
  const int measured = std::get<MeasuredMediumModel>(scene.media[1].model).material;
  EXPECT_EQ(kMeasuredNames[static_cast<std::size_t>(measured)], "whole_milk");
  EXPECT_EQ(std::get<HenyeyGreensteinPhase>(scene.media[1].phase.model).g, 0.8f);
  EXPECT_EQ(scene.materials[0].medium, "milk");
}

/// A fire is a light: nobody is told that the picture will be black.
TEST(JsonMedia, WhatGlowsIsLight) {
  SceneFiles files;
  const auto warnings = [&](const std::string& rest) {
    std::string text = R"({"candela": 1, "media": [{"name": "fire", "emission": 3}],
      "materials": [{"name": "hull", "type": "null", "medium": "fire"}, {"name": "wall"}], )";
    text += rest;
    files.write("s.json", text);
    return files.read("s.json").warnings.size();
  };
  EXPECT_EQ(warnings(R"("medium": "fire"})"), 0u);
  EXPECT_EQ(warnings(R"("instances": [{"shape": "sphere", "material": "hull"}]})"), 0u);
  EXPECT_EQ(warnings(R"("instances": [{"shape": "sphere", "material": "wall"}]})"), 1u);
}

TEST(JsonMedia, AreWrittenAsTheyAre) {
  SceneFiles files;
  for (int type = 0; type < static_cast<int>(medium_type_field().choices.size()); ++type)
    for (int phase = 0; phase < static_cast<int>(phase_type_field().choices.size()); ++phase) {
      Document document;
      MediumDesc medium = default_medium(type), plain;
      medium.name = "\"a\" medium", plain.name = "plain";
      medium.phase = default_phase(phase);
      medium.scale = 0.25f;
      if (auto* lobe = std::get_if<HenyeyGreensteinPhase>(&medium.phase.model)) lobe->g = -0.5f;
      if (auto* same = std::get_if<HomogeneousMediumModel>(&medium.model)) same->albedo = {1, 0.5f, 0};
      if (auto* measured = std::get_if<MeasuredMediumModel>(&medium.model)) measured->material = 2;
      document.scene.media = {medium, plain};
      document.scene.medium = "plain";
      document.scene.materials.resize(1);
      document.scene.materials[0].medium = medium.name;
      write_candela_json(document, files / "out.json");
      const Document again = files.read("out.json").document;
      EXPECT_TRUE(same_content(document, again)) << test::read_text(files / "out.json");
      EXPECT_EQ(again.scene.media, document.scene.media);
    }
}

TEST(JsonMedia, AnEditOfAMediumIsAnEdit) {
  Document a;
  a.scene.media.resize(1);
  a.scene.media[0].name = "fog";
  a.scene.materials.resize(1);
  Document b = a;
  b.scene.media[0].scale = 2;
  EXPECT_FALSE(same_content(a, b));
  EXPECT_EQ(compare_documents(a, b), Invalidates::image);
  b = a;
  b.scene.medium = "fog";
  EXPECT_EQ(compare_documents(a, b), Invalidates::image);
  EXPECT_FALSE(same_content(a, b));
  b = a;
  b.scene.materials[0].medium = "fog";
  EXPECT_EQ(compare_documents(a, b), Invalidates::image);
  EXPECT_EQ(document_problem(b), "");
  b.scene.media.clear();
  EXPECT_EQ(document_problem(b).substr(0, 20), "materials[0].medium:");
}

std::string tiny_volume() {
  const float values[] = {0, 1, 0.5f, 2};
  return "candela volume 1\ncells 2 2 1\nbounds 0 0 0 2 4 1\nchannels density\ndata\n" +
         std::string(reinterpret_cast<const char*>(values), sizeof(values));
}

TEST(JsonMedia, AGridIsAFileInTheScenesFolder) {
  SceneFiles files;
  files.write("fx/smoke.cvol", tiny_volume());
  files.write("s.json", R"({"candela": 1, "media": [
      {"name": "smoke", "type": "grid", "file": "fx/smoke.cvol", "sigma_t": 3, "center": [1, 2, 3], "size": [2, 4, 1]},
      {"name": "again", "type": "grid", "file": "fx/smoke.cvol"}], "lights": [{}]})");
  const LoadedScene loaded = files.read("s.json");
  EXPECT_EQ(files.warnings(loaded), std::vector<std::string>{});
  const auto& media = loaded.document.scene.media;
  const auto grid = medium_grid(media.at(0));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->density, (std::vector<float>{0, 1, 0.5f, 2}));
  EXPECT_EQ(medium_grid(media.at(1)), grid) << "a file is read once";
  EXPECT_TRUE(loaded.files.contains(grid->source));
  write_candela_json(loaded.document, files / "out.json");
  EXPECT_NE(test::read_text(files / "out.json").find("\"file\": \"fx/smoke.cvol\""), std::string::npos);
  EXPECT_TRUE(same_content(loaded.document, files.read("out.json").document));
  Document other = loaded.document;
  auto changed = std::make_shared<VolumeGrid>(*grid);
  changed->density[0] = 1;
  set_medium_grid(other.scene.media[0], changed);
  EXPECT_FALSE(same_content(loaded.document, other));
}

TEST(JsonMedia, AGridsFileIsCheckedAsAllOthers) {
  SceneFiles files;
  files.write("bad.cvol", "candela volume 1\ncells 2 2 1\n");
  files.write("in/x.json",
              R"({"candela": 1, "media": [{"name": "a", "type": "grid", "file": "../bad.cvol"}]})");
  EXPECT_THROW(files.read("in/x.json"), Error);
  const std::pair<const char*, const char*> kCases[] = {
      {R"("type": "grid", "file": "none.vdb")", "media[0].file"},
      {R"("type": "grid", "file": "bad.cvol")", "bad.cvol:2: header: there is no line 'data'"},
      {R"("type": "grid", "file": 3)", "media[0].file"},
      {R"("file": "bad.cvol")", "there is no key 'file'"},
      {R"("type": "procedural", "pattern": "rain")", "media[0].pattern"},
      {R"("type": "procedural", "resolution": 5000)", "media[0].resolution"},
  };
  for (const auto& [members, said] : kCases) {
    files.write("s.json", std::string(R"({"candela": 1, "media": [{"name": "a", )") + members + "}]}");
    try {
      files.read("s.json");
      ADD_FAILURE() << members;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

} // namespace
} // namespace candela
