#include "io/scene_files.h"

namespace candela {
namespace {

using test::SceneFiles;

struct IniJobs : ::testing::Test {
  SceneFiles files;
  IniJobs() {
    for (const char* name : {"s.xml", "cs/a/b/c/d/near.xml", "cs/example.xml"}) files.write(name, kScene);
  }
  static constexpr const char* kScene =
      "<scenefile><lightdata/><object type='tree' name='root'/></scenefile>";
};

TEST_F(IniJobs, SettingsInTheTermsOfTheTable) {
  files.write(
      "j.ini",
      "; a comment\n# another\n[IO]\r\n  scene = s.xml\n output = \"out/my picture.png\"\n\n[Settings]\n"
      "imageWidth=640\nimageHeight = 480\nsamplesPerPixel = 50\npathContinuationProb = 0.25\n"
      "directLightingOnly = true\nnumDirectLightingSamples = 4\n");
  auto loaded = files.read("j.ini");
  const RenderSettings& s = loaded.document.settings;
  EXPECT_EQ(loaded.output_files, std::vector<std::string>{"out/my picture.png"});
  EXPECT_EQ(s.film.width, 640);
  EXPECT_EQ(s.film.height, 480);
  EXPECT_EQ(s.stop.spp, 50);
  EXPECT_EQ(s.path.rr, RussianRoulette::fixed);
  EXPECT_EQ(s.path.rr_probability, 0.25f);
  EXPECT_EQ(s.path.rr_depth, 1);
  EXPECT_EQ(s.path.max_depth, 2);
  EXPECT_EQ(s.path.light_samples, 4);
  EXPECT_EQ(s.path.light_sampling, LightSampling::mis);
  EXPECT_EQ(s.display.tone_map, ToneMap::reinhard);
  EXPECT_EQ(s.display.exposure, -0.65f);
  EXPECT_EQ(loaded.document.scene.lights.size(), 1u);

  files.write("j.ini", "[Settings]\ndirectLightingOnly = false\n[IO]\nscene = s.xml\n");
  loaded = files.read("j.ini");
  EXPECT_EQ(loaded.document.settings.path.max_depth, -1);
  EXPECT_EQ(loaded.document.settings.path.rr, RussianRoulette::throughput)
      << "the default without a probability";
  EXPECT_TRUE(loaded.output_files.empty());
}

// As in QSettings.
TEST_F(IniJobs, CommentsMayFollowValues) {
  files.write("j.ini",
              "[IO] ; where\nscene = s.xml ; the scene\noutput = \"a;b.png\" ; in quotes\n"
              "[Settings];\nimageWidth = 32 ; width\nimageHeight=48;height\ndirectLightingOnly = True\n");
  auto loaded = files.read("j.ini");
  EXPECT_EQ(loaded.document.settings.film.width, 32);
  EXPECT_EQ(loaded.document.settings.film.height, 48);
  EXPECT_EQ(loaded.document.settings.path.max_depth, 2);
  EXPECT_EQ(loaded.output_files, std::vector<std::string>{"a;b.png"});
  files.write("j.ini", "[Settings]\nimageWidth = ; none\n");
  EXPECT_TRUE(test::says(files.error("j.ini"), "j.ini:2:", {"no value"}));
}

TEST_F(IniJobs, TheSceneIsLookedForAbove) {
  auto job = [&](const std::string& name, const std::string& scene) {
    files.write(name, "[IO]\nscene = " + scene + "\n");
  };
  job("cs/a/b/j.ini", "example-scenes/example.xml");
  EXPECT_EQ(files.read("cs/a/b/j.ini").document.scene.lights.size(), 1u) << "two up, without example-scenes/";
  job("cs/a/b/c/d/j.ini", "near.xml");
  files.read("cs/a/b/c/d/j.ini");
  job("cs/a/b/c/d/j.ini", "example.xml");
  files.read("cs/a/b/c/d/j.ini");   // four up
  job("cs/a/b/c/d/j.ini", "s.xml"); // five up
  EXPECT_TRUE(test::says(
      files.error("cs/a/b/c/d/j.ini"),
      "cs/a/b/c/d/j.ini:2:9: scene: there is no file 's.xml' (tried cs/a/b/c/d/s.xml, cs/a/b/c/s.xml, ",
      {"cs/s.xml)"}));
  files.write("example-scenes/s.xml", "<scenefile><object type='tree' name='root'/></scenefile>");
  job("cs/j.ini", "example-scenes/s.xml");
  EXPECT_TRUE(files.read("cs/j.ini").document.scene.lights.empty()) << "the name as it is comes first";
}

TEST_F(IniJobs, ButNotOutside) {
  for (const std::string& scene : std::vector<std::string>{"../s.xml", "x/../../s.xml", files / "s.xml"}) {
    files.write("cs/j.ini", "[IO]\nscene = " + scene + "\n");
    EXPECT_TRUE(test::says(files.error("cs/j.ini"), "cs/j.ini:2:9: scene: ", {"--allow-outside"})) << scene;
  }
  files.write("cs/j.ini", "[IO]\nscene = ../s.xml\n");
  files.read("cs/j.ini", {.allow_outside = true});
  files.write("cs/j.ini", "[IO]\nscene = " + files / "s.xml" + "\n");
  files.read("cs/j.ini", {.allow_outside = true});
}

TEST_F(IniJobs, TheScenesFilesAreBoundToTheScenesFolder) {
  files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  files.write("cs/up.xml", "<scenefile><object type='tree' name='root'><transblock><object type='primitive' "
                           "name='mesh' filename='../m.obj'/></transblock></object></scenefile>");
  files.write("cs/a/j.ini", "[IO]\nscene = up.xml\n");
  EXPECT_TRUE(test::says(files.error("cs/a/j.ini"), "cs/up.xml:1:93: filename: ", {"--allow-outside"}));
}

struct IniError {
  const char* name;
  const char* ini;
  const char* start;
  const char* part;
};
class IniJobErrors : public IniJobs, public ::testing::WithParamInterface<IniError> {};
TEST_P(IniJobErrors, AreLocated) {
  files.write("j.ini", GetParam().ini);
  EXPECT_TRUE(test::says(files.error("j.ini"), GetParam().start, {GetParam().part}));
}
const IniError kIniErrors[] = {
    {"Empty", "", "j.ini:1:1: scene: ", "names no scene"},
    {"NoScene", "[IO]\noutput = x.png\n", "j.ini:1:1: scene: ", "names no scene"},
    {"Section", "[IO]\n [Setings]\n", "j.ini:2:2: job: ", "[IO] and [Settings]"},
    {"OpenSection", "[IO\n", "j.ini:1:1: job: ", "no section [IO"},
    {"NoSection", "scene = s.xml\n", "j.ini:1:1: job: ", "no key 'scene'"},
    {"Line", "[IO]\n  scene\n", "j.ini:2:3: job: ", "neither"},
    {"Key", "[Settings]\n imagewidth = 3\n", "j.ini:2:2: Settings: ", "did you mean imageWidth?"},
    {"Twice", "[Settings]\nimageWidth = 3\nimageWidth = 3\n", "j.ini:3:1: imageWidth: ", "second time"},
    {"NoValue", "[Settings]\nimageWidth =\n", "j.ini:2:13: imageWidth: ", "no value"},
    {"Integer", "[Settings]\nimageWidth = 3.5\n", "j.ini:2:14: imageWidth: ", "an integer from 1 to 16384"},
    {"Range", "[Settings]\nimageHeight = 0\n", "j.ini:2:15: imageHeight: ", "from 1"},
    {"Samples", "[Settings]\nsamplesPerPixel = 0\n", "j.ini:2:19: samplesPerPixel: ", "no picture"},
    {"Probability", "[Settings]\npathContinuationProb = 1.5\n",
     "j.ini:2:24: pathContinuationProb: ", "from 0.01 to 1"},
    {"Nan", "[Settings]\npathContinuationProb = nan\n", "j.ini:2:24: pathContinuationProb: ", "does not fit"},
    {"Boolean", "[Settings]\ndirectLightingOnly = yes\n",
     "j.ini:2:22: directLightingOnly: ", "true or false"},
    {"LightSamples", "[Settings]\nnumDirectLightingSamples = 100000\n",
     "j.ini:2:28: numDirectLightingSamples: ", "from 1 to 64"},
    {"Itself", "[IO]\nscene = j.ini\n", "j.ini: scene: ", "'.ini'"},
};
INSTANTIATE_TEST_SUITE_P(All, IniJobErrors, ::testing::ValuesIn(kIniErrors),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(IniJobsOfTheAssignment, AllAreRead) {
  std::string folder = CANDELA_SHARED_DATA "/cs123/template_inis";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".ini") continue;
    SCOPED_TRACE(entry.path().string());
    auto loaded = read_scene(entry.path().string());
    EXPECT_EQ(loaded.document.scene.instances.size(), 1u);
    EXPECT_EQ(loaded.document.settings.path.rr, RussianRoulette::fixed);
    EXPECT_TRUE(loaded.output_files.at(0).starts_with("student_outputs/"));
    bool direct = entry.path().string().find("direct") != std::string::npos;
    EXPECT_EQ(loaded.document.settings.path.max_depth, direct ? 2 : -1);
    ++count;
  }
  EXPECT_EQ(count, 8);
}

} // namespace
} // namespace candela
