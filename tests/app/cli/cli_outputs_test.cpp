// Outputs of the program: checked before the work, and not lost afterwards.

#include "app/program.h"
#include "io/images/image_file.h"

#include <nlohmann/json.hpp>

#include <csignal>
#include <fcntl.h>
#include <unistd.h>

namespace candela {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

class CliOutputs : public test::ProgramTest {
protected:
  std::string render(const std::string& more) {
    return fmt::format("render '{}' --size 8x6 --spp 1 {}", scene, more);
  }
  /// The exit status with a stdout that is a pipe without a reader.
  int status_without_a_reader(const std::vector<std::string>& arguments, bool ignored) {
    int ends[2];
    if (::pipe(ends) != 0) return -1;
    ::close(ends[0]);
    const pid_t child = ::fork();
    if (child == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(::open(path("err.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
      std::signal(SIGPIPE, ignored ? SIG_IGN : SIG_DFL);
      std::vector<char*> argv{const_cast<char*>(CANDELA_PROGRAM)};
      for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
      argv.push_back(nullptr);
      ::execv(CANDELA_PROGRAM, argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }
};

TEST_F(CliOutputs, AreLookedAtBeforeTheScene) {
  fs::create_directory(path("folder.png"));
  fs::create_directory(path("folder.json"));
  test::write_text(path("a.txt"), "x");
  ASSERT_EQ(run(render("-o pic.png")).code, 0);
  // The input is missing as well, which is detected later (exit code 3).
  for (const char* arguments :
       {"render gone.json -o no/such/a.png", "render gone.json -o a.png -o no/such/b.exr",
        "render gone.json -o folder.png", "render gone.json -o a.png --stats no/such/s.json",
        "render gone.json -o a.png --stats folder.json", "render gone.json -o a.txt/b.png",
        "convert gone.json no/such/b.json", "convert gone.json folder.json",
        "compare gone.png pic.png --diff no/such/d.png", "compare gone.png pic.png --diff folder.png",
        "bench interactive gone.json --short --offscreen --json no/such/b.json",
        "bench scale gone.json --short --json no/such/b.json",
        "bench scale gone.json --short --plot no/such/p.png",
        "bench scale gone.json --short --picture folder.png"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 5) << arguments << "\n" << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_NE(o.err.find(": output: it cannot be written: "), std::string::npos) << o.err;
  }
  fs::create_directory(path("a.normal.exr"));
  const Outcome aov = run("render gone.json -o a.exr --aov normal");
  EXPECT_EQ(aov.code, 5) << aov.err;
  EXPECT_NE(aov.err.find("a.normal.exr"), std::string::npos) << aov.err;
  EXPECT_FALSE(fs::exists(path("a.exr"))) << "nothing is left behind";
  test::write_text(path("g.json"), R"({"gallery": 1, "figures": [{"name": "folder", "scene": "box.json"}]})");
  fs::copy(scene, path("box.json"));
  EXPECT_EQ(run("gallery --file g.json -o a.txt/out").code, 5);
  EXPECT_EQ(run("gallery --file g.json").code, 5) << "folder.png is in the way";
}

TEST_F(CliOutputs, AJobsOwnAreLookedAtToo) {
  test::write_text(path("job.ini"),
                   fmt::format("[IO]\nscene = {}\noutput = no/such/a.png\n[Settings]\n", scene));
  fs::copy(scene, path("box.json"));
  const Outcome o = run(
      "render job.ini --spp 0 --allow-outside"); // without a stopping criterion the render would end with 2
  EXPECT_EQ(o.code, 5) << o.err;
}

TEST_F(CliOutputs, AWrongReferenceIsRefusedBeforeTheWork) {
  ASSERT_EQ(run(render("-o ref.exr")).code, 0);
  test::write_text(path("broken.exr"), "no picture");
  for (const char* reference : {"gone.exr", "broken.exr"}) {
    const Outcome o = run(fmt::format("render gone.json -o a.exr --reference {}", reference));
    EXPECT_EQ(o.code, 3);
    EXPECT_NE(o.err.find(reference), std::string::npos) << o.err;
  }
  // A render without a stopping criterion would end with 2.
  for (const char* shape : {"--size 9x6", "--size 8x6 --crop 0,0,7,6"}) {
    const Outcome o = run(fmt::format("render '{}' {} --spp 0 -o a.exr --reference ref.exr", scene, shape));
    EXPECT_EQ(o.code, 3) << o.err;
    EXPECT_NE(o.err.find("ref.exr: reference: it has 8x6 pixels"), std::string::npos) << o.err;
  }
  EXPECT_EQ(
      run(fmt::format("render '{}' --size 16x12 --crop 1,2,8,6 --spp 1 -o a.exr --reference ref.exr", scene))
          .code,
      0);
}

TEST_F(CliOutputs, DoNotOverwriteEachOtherNorWhatIsRead) {
  fs::copy(scene, path("box.json"));
  ASSERT_EQ(run(render("-o ref.exr -o pic.png")).code, 0);
  fs::create_symlink("ref.exr", path("link.exr"));
  const std::string before = text("ref.exr");
  for (const std::string& arguments :
       {std::string("render box.json --spp 1 --size 8x6 -o a.png --stats box.json"),
        render("-o a.png --stats a.png"), render("-o a.png -o ./a.png"),
        render("-o a.png -o a.normal.png --aov normal"), render("-o a.png --aov normal --aov normal"),
        render("-o ref.exr --reference ref.exr"), render("-o link.exr --reference ref.exr"),
        std::string("compare pic.png ref.exr --diff pic.png"),
        std::string("compare pic.png ref.exr --diff ../") + fs::path(scratch.path()).filename().string() +
            "/pic.png",
        std::string("convert box.json box.json")}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments << "\n" << o.err;
  }
  EXPECT_EQ(text("ref.exr"), before);
  EXPECT_EQ(text("box.json"), test::read_text(scene));
  // A picture may be rendered again over itself; streams may take several outputs.
  EXPECT_EQ(run("render pic.png -o pic.png").code, 0);
  const Outcome both = run(render("-o a.exr --stats /dev/stdout --reference ref.exr"));
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_LT(both.out.find("\"version\""), both.out.find("\"relMSE\"")) << both.out;
}

TEST_F(CliOutputs, AreNotATexture) {
  ASSERT_EQ(run(render("-o wood.png --no-state")).code, 0);
  test::write_text(path("t.json"),
                   R"({"candela": 1, "materials": [{"name": "m", "diffuse_texture": "wood.png"}],
    "instances": [{"shape": "sphere", "material": "m"}], "lights": [{"type": "constant"}]})");
  const Outcome o = run("render t.json --spp 1 --size 8x6 -o wood.png");
  EXPECT_EQ(o.code, 2) << o.err;
  EXPECT_NE(o.err.find("would be lost"), std::string::npos) << o.err;
}

TEST_F(CliOutputs, AFullStdoutIsAnError) {
  ASSERT_EQ(run(render("-o a.exr")).code, 0);
  for (const std::string& arguments :
       {std::string("settings"), std::string("settings --json"), fmt::format("info '{}'", scene),
        std::string("compare a.exr a.exr"), std::string("lab pi --samples 10"),
        std::string("lab points --samples 4"), std::string("gallery --list"), std::string("--help"),
        std::string("--version"), std::string("render --help"), std::string("lab brdf --help"),
        render("-o b.exr --reference a.exr")})
    for (const char* out : {">&-", ">/dev/full", "</dev/null >&0"}) {
      const Outcome o = run(arguments, "", "true", fmt::format("{} 2>err.txt", out));
      EXPECT_EQ(o.code, 5) << arguments << ' ' << out << "\n" << o.err;
      EXPECT_NE(o.err.find("candela: stdout: output: it cannot be written"), std::string::npos) << o.err;
    }
  // Results on a closed stdout must neither lose the picture nor be written into it.
  EXPECT_EQ(text("b.exr"), text("a.exr"));
  EXPECT_EQ(run(render("-o c.exr"), "", "true", ">&- 2>&- <&-").code, 0);
  EXPECT_EQ(text("c.exr"), text("a.exr"));
  EXPECT_EQ(run(render("-o d.exr"), "", "true", ">/dev/full 2>/dev/full").code, 0);
  EXPECT_EQ(text("d.exr"), text("a.exr"));
}

TEST_F(CliOutputs, AReaderThatLeavesEndsItQuietly) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"settings"}, {"info", scene}, {"lab", "points"}, {"--help"}}) {
    int status = status_without_a_reader(arguments, false);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE) << arguments[0] << ' ' << status;
    EXPECT_EQ(text("err.txt"), "");
    status = status_without_a_reader(arguments, true);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 5) << arguments[0] << ' ' << status;
    EXPECT_NE(text("err.txt").find("Broken pipe"), std::string::npos) << text("err.txt");
  }
  // A reader of the progress that ends early must not end the render.
  ASSERT_EQ(run("settings", "", "true", "| true").code, 0);
  ASSERT_EQ(run(render("-o a.png --set 'no.such=1' || true"), "", "true", "2>&1 | true").code, 0);
  const std::string both =
      fmt::format("({{ sleep 0.2; '{}' {}; }} 2>&1 | true)", CANDELA_PROGRAM, render("-o late.png"));
  EXPECT_EQ(std::system(fmt::format("cd '{}' && {}", scratch.path(), both).c_str()), 0);
  EXPECT_TRUE(fs::exists(path("late.png")));
}

