// The program's commands, run as processes.

#include "app/program.h"
#include "io/images/image_file.h"
#include "scene/document.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace candela {
namespace {

std::string file_text(const std::string& path) { return test::read_text(path); }

/// Whether the process catches the signal, according to the kernel.
bool catches(pid_t process, int signal) {
  std::istringstream status(file_text(fmt::format("/proc/{}/status", process)));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:"))
      return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
  return false;
}

using test::Outcome;
using CliTest = test::ProgramTest;

TEST_F(CliTest, LooksThroughABookmark) {
  std::ofstream(path("views.json")) << R"({"candela": 1, "lights": [{"type": "constant", "group": "sky"}],
    "instances": [{"shape": "sphere"}], "settings": {"view": "depth", "film": {"width": 9, "height": 9}},
    "bookmarks": [{"name": "near", "camera": {"position": [0, 0, 3]}},
                  {"name": "far off", "camera": {"position": [0, 0, 30], "vertical_fov": 4}}]})";
  ASSERT_EQ(run("render views.json --bookmark 'far off' --spp 1 -o far.exr --quiet").code, 0);
  ASSERT_EQ(run("render views.json --bookmark near --spp 1 -o near.exr --quiet").code, 0);
  EXPECT_NEAR(read_image(path("near.exr")).at(4, 4).x, 2, 0.1f);
  EXPECT_NEAR(read_image(path("far.exr")).at(4, 4).x, 29, 0.1f);
  ASSERT_EQ(
      run("render views.json --bookmark near --set camera.position='0 0 5' --spp 1 -o set.exr --quiet").code,
      0);
  EXPECT_NEAR(read_image(path("set.exr")).at(4, 4).x, 4, 0.1f) << "--set wins";
  const Outcome wrong = run("render views.json --bookmark nera --spp 1 -o no.exr");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean near?"), std::string::npos) << wrong.err;
  const Outcome info = run("info views.json --bookmark 'far off'");
  EXPECT_EQ(nlohmann::json::parse(info.out)["camera"]["position"][2], 30);
  EXPECT_EQ(nlohmann::json::parse(info.out)["bookmarks"], (nlohmann::json{"near", "far off"}));
  EXPECT_EQ(nlohmann::json::parse(info.out)["light_groups"], nlohmann::json::array({"sky"}));
}

TEST_F(CliTest, RendersTheSameBytesWithAnyNumberOfThreads) {
  for (const char* threads : {"1", "2", "5"}) {
    Outcome o = run(fmt::format("render '{}' --size 50x40 --spp 3 --threads {} -o t{}.exr -o t{}.png --quiet",
                                scene, threads, threads, threads));
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_EQ(o.err, "");
  }
  for (const char* ending : {".exr", ".png"}) {
    std::string one = file_text(path(std::string("t1") + ending));
    EXPECT_GT(one.size(), 100u);
    EXPECT_EQ(one, file_text(path(std::string("t2") + ending)));
    EXPECT_EQ(one, file_text(path(std::string("t5") + ending)));
  }
  Image image = read_image(path("t1.exr"));
  EXPECT_EQ(image.width, 50);
  EXPECT_EQ(image.height, 40);
}

TEST_F(CliTest, WritesEveryFormat) {
  Outcome o = run(fmt::format(
      "render '{}' --size 16x16 --spp 1 -o a.png -o a.jpg -o a.ppm -o a.exr -o a.hdr -o a.pfm", scene));
  ASSERT_EQ(o.code, 0) << o.err;
  Image exr = read_image(path("a.exr"));
  EXPECT_EQ(exr, read_image(path("a.pfm")));
  for (const char* name : {"a.png", "a.jpg", "a.ppm", "a.hdr"})
    EXPECT_EQ(read_image(path(name)).width, 16) << name;
}

TEST_F(CliTest, SeedsAndSettingsAlterTheImage) {
  ASSERT_EQ(run(fmt::format("render '{}' --size 16x16 --spp 1 -o a.pfm", scene)).code, 0);
  ASSERT_EQ(run(fmt::format("render '{}' --size 16x16 --spp 1 --seed 7 -o b.pfm", scene)).code, 0);
  ASSERT_EQ(run(fmt::format("render '{}' --size 16x16 --spp 1 --set sampler.seed=7 -o c.pfm", scene)).code,
            0);
  ASSERT_EQ(
      run(fmt::format("render '{}' --size 99x99 --set film.width=16 --set film.height=16 --spp 1 -o d.pfm",
                      scene))
          .code,
      0);
  EXPECT_NE(file_text(path("a.pfm")), file_text(path("b.pfm")));
  EXPECT_EQ(file_text(path("b.pfm")), file_text(path("c.pfm")));
  EXPECT_EQ(file_text(path("a.pfm")), file_text(path("d.pfm"))); // --set wins
}

