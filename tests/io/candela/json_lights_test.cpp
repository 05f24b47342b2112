// Files, groups and skies of lights in Candela JSON.

#include "io/candela/candela_json.h"
#include "io/scene_export.h"
#include "io/scene_files.h"
#include "scene/scene_files.h"

namespace candela {
namespace {

using test::says;
using test::SceneFiles;

/// A quarter of 10, 20 and 30 cd; the multiplier doubles them.
const char* const kLamp = "IESNA:LM-63-2002\n[TEST] made here\nTILT=NONE\n"
                          "1 -1 2 3 2 1 2 0 0 0\n1 1 15\n0 45 90\n0 90\n10 20 30\n1 2 3\n";

TEST(JsonLights, ReadPhotometricFilesBesideTheScene) {
  SceneFiles files;
  files.write("lamps/lamp.ies", kLamp);
  files.write("s.json", R"({"candela": 1, "lights": [
      {"profile": "lamps/lamp.ies", "strength": "power", "roll": 30, "direction": [1, 0, 0], "temperature": 2700},
      {"type": "spot", "profile": "lamps/lamp.ies"}]})");
  LoadedScene loaded = files.read("s.json");
  EXPECT_EQ(files.warnings(loaded), std::vector<std::string>{});
  const auto& lights = loaded.document.scene.lights;
  const auto profile = light_profile(lights[0]);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile, light_profile(lights[1])) << "one file is read once";
  EXPECT_EQ(profile->maximum(), 60);
  EXPECT_EQ(profile->horizontal.size(), 5u) << "completed by its symmetry";
  EXPECT_EQ(std::get<PointLightModel>(lights[0].model).strength, ProfileStrength::power);
  EXPECT_EQ(lights[0].temperature, 2700);
  EXPECT_TRUE(source_files(loaded.document.scene).contains(profile->source));
  write_candela_json(loaded.document, files / "copy.json");
  EXPECT_NE(test::read_text(files / "copy.json").find("\"profile\": \"lamps/lamp.ies\""), std::string::npos);
  EXPECT_TRUE(same_content(files.read("copy.json").document, loaded.document));
  // Another profile is another light.
  Document other = loaded.document;
  auto brighter = std::make_shared<IesProfile>(*profile);
  brighter->candela[0] *= 2;
  set_profile(other.scene.lights[1], brighter);
  EXPECT_FALSE(same_content(other, loaded.document));
}

TEST(JsonLights, CopyPhotometricFilesOrWriteThemInline) {
  SceneFiles files;
  files.write("in/lamp.ies", kLamp);
  files.write("in/s.json", R"({"candela": 1, "lights": [{"profile": "lamp.ies"}]})");
  Document document = files.read("in/s.json").document;
  std::filesystem::create_directory(files / "out");
  const auto copied = export_candela_json(document, files / "out/scene.json");
  ASSERT_EQ(copied.size(), 1u);
  EXPECT_EQ(files.without_folder(copied[0].to), "out/scene_files/lamp.ies");
  std::filesystem::remove_all(files / "in");
  EXPECT_EQ(light_profile(files.read("out/scene.json").document.scene.lights[0])->candela,
            light_profile(document.scene.lights[0])->candela);
  export_candela_json(document, files / "inline.json"); // the file is gone
  const auto again = light_profile(files.read("inline.json").document.scene.lights[0]);
  const auto before = light_profile(document.scene.lights[0]);
  EXPECT_EQ(again->candela, before->candela);
  EXPECT_EQ(again->type, before->type);
  ASSERT_EQ(again->vertical.size(), before->vertical.size());
  ASSERT_EQ(again->horizontal.size(), before->horizontal.size());
  for (std::size_t i = 0; i < again->horizontal.size(); ++i)
    EXPECT_NEAR(again->horizontal[i], before->horizontal[i], 1e-6f);
}