TEST_F(CliOutputs, OneThatFailsDoesNotCostTheOthers) {
  // Files may not grow beyond 24 KiB: the linear picture of 48 KiB is too large, the others are not.
  const Outcome o = run(fmt::format("render '{}' --size 64x64 --spp 2 --set path.max_depth=1 --no-state "
                                    "-o big.pfm -o small.png --aov normal --stats s.json",
                                    scene),
                        "", "ulimit -f 48");
  EXPECT_EQ(o.code, 5) << o.err;
  EXPECT_NE(o.err.find("big.pfm: output: "), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("big.normal.pfm: output: "), std::string::npos) << o.err;
  EXPECT_EQ(read_image(path("small.png")).width, 64);
  EXPECT_EQ(read_image(path("small.normal.png")).width, 64);
  EXPECT_TRUE(fs::exists(path("s.json")));
  for (const auto& entry : fs::directory_iterator(scratch.path()))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
}

TEST_F(CliOutputs, ACropCostsWhatTheCropCosts) {
  // The whole film would take 19 GB.
  const std::string huge =
      fmt::format("render '{}' --size 16384x16384 --spp 2 --crop 9000,7000,6,4 --quiet ", scene);
  const Outcome o = run(huge + "-o part.png -o part.exr --aov direct --aov normal --stats s.json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto stats = nlohmann::json::parse(text("s.json"));
  EXPECT_EQ(stats["samples"], 2 * 6 * 4);
  EXPECT_LT(stats["peak_rss_bytes"].get<double>(), 3e8);
  for (const char* name : {"part.png", "part.exr", "part.direct.exr", "part.normal.png"}) {
    EXPECT_EQ(read_image(path(name)).width, 6) << name;
    EXPECT_EQ(read_image(path(name)).height, 4) << name;
  }
  const Outcome denoised = run(huge + "--set display.denoise=true -o clean.png --stats s.json");
  ASSERT_EQ(denoised.code, 0) << denoised.err;
  EXPECT_LT(nlohmann::json::parse(text("s.json"))["peak_rss_bytes"].get<double>(), 3e8);
}

TEST_F(CliOutputs, ACropIsThePartOfTheWhole) {
  for (const char* settings : {"", "--set adaptive.error=0.5 --set adaptive.min_spp=2"}) {
    const std::string both =
        fmt::format("render '{}' --size 70x50 --spp 6 --quiet {} --aov direct --aov depth ", scene, settings);
    ASSERT_EQ(run(both + "-o whole.exr -o whole.png").code, 0);
    ASSERT_EQ(run(both + "--crop 24,16,40,32 -o part.exr -o part.png").code, 0);
    for (const char* name : {".exr", ".png", ".direct.exr", ".direct.png", ".depth.exr"}) {
      const Image whole = read_image(path(std::string("whole") + name)),
                  part = read_image(path(std::string("part") + name));
      ASSERT_EQ(part.width, 40);
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 40; ++x)
          ASSERT_EQ(part.at(x, y), whole.at(x + 24, y + 16)) << name << x << ' ' << y;
    }
  }
}

