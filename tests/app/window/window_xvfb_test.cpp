// The real window: the program with GLFW on an X server that draws into memory, with input by xdotool.

#include "app/harness.h"
#include "io/candela/candela_json.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace candela::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

bool installed(const char* program) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0;
}

/// A child process that ends with the test.
class Process {
public:
  Process(std::vector<std::string> command, const fs::path& folder, const std::string& display,
          const fs::path& log) {
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) { // only what is safe between fork and exec
      if (chdir(folder.c_str()) != 0) _exit(126);
      if (!display.empty()) setenv("DISPLAY", display.c_str(), 1);
      unsetenv("WAYLAND_DISPLAY");
      // With AddressSanitizer: leaks of the X and GL libraries cannot be distinguished from ours, since the
      // libraries are unloaded by then. The other tests check the same code for leaks.
      setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
      const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
      dup2(file, 1);
      dup2(file, 2);
      execvp(arguments[0], arguments.data());
      _exit(127);
    }
  }
  ~Process() {
    if (pid_ <= 0) return;
    kill(pid_, SIGTERM);
    wait(10);
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The exit status once it has ended; -1 if it still runs after `seconds`.
  int wait(double seconds) {
    const auto end = steady_clock::now() + std::chrono::duration<double>(seconds);
    do {
      int status = 0;
      if (pid_ > 0 && waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      if (pid_ <= 0) return status_;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    } while (steady_clock::now() < end);
    return -1;
  }

private:
  pid_t pid_ = -1;
  int status_ = -1;
};

/// An X server of its own on a free display number.
class XServer {
public:
  XServer(const fs::path& folder, ivec2 size) {
    const fs::path number = folder / "display";
    server_ = std::make_unique<Process>(
        std::vector<std::string>{
            "bash", "-c",
            fmt::format("exec Xvfb -displayfd 9 -screen 0 {}x{}x24 -noreset -nolisten tcp 9>display", size.x,
                        size.y)},
        folder, "", folder / "xvfb.log");
    for (int i = 0; i < 1000 && read_text(number).find('\n') == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::string line = read_text(number);
    line.erase(line.find_last_not_of('\n') + 1);
    if (line.empty()) throw std::runtime_error("Xvfb did not start: " + read_text(folder / "xvfb.log"));
    display_ = ":" + line;
  }
  const std::string& display() const { return display_; }

  /// The output of xdotool for this server.
  std::string xdotool(const std::string& command) const {
    std::string out;
    FILE* pipe = popen(fmt::format("DISPLAY={} xdotool {}", display_, command).c_str(), "r");
    char buffer[256];
    while (pipe != nullptr && fgets(buffer, sizeof buffer, pipe) != nullptr) out += buffer;
    if (pipe != nullptr) pclose(pipe);
    return out;
  }

private:
  std::unique_ptr<Process> server_;
  std::string display_;
};

template <class Condition>
bool comes_true(Condition condition, double seconds = 60) {
  const auto end = steady_clock::now() + std::chrono::duration<double>(seconds);
  while (steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

class RealWindowUi : public testing::Test {
protected:
  void SetUp() override {
    for (const char* program : {"Xvfb", "xdotool"})
      if (!installed(program)) GTEST_SKIP() << program << " is not installed";
  }
};

TEST_F(RealWindowUi, FliesSavesAndCloses) {
  ScratchFolder folder;
  write_candela_json(test_document(), folder / "room.json");
  const XServer server(folder.path(), {1280, 720});
  const fs::path log = folder / "candela.log";
  Process candela({CANDELA_PROGRAM, "view", "room.json", "--no-preferences"}, folder.path(), server.display(),
                  log);

  std::string window;
  ASSERT_TRUE(comes_true([&] {
    window = server.xdotool("search --onlyvisible --name 'room.json - Candela' 2>/dev/null");
    return !window.empty();
  })) << read_text(log);
  server.xdotool("mousemove 300 300");
  auto save = [&](const std::string& number) {
    server.xdotool("key p");
    return comes_true([&] { // the EXR is written last
      std::error_code failed;
      const auto size = fs::file_size(folder / fmt::format("candela-{}.exr", number), failed);
      return !failed && size > 0;
    });
  };
  ASSERT_TRUE(save("0001")) << read_text(log);

  server.xdotool("keydown a");
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  server.xdotool("keyup a");
  ASSERT_TRUE(save("0002")) << read_text(log);
  const Image before = read_image(folder / "candela-0001.png");
  const Image after = read_image(folder / "candela-0002.png");
  ASSERT_EQ(before.width, 1280) << "the film has the window's size";
  ASSERT_EQ(after.pixels.size(), before.pixels.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i) changed += before.pixels[i] != after.pixels[i];
  EXPECT_GT(changed, before.pixels.size() / 4) << "the view turned";

  if (installed("import")) {
    const int saved = std::system(
        fmt::format("DISPLAY={} import -window root '{}'", server.display(), screenshot_path("xvfb.png"))
            .c_str());
    EXPECT_EQ(saved, 0);
  }
  server.xdotool("key ctrl+q");
  EXPECT_EQ(candela.wait(30), 0) << read_text(log);
}

// Its paths may be endless; closing the window must not wait for them.
TEST_F(RealWindowUi, ClosesAtOnceAndLosesNoPicture) {
  ScratchFolder folder;
  write_text(folder / "glass.json", R"({"candela": 1, "camera": {"position": [0, 0, 0], "target": [1, 1, 1]},
    "materials": [{"name": "g", "type": "dielectric", "ior": 1.5}],
    "instances": [{"shape": "cube", "material": "g"}], "lights": [{"type": "constant", "color": 1}]})");
  write_candela_json(test_document(), folder / "room.json");
  const XServer server(folder.path(), {1280, 720});
  const fs::path log = folder / "candela.log";
  for (const char* scene : {"glass", "room"}) {
    SCOPED_TRACE(scene);
    Process candela({CANDELA_PROGRAM, "view", fmt::format("{}.json", scene), "--no-preferences"},
                    folder.path(), server.display(), log);
    auto window = [&] {
      return server.xdotool(
          fmt::format("search --onlyvisible --name '{}.json - Candela' 2>/dev/null", scene));
    };
    ASSERT_TRUE(comes_true([&] { return !window().empty(); })) << read_text(log);
    server.xdotool("mousemove 300 300");
    std::this_thread::sleep_for(std::chrono::seconds(1)); // during the work
    server.xdotool("key p key ctrl+q");
    EXPECT_EQ(candela.wait(30), 0) << read_text(log);
    EXPECT_EQ(window(), "");
  }
  EXPECT_EQ(read_text(log), "");
  std::size_t pictures = 0;
  for (const auto& file : fs::directory_iterator(folder.path())) {
    const std::string ending = file.path().extension();
    if (ending != ".png" && ending != ".exr") continue;
    EXPECT_EQ(read_image(file.path().string()).width, 1280) << file.path();
    ++pictures;
  }
  EXPECT_GE(pictures, 2u) << "at least the room's";
}

TEST_F(RealWindowUi, OpensAgainAsLargeAsItWas) {
  ScratchFolder folder;
  write_candela_json(test_document(), folder / "room.json");
  const XServer server(folder.path(), {2400, 1700}); // on which text is 1.574 times as large
  const fs::path log = folder / "candela.log";
  for (int day = 0; day < 3; ++day) {
    Process candela({"env", "XDG_CONFIG_HOME=" + folder.path(), CANDELA_PROGRAM, "view", "room.json"},
                    folder.path(), server.display(), log);
    ASSERT_TRUE(comes_true([&] {
      return !server.xdotool("search --onlyvisible --name 'room.json - Candela' 2>/dev/null").empty();
    })) << read_text(log);
    server.xdotool("mousemove 300 300 key ctrl+q");
    ASSERT_EQ(candela.wait(30), 0) << read_text(log);
    std::string warning;
    const Preferences kept =
        read_preferences(fs::path(folder.path()) / "candela" / "preferences.json", warning);
    EXPECT_EQ(warning, "");
    EXPECT_EQ(kept.window, Preferences().window) << "day " << day;
  }
}

TEST_F(RealWindowUi, SaveAsIsTypedIntoAtOnce) {
  ScratchFolder folder;
  write_candela_json(test_document(), folder / "room.json");
  const XServer server(folder.path(), {1280, 720});
  const fs::path log = folder / "candela.log";
  Process candela({CANDELA_PROGRAM, "view", "room.json", "--no-preferences"}, folder.path(), server.display(),
                  log);
  auto window = [&](const char* title) {
    return server.xdotool(fmt::format("search --onlyvisible --name '{}' 2>/dev/null", title));
  };
  ASSERT_TRUE(comes_true([&] { return !window("room.json - Candela").empty(); })) << read_text(log);
  server.xdotool("mousemove 300 300 key ctrl+shift+s type --delay 0 kpcl");
  server.xdotool("key Return");
  ASSERT_TRUE(comes_true([&] { return !window("kpcl.json - Candela").empty(); }, 20)) << read_text(log);
  EXPECT_TRUE(fs::exists(folder / "kpcl.json"));
  EXPECT_FALSE(fs::exists(folder / "candela-0001.png")) << "a letter of the name has saved a picture";
  server.xdotool("key ctrl+q");
  EXPECT_EQ(candela.wait(30), 0) << read_text(log);
}

TEST_F(RealWindowUi, WithoutADisplayItSaysSo) {
  ScratchFolder folder;
  const fs::path log = folder / "candela.log";
  Process candela({"env", "-u", "DISPLAY", CANDELA_PROGRAM, "view"}, folder.path(), "", log);
  EXPECT_EQ(candela.wait(30), static_cast<int>(ExitCode::display));
  EXPECT_NE(read_text(log).find("candela render"), std::string::npos) << "the remedy: " << read_text(log);
}

} // namespace
} // namespace candela::test
