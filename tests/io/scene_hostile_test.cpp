// Damaged scenes of every format: each is rejected with a located message, or gives a valid scene; none
// crashes. Run with sanitizers, too.

#include "io/scene_files.h"
#include "support/seed.h"

#include <fmt/format.h>

#include <random>

namespace candela {
namespace {

using test::SceneFiles;

constexpr const char* kSeedJson = R"({"candela": 1, // version
"camera": {"position": [0, 1, 4], "vertical_fov": 40},
"materials": [{"name": "red", "type": "phong", "diffuse": [0.63, 0.065, 0.05], "specular": 0.2}, {"emission": 1}],
"lights": [{"type": "point", "position": [0, 1, 0]}],
"textures": [{"name": "t", "width": 1, "height": 1, "srgb": [1, 2, 3]}],
"meshes": {"m": {"positions": [[0,0,0],[1,0,0],[0,1e-1,0]], "triangles": [[0,1,2]], "slots": ["a"], "uvs": [[0,0],[1,0],[0,1]]},
"o": {"file": "x.obj"}},
"instances": [{"mesh": "m", "material": "red"}, {"mesh": "o"}, {"shape": "sphere", "radius": 0.5, "material": 1,
"transform": [{"scale": 2}, {"rotate": [0,1,0,45]}, {"look_at": {"origin": [0,0,0], "target": [0,0,1], "up": [0,1,0]}}]}],
"settings": {"path": {"max_depth": 8, "rr": "fixed"}, "view": "radiance"}}
)";
constexpr const char* kSeedObj =
    "mtllib x.mtl\n# comment\nv 0 0 0\nv 1 0 0\nv 1 1.5e-1 \\\n0\nv -.5 1 0 1\nv "
    "0.5 0.5 0\nvt 0 0\nvt 1 0.5\nvn 0 0 1\n"
    "g group\nusemtl a\nf 1/1/1 2/2/1 3/1/1 5/2/1 4/1/1\nf -1 -2 -3\nusemtl b c\ns "
    "1\nf 1//1 2//-1 3//1\nl 1 2\n";
constexpr const char* kMtl =
    "newmtl a\nKd 0.5 0.5 0.5\nKs 0.6\nNs 10\nd -halo 0.5\nmap_Kd -s 1 1 1 t.png\nillum 2\n"
    "newmtl b c\nKe 1 2 3\nTf 0.5 0.5 0.5\nNi 1.5\nillum 7\nTr 0.1\n";
constexpr const char* kSeedXml = R"(<?xml version="1.0"?>
<scenefile><!-- comment --><globaldata><diffusecoeff v="0.5"/></globaldata>
<cameradata><pos x="0" y="1" z="3.6"/><focus x="0" y="1" z="0"/><up x="0" y="1" z="0"/><heightangle v="45"/></cameradata>
<lightdata><id v="0"/><type v="point"/><color r="1" g="1" b="1"/><function a="0" b="0" c="1"/></lightdata>
<object type="tree" name="pair"><transblock><rotate x="0" y="0" z="1" angle="30"/><object type="primitive" name="sphere">
<diffuse r="1" g="0" b="0"/><specular r=".5" g=".5" b=".5"/><shininess v="3"/></object></transblock></object>
<object type="tree" name="root"><transblock><matrix><row a="1" b="0" c="0" d="5"/><row a="0" b="1" c="0" d="0"/>
<row a="0" b="0" c="1" d="0"/><row a="0" b="0" c="0" d="1"/></matrix><object type="master" name="pair"/></transblock>
<transblock><object type="primitive" name="mesh" filename="x.obj"><transparent r="1" g="1" b="1"/></object></transblock></object>
</scenefile>
)";
constexpr const char* kIni =
    "[IO]\n scene = s.xml\n output = out.png\n; comment\n[Settings]\n imageWidth = 64\n samplesPerPixel = 5\n"
    " pathContinuationProb = 0.9\n directLightingOnly = false\n numDirectLightingSamples = 1\n";

struct Format {
  const char* file; ///< that is damaged
  const char* read; ///< that is read
  const char* text;
  /// Whether damage often affects only a vertex, a face or a statement.
  bool tolerant = false;
};

class HostileScenes : public ::testing::TestWithParam<Format> {
protected:
  HostileScenes() {
    files.write("t.png", test::tiny_png());
    files.write("s.json", kSeedJson);
    files.write("x.obj", kSeedObj);
    files.write("x.mtl", kMtl);
    files.write("s.xml", kSeedXml);
    files.write("j.ini", kIni);
  }

  /// Reads the scene with one of its files replaced; returns whether it was accepted.
  bool attempt(const std::string& text) {
    test::write_text(files / GetParam().file, text);
    try {
      LoadedScene loaded = files.read(GetParam().read);
      EXPECT_EQ(document_problem(loaded.document), "") << text;
      return true;
    } catch (const Error& e) {
      EXPECT_TRUE(e.code() == ExitCode::bad_input || e.code() == ExitCode::limit) << e.what() << "\n" << text;
      EXPECT_TRUE(std::string(e.what()).starts_with(files.path())) << e.what();
      return false;
    } // any other exception fails the test
  }