TEST_F(CliOutputs, OddCommandLinesAreAnsweredPlainly) {
  const std::string some = render("-o a.png ");
  struct Case {
    std::string arguments, says;
  };
  for (const Case& c : std::vector<Case>{
           {"rendr box.json", "candela rendr: there is no such command: did you mean render?"},
           {some + "--sizee 3x4", "candela render: it has no option --sizee: did you mean --size?"},
           {some + "--resume", "candela render: it has no option --resume: see `candela render --help`"},
           {some + "second.json", "candela render: second.json is more than it takes"},
           {"settings foo", "candela settings: foo is more than it takes"},
           {"render '' -o a.png", "candela render: the scene's name is empty"},
           {"info ''", "candela info: the scene's name is empty"},
           {"convert '' a.json", "candela convert: the scene's name is empty"},
           {render("-o=a.png"), "-o=a.png: the name begins with '=': write -o a.png"},
           {"bench scale --size", "see `candela bench scale --help`"},
       }) {
    const Outcome o = run(c.arguments);
    EXPECT_EQ(o.code, 2) << c.arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(c.says), std::string::npos) << c.arguments << "\n" << o.err;
  }
  EXPECT_FALSE(fs::exists(path("=a.png")));
  const Outcome empty = run(some + "--stats ''");
  EXPECT_EQ(empty.code, 5);
  EXPECT_NE(empty.err.find("the name is empty: name a file"), std::string::npos) << empty.err;
  EXPECT_EQ(run("help").out, run("--help").out);
  // The last of contradicting options is used; - is stdout.
  const Outcome last = run(some + "--size 5x4 --seed 1 --seed 2 --stats -");
  ASSERT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(nlohmann::json::parse(last.out)["seed"], 2);
  EXPECT_EQ(nlohmann::json::parse(last.out)["width"], 5);
  EXPECT_FALSE(fs::exists(path("-")));
}