TEST_F(CliTest, StatsHaveWhatIsPromised) {
  Outcome o =
      run(fmt::format("render '{}' --size 20x10 --spp 2 --crop 5,2,10,6 -o a.png --stats s.json", scene));
  ASSERT_EQ(o.code, 0) << o.err;
  auto j = nlohmann::json::parse(file_text(path("s.json")));
  for (const char* key :
       {"load_s", "build_s", "render_s", "width", "height", "spp", "samples", "rays", "samples_per_s",
        "rays_per_s", "threads", "seed", "nonfinite", "peak_rss_bytes", "settings", "version"})
    EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_EQ(j["samples"], 2 * 10 * 6);
  EXPECT_EQ(j["width"], 10);
  EXPECT_GT(j["rays"]["closest"], 0);
  EXPECT_GT(j["rays"]["shadow"], 0);
  EXPECT_EQ(j["settings"]["film.width"], "20");
}

TEST_F(CliTest, WritesOtherViewsBesideTheOutput) {
  Outcome o = run("render " + scene +
                  " --size 16x12 --spp 2 -o a.exr -o a.png --aov normal --aov samples --aov direct "
                  "--aov indirect --aov emitted --quiet");
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* name : {"normal", "samples", "direct", "indirect", "emitted"})
    for (const char* ending : {"exr", "png"})
      EXPECT_TRUE(std::filesystem::exists(path(fmt::format("a.{}.{}", name, ending)))) << name;
  Image whole = read_image(path("a.exr")), samples = read_image(path("a.samples.exr"));
  EXPECT_EQ(samples.at(3, 4), vec3(2));
  Image direct = read_image(path("a.direct.exr")), indirect = read_image(path("a.indirect.exr")),
        emitted = read_image(path("a.emitted.exr"));
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(emitted.pixels[i][c] + direct.pixels[i][c] + indirect.pixels[i][c], whole.pixels[i][c],
                  1e-5f * (1 + whole.pixels[i][c]));
  o = run("render " + scene + " -o b.png --aov normals");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("geometric_normal"), std::string::npos) << o.err;
}

TEST_F(CliTest, WritesLightGroupsAsLayers) {
  std::ofstream(path("groups.json")) << R"({"candela": 1,
    "lights": [{"position": [0, 2, 0], "group": "key/1"}, {"position": [1, 2, 0], "group": "key.1"},
               {"type": "constant", "color": 0.2}],
    "light_groups": [{"name": "key/1", "on": false}],
    "instances": [{"shape": "plane", "material": "m"}], "materials": [{"name": "m"}],
    "camera": {"position": [0, 0, 3]}})";
  const std::string render =
      "render '" + path("groups.json") + "' --size 12x8 --spp 4 --quiet --aov light_groups ";
  Outcome o = run(render + "-o a.png -o a.exr -o b.exr");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(read_image(path("a.light_groups.exr")).pixels, read_image(path("a.exr")).pixels);
  EXPECT_TRUE(std::filesystem::exists(path("b.light_groups.exr")));
  const std::string bytes = file_text(path("a.light_groups.exr"));
  for (const char* name : {"Combined_key_1.R", "Combined_key_1-2.G", "Combined_ungrouped.B"})
    EXPECT_NE(bytes.find(name), std::string::npos) << name;
  EXPECT_NE(bytes.find("0 0 0"), std::string::npos) << "the factor of what is off";
  o = run(render + "-o a.exr --set adaptive.error=0.1");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("adaptive"), std::string::npos) << o.err;
  o = run("render '" + scene + "' --size 12x8 --spp 1 --quiet -o a.exr --aov light_groups");
  EXPECT_EQ(o.code, 2) << "it has no groups";
}

TEST_F(CliTest, StopsAtANoiseLevel) {
  Outcome o = run("render " + scene + " --size 32x32 --noise 0.3 -o a.exr --stats s.json --quiet");
  ASSERT_EQ(o.code, 0) << o.err;
  auto stats = nlohmann::json::parse(file_text(path("s.json")));
  EXPECT_LE(stats["noise"].get<double>(), 0.3);
  EXPECT_EQ(stats["spp"].get<int>() % 8, 0);
}

TEST_F(CliTest, ComparesWithAReference) {
  ASSERT_EQ(run(fmt::format("render '{}' --size 16x16 --spp 1 -o ref.exr", scene)).code, 0);
  Outcome same = run(fmt::format("render '{}' --size 16x16 --spp 1 -o a.exr --reference ref.exr", scene));
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(nlohmann::json::parse(same.out)["relMSE"], 0);
  Outcome other =
      run(fmt::format("render '{}' --size 16x16 --spp 1 --seed 1 -o b.exr --reference ref.exr", scene));
  EXPECT_GT(nlohmann::json::parse(other.out)["relMSE"], 0);
  Outcome compared = run("compare b.exr ref.exr --diff d.png");
  ASSERT_EQ(compared.code, 0) << compared.err;
  EXPECT_EQ(nlohmann::json::parse(compared.out), nlohmann::json::parse(other.out));
  EXPECT_TRUE(std::filesystem::exists(path("d.png")));
  Outcome wrong = run(fmt::format("render '{}' --size 8x8 --spp 1 -o c.exr --reference ref.exr", scene));
  EXPECT_EQ(wrong.code, 3);
}