  SceneFiles files;
};

TEST_P(HostileScenes, Whole) { EXPECT_TRUE(attempt(GetParam().text)); }

/// Finite numbers whose squares are infinite: the camera for the mesh must be valid.
TEST(HostileCoordinates, AreFinite) {
  SceneFiles files;
  for (const char* coordinate : {"1.5e21", "-1.5e21", "3.4e38", "1e13"}) {
    files.write("huge.obj", fmt::format("v 0 0 0\nv 1 0 0\nv 1 {} 0\nf 1 2 3\n", coordinate));
    EXPECT_EQ(document_problem(files.read("huge.obj").document), "") << coordinate;
    files.write("far.obj", fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} {0} 1\nf 1 2 3\n", coordinate));
    EXPECT_EQ(document_problem(files.read("far.obj").document), "") << coordinate;
  }
}

TEST_P(HostileScenes, EveryTruncation) {
  std::string text = GetParam().text;
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) refused += !attempt(text.substr(0, length));
  EXPECT_TRUE(refused > 0 || GetParam().tolerant) << refused;
}

TEST_P(HostileScenes, RandomBytes) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  SCOPED_TRACE(test::seed_note());
  const std::string text = GetParam().text, likely = "0123456789-+.eE\"{}[](),:/\\ \n\r\t<>=#'&;nan";
  auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::string damaged = text;
    for (std::size_t n = 1 + below(4); n > 0 && !damaged.empty(); --n) {
      std::size_t at = below(damaged.size());
      switch (below(6)) {
      case 0: damaged[at] = static_cast<char>(below(256)); break;
      case 1: damaged[at] = likely[below(likely.size())]; break;
      case 2: damaged.erase(at, 1 + below(8)); break;
      case 3: damaged.insert(at, 1 + below(3), likely[below(likely.size())]); break;
      case 4: damaged.insert(at, damaged.substr(below(damaged.size()), 1 + below(40))); break;
      default: damaged[at] = static_cast<char>(damaged[at] ^ (1 << below(8)));
      }
    }
    refused += !attempt(damaged);
  }
  EXPECT_TRUE(refused > 40 || GetParam().tolerant) << refused;
}

INSTANTIATE_TEST_SUITE_P(All, HostileScenes,
                         ::testing::Values(Format{"s.json", "s.json", kSeedJson},
                                           Format{"x.obj", "x.obj", kSeedObj, true},
                                           Format{"x.mtl", "x.obj", kMtl, true},
                                           Format{"s.xml", "s.xml", kSeedXml},
                                           Format{"j.ini", "j.ini", kIni}),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           return name.substr(name.find('.') + 1);
                         });

TEST(HostileSceneText, LongTokensAndNames) {
  SceneFiles files;
  constexpr std::size_t kLength = 500'000;
  for (const std::string& token : {std::string(kLength, 'a'), std::string(kLength, '7')}) {
    auto refuse = [&](const std::string& name, const std::string& text) {
      files.write(name, text);
      EXPECT_LT(files.error(name).size(), 2000u) << "messages stay short";
    };
    refuse("s.json", "{\"candela\": 1, \"" + token + "\": 1}");
    refuse("s.json", "{\"candela\": 1, \"materials\": [{\"diffuse\": " + token + "}]}");
    refuse("s.json", "{\"candela\": 1, \"meshes\": {\"" + token + "\": {}}}");
    refuse("s.json",
           "{\"candela\": 1, \"instances\": [{\"shape\": \"disc\", \"material\": \"" + token + "\"}]}");
    refuse("s.json", "{\"candela\": 1, \"settings\": {\"film\": {\"width\": " + token + "}}}");
    refuse("s.json", "{\"candela\": 1, \"settings\": {\"view\": \"" + token + "\"}}");
    refuse("s.obj", "v " + token + " 0 0\n");
    refuse("s.obj", "v 0 0 0\nf " + token + " 1 1\n");
    refuse("s.xml", "<scenefile><" + token + "/></scenefile>");
    refuse("s.xml", "<scenefile><object type='tree' name='root'><transblock><object type='primitive' name='" +
                        token + "'/></transblock></object></scenefile>");
    refuse("s.ini", "[IO]\nscene = " + token + "\n");
    refuse("s.ini", "[" + token + "]\n");
  }
}

TEST(HostileSceneText, ManyDifferentWarningsAreCapped) {
  SceneFiles files;
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 5000; ++i) obj += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  files.write("x.obj", obj);
  auto loaded = files.read("x.obj");
  EXPECT_LE(loaded.warnings.size(), 201u);
  int count = 0;
  for (const Warning& w : loaded.warnings) count += w.count;
  EXPECT_EQ(count, 5001);
}

} // namespace
} // namespace candela