TEST(JsonLights, ReadPicturesOfProjectorsAndPoints) {
  SceneFiles files;
  files.write("a.png", test::tiny_png());
  files.write("s.json", R"({"candela": 1, "lights": [
      {"type": "projector", "file": "a.png", "vertical_fov": 50, "roll": 10},
      {"type": "point", "image": {"width": 1, "height": 2, "pixels": [1, 2, 3, 4, 5, 6]}},
      {"type": "projector"}]})");
  LoadedScene loaded = files.read("s.json");
  EXPECT_EQ(files.warnings(loaded), std::vector<std::string>{});
  const auto& lights = loaded.document.scene.lights;
  EXPECT_EQ(light_panorama(lights[0])->image.pixels, (std::vector<vec3>{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(light_panorama(lights[1])->image.at(0, 1), vec3(4, 5, 6));
  EXPECT_FALSE(light_panorama(lights[2]));
  write_candela_json(loaded.document, files / "copy.json");
  EXPECT_TRUE(same_content(files.read("copy.json").document, loaded.document));
}

TEST(JsonLights, KeepGroups) {
  SceneFiles files;
  files.write("s.json", R"({"candela": 1,
      "materials": [{"emission": 3, "group": "street"}],
      "lights": [{"group": "street"}, {"type": "sky", "sun_by": "place", "month": 12, "group": "sky"}],
      "light_groups": [{"name": "street", "on": false}, {"name": "sky", "scale": 0.5, "color": [1, 0.5, 0], "solo": true}]})");
  LoadedScene loaded = files.read("s.json");
  const SceneDesc& scene = loaded.document.scene;
  EXPECT_EQ(scene.materials[0].group, "street");
  EXPECT_EQ(scene.lights[1].group, "sky");
  ASSERT_EQ(scene.light_groups.size(), 2u);
  EXPECT_FALSE(scene.light_groups[0].on);
  EXPECT_EQ(scene.light_groups[1].scale, 0.5f);
  EXPECT_EQ(scene.light_groups[1].color, vec3(1, 0.5f, 0));
  EXPECT_TRUE(scene.light_groups[1].solo);
  write_candela_json(loaded.document, files / "copy.json");
  EXPECT_TRUE(same_content(files.read("copy.json").document, loaded.document));
}

TEST(JsonLights, SayWhatIsWrongWhere) {
  SceneFiles files;
  files.write("lamp.ies", kLamp);
  files.write("bad.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 2 3 2 1 2 0 0 0\n1 1 15\n0 45 30\n0 90\n1 2 3\n1 2 3\n");
  files.write("a.png", test::tiny_png());
  struct Case {
    const char *text, *start, *part;
  };
  for (
      const Case& c :
      {Case{R"({"candela": 1, "lights": [{"profile": "bad.ies"}]})",
            "bad.ies:5:6: vertical angles: ", "30 follows 45"},
       Case{R"({"candela": 1, "lights": [{"profile": "none.ies"}]})",
            "s.json:1:39: lights[0].profile: ", "none.ies"},
       Case{R"({"candela": 1, "lights": [{"profile": "../lamp.ies"}]})",
            "s.json:1:39: lights[0].profile: ", ""},
       Case{R"({"candela": 1, "lights": [{"profile": 3}]})", "s.json:1:39: lights[0].profile: ", ""},
       Case{R"({"candela": 1, "lights": [{"type": "sky", "profile": "lamp.ies"}]})",
            "s.json:1:54: lights[0]: ", "only a point or a spot light"},
       Case{R"({"candela": 1, "lights": [{"type": "spot", "file": "a.png"}]})",
            "s.json:1:52: lights[0]: ", "a projector have a picture"},
       Case{R"({"candela": 1, "lights": [{"type": "projector", "files": ["a.png"]}]})",
            "s.json:1:58: lights[0]: ", "only an environment has six"},
       Case{R"({"candela": 1, "lights": [{"profile": "lamp.ies", "file": "a.png"}]})",
            "s.json:1:27: lights[0]: profile: ", "there is a picture, too"},
       Case{
           R"({"candela": 1, "lights": [{"profile": {"vertical": [0, 90], "horizontal": [0], "candela": [1]}}]})",
           "s.json:1:39: lights[0].profile: ", "do not fit its angles"},
       Case{
           R"({"candela": 1, "lights": [{"profile": {"vertical": [0, 90], "horizontal": [0], "candela": [1, -1]}}]})",
           "s.json:1:39: lights[0].profile: ", "no intensity"},
       Case{R"({"candela": 1, "lights": [{"profile": {"type": "d"}}]})",
            "s.json:1:48: lights[0].profile.type: ", "a, b or c"},
       Case{R"({"candela": 1, "lights": [{"group": 1}]})", "s.json:1:37: lights[0].group: ", ""},
       Case{R"({"candela": 1, "light_groups": [{"name": ""}]})", "s.json:1:32: light_groups: ", "is empty"},
       Case{R"({"candela": 1, "light_groups": [{"name": "a"}, {"name": "a"}]})",
            "s.json:1:32: light_groups: ", "twice"},
       Case{R"({"candela": 1, "light_groups": [{"nam": "a"}]})", "s.json:1:34: light_groups[0]", "'name'"},
       Case{R"({"candela": 1, "lights": [{"type": "sky", "month": 13}]})",
            "s.json:1:52: lights[0].month: ", "12"}}) {
    files.write("s.json", c.text);
    EXPECT_TRUE(says(files.error("s.json"), c.start, {c.part})) << c.text;
  }
}

} // namespace
} // namespace candela