TEST_F(CliOutputs, NumbersThatDoNotFitAreToldTheirRange) {
  struct Case {
    std::string arguments, says;
  };
  const std::string some = fmt::format("render '{}' -o a.png ", scene);
  for (const Case& c : std::vector<Case>{
           {some + "--time -1", "--time: '-1' does not fit: give a number from 0 to 1e9, in s"},
           {some + "--time=-.5", "--time: '-.5' does not fit: give a number from 0 to 1e9, in s"},
           {some + "--time inf", "--time: 'inf' does not fit: give a number from 0"},
           {some + "--spp -3", "--spp: '-3' does not fit: give an integer from 0 to 1000000000, in samples"},
           {some + "--spp 1.5", "--spp: '1.5' does not fit: give an integer from 0"},
           {some + "--spp 99999999999", "give an integer from 0 to 1000000000, in samples"},
           {some + "--noise nan", "--noise: 'nan' does not fit: give a number from 0 to 10"},
           {some + "--seed abc", "--seed: 'abc' does not fit: give an integer from 0 to 2147483647"},
           {some + "--seed -1", "give an integer from 0 to 2147483647"},
           {some + "--threads -2", "--threads: '-2' does not fit: give an integer from 0 to 1024"},
           {some + "--size 0x5", "film.width: 0 is out of range; give an integer from 1 to 16384"},
           {some + "--size=-4x5", "film.width: -4 is out of range; give an integer from 1 to 16384"},
           {some + "--crop 0,0,0,0", "stay within"},
           {"gallery --spp-scale 0", "--spp-scale: '0' does not fit: give a number from 1e-06 to 1e6"},
           {"bench interactive --seconds 0", "give a number from 0.1 to 600, in s"},
           {"bench interactive --repeats 0", "give an integer from 1 to 1000"},
           {"bench scale --rounds many", "--rounds: 'many' does not fit: give an integer from 1 to 1000"},
           {"bench scale --picture-spp 1", "give an integer from 2 to 1000000"},
           {"lab pi --samples 0", "--samples: '0' does not fit: give an integer from 1 to 1000000000"},
       }) {
    const Outcome o = run(c.arguments);
    EXPECT_EQ(o.code, 2) << c.arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(c.says), std::string::npos) << c.arguments << "\n" << o.err;
    EXPECT_LT(o.err.size(), 200u) << o.err;
  }
}

} // namespace
} // namespace candela