TEST_F(CliTest, DenoisesAndSaysSo) {
  const std::string noisy = fmt::format("render '{}' --size 48x48 --quiet ", scene);
  const std::string clean = noisy + "--set display.denoise=true ";
  ASSERT_EQ(run(noisy + "--spp 256 -o ref.exr").code, 0);
  Outcome o =
      run(clean + "--spp 8 --threads 1 --seed 3 -o a.exr -o a.png --reference ref.exr --stats s.json");
  ASSERT_EQ(o.code, 0) << o.err;
  auto errors = nlohmann::json::parse(o.out);
  EXPECT_LT(errors["relMSE"], errors["noisy"]["relMSE"]);
  EXPECT_EQ(nlohmann::json::parse(file_text(path("s.json")))["denoised"], true);
  const std::string denoiser = nlohmann::json::parse(file_text(path("s.json")))["denoiser"];
  for (const char* name : {"a.exr", "a.png"}) {
    const std::string bytes = file_text(path(name));
    EXPECT_NE(bytes.find("candela.denoised"), std::string::npos) << name;
    EXPECT_NE(bytes.find("of 8 samples a pixel, by " + denoiser), std::string::npos) << name;
  }
  ASSERT_EQ(run(clean + "--spp 8 --threads 3 --seed 3 -o b.exr").code, 0);
  EXPECT_TRUE(read_image(path("b.exr")) == read_image(path("a.exr"))) << "for any number of threads";
  Outcome one = run(clean + "--spp 1 -o c.exr");
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.err.find("two samples"), std::string::npos) << one.err;
}

TEST_F(CliTest, ErrorsHaveTheirExitCodes) {
  struct Case {
    std::string arguments;
    int code;
    std::string says;
  };
  std::ofstream(path("bad.json")) << "{\n  \"candela\": 1,\n  \"cmera\": {}\n}\n";
  for (const Case& c : std::vector<Case>{
           {"render", 2, "scene"},
           {"--paint", 2, "--paint"},
           {fmt::format("render '{}'", scene), 2, "-o"},
           {fmt::format("render '{}' -o a.xyz", scene), 2, ".png"},
           {fmt::format("render '{}' -o a.png --size 10", scene), 2, "WxH"},
           {fmt::format("render '{}' -o a.png --set path.max_dept=3", scene), 2, "path.max_depth"},
           {fmt::format("render '{}' -o a.png --set path.max_depth=much", scene), 2, "integer"},
           {fmt::format("render '{}' -o a.png --crop 0,0,9999,1", scene), 2, "film"},
           {fmt::format("render '{}' -o a.png --spp 0", scene), 2, "stop"},
           {"render missing.json -o a.png", 3, "missing.json"},
           {"render bad.json -o a.png", 3, "bad.json:3:3"},
           {fmt::format("render '{}' --size 8x8 --spp 1 -o no/such/folder/a.png", scene), 5, "folder"},
           {"compare missing.png missing.png", 3, "missing.png"},
       }) {
    Outcome o = run(c.arguments);
    EXPECT_EQ(o.code, c.code) << c.arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(c.says), std::string::npos) << c.arguments << "\n" << o.err;
    EXPECT_EQ(o.out, "") << c.arguments;
  }
}

TEST_F(CliTest, WithoutADisplayTheWindowSaysSo) {
  Outcome o = run(fmt::format("view '{}'", scene), "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(o.code, 6);
  EXPECT_NE(o.err.find("candela render"), std::string::npos) << o.err;
}

TEST_F(CliTest, InfoIsJson) {
  Outcome o = run(fmt::format("info '{}'", scene));
  ASSERT_EQ(o.code, 0) << o.err;
  auto j = nlohmann::json::parse(o.out);
  EXPECT_GT(j["triangles"]["placed"].get<int>() + j["rectangles"].get<int>(), 10);
  EXPECT_EQ(j["lights"]["rectangle"], 1);
  EXPECT_TRUE(j["warnings"].empty());
  EXPECT_GT(j["memory_bytes"], 0);
}

TEST_F(CliTest, SettingsListTheTable) {
  Outcome o = run("settings --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(nlohmann::json::parse(o.out).size(), settings_table().size());
  EXPECT_EQ(run("settings").code, 0);
}

TEST_F(CliTest, InterruptedItSavesWhatItHas) {
  for (auto [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    std::string out = path("cut.png");
    std::filesystem::remove(out);
    pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      execl(CANDELA_PROGRAM, CANDELA_PROGRAM, "render", scene.c_str(), "--size", "64x64", "--spp",
            "1000000000", "-o", out.c_str(), "--quiet", static_cast<char*>(nullptr));
      _exit(127);
    }
    while (!catches(child, signal)) std::this_thread::yield();   // it does while it builds and renders
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // while it builds there is nothing to save
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), code);
    EXPECT_EQ(read_image(out).width, 64);
  }
}

} // namespace
} // namespace candela
