// A folder of src/ may include only itself and the folders before it, and only app/ knows the window.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// What each folder may include beside itself.
const std::map<std::string, std::set<std::string>, std::less<>>& allowed() {
  static const std::map<std::string, std::set<std::string>, std::less<>> table = [] {
    std::map<std::string, std::set<std::string>, std::less<>> t;
    std::set<std::string> before;
    for (const char* folder : {"core", "sampling", "bsdf", "media", "accel", "scene"}) {
      t[folder] = before;
      before.insert(folder);
    }
    t["io"] = t["render"] = before; // siblings
    before.insert({"io", "render"});
    t["session"] = before;
    t["lab"] = {"core", "sampling", "bsdf"};
    before.insert({"session", "lab"});
    t["app"] = before;
    return t;
  }();
  return table;
}

bool is_window_header(std::string_view header) {
  for (std::string_view start :
       {"GL/", "GLES", "KHR/", "EGL/", "GLFW/", "imgui", "backends/imgui", "epoxy/", "X11/"})
    if (header.starts_with(start)) return true;
  return false;
}

/// "folder/file:line: what is wrong", one for each include of the text that must not be.
std::vector<std::string> wrong_includes(const std::string& folder, const std::string& file,
                                        std::string_view text) {
  std::vector<std::string> wrong;
  int line = 0;
  while (!text.empty()) {
    ++line;
    std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(row.size() + 1, text.size()));
    auto skip_blanks = [&] {
      while (!row.empty() && (row.front() == ' ' || row.front() == '\t')) row.remove_prefix(1);
    };
    skip_blanks();
    if (!row.starts_with('#')) continue;
    row.remove_prefix(1);
    skip_blanks();
    if (!row.starts_with("include")) continue;
    row.remove_prefix(7);
    skip_blanks();
    if (row.empty() || (row.front() != '"' && row.front() != '<')) continue;
    char end = row.front() == '"' ? '"' : '>';
    bool quoted = end == '"';
    row.remove_prefix(1);
    std::string_view header = row.substr(0, row.find(end));
    std::string where = folder + "/" + file + ":" + std::to_string(line) + ": ";
    if (is_window_header(header)) {
      if (folder != "app") wrong.push_back(where + std::string(header) + " is for app/ alone");
      continue;
    }
    if (!quoted) continue;
    std::string_view other = header.substr(0, header.find('/'));
    if (other == header)
      wrong.push_back(where + std::string(header) + " names no folder");
    else if (!allowed().contains(other))
      wrong.push_back(where + std::string(other) + "/ is no layer");
    else if (other != folder && !allowed().at(folder).contains(std::string(other)))
      wrong.push_back(where + folder + "/ may not include " + std::string(other) + "/");
  }
  return wrong;
}

TEST(Architecture, TheCheckFindsWhatIsWrong) {
  EXPECT_EQ(
      wrong_includes("scene", "a.h", "#pragma once\n#include \"core/math.h\"\n#include <vector>\n").size(),
      0u);
  EXPECT_EQ(
      wrong_includes("render", "a.h", "#include \"render/film.h\"\n#include \"scene/document.h\"").size(),
      0u);
  EXPECT_EQ(wrong_includes("core", "a.h", "#include \"scene/document.h\"\n"),
            std::vector<std::string>{"core/a.h:1: core/ may not include scene/"});
  EXPECT_EQ(wrong_includes("io", "a.cpp", "\n  #  include \"render/film.h\""),
            std::vector<std::string>{"io/a.cpp:2: io/ may not include render/"});
  EXPECT_EQ(wrong_includes("render", "a.cpp", "#include \"io/exr.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("session", "a.cpp", "#include \"app/gl.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("bsdf", "a.h", "#include \"accel/accel.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("session", "a.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>").size(), 2u);
  EXPECT_EQ(
      wrong_includes("app", "a.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>\n#include \"io/exr.h\"")
          .size(),
      0u);
  EXPECT_EQ(wrong_includes("render", "a.cpp", "#include \"film.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("render", "a.cpp", "#include \"util/film.h\"").size(), 1u);
}

TEST(Architecture, SourcesIncludeOnlyWhatTheirLayerMay) {
  namespace fs = std::filesystem;
  fs::path root = fs::path(CANDELA_TEST_SOURCE_DIR) / "src";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    std::string ending = entry.path().extension().string();
    if (!entry.is_regular_file() || (ending != ".h" && ending != ".cpp")) continue;
    fs::path relative = fs::relative(entry.path(), root);
    std::string folder = relative.begin()->string();
    ASSERT_TRUE(allowed().contains(folder)) << relative << " is in no layer";
    std::ifstream in(entry.path(), std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const std::string& problem : wrong_includes(folder, fs::relative(relative, folder).string(), text))
      ADD_FAILURE() << problem;
    ++files;
  }
  EXPECT_GT(files, 50);
}

} // namespace
