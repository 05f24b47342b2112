// A folder of src/ may include only itself and the folders before it; the same holds for the rooms within a
// folder. Only app/ may include window libraries.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// The rooms of a layer that has some, in an order in which each may include those before it. What lies in
/// the layer's folder itself is its front door: it may include all, and no room includes it.
const std::map<std::string, std::vector<std::string>, std::less<>>& rooms() {
  static const std::map<std::string, std::vector<std::string>, std::less<>> table = {
      {"accel", {"simd", "primitives"}},
      {"io", {"files", "images", "ies", "curves", "volumes", "obj", "builder", "candela", "cs123"}},
      {"render", {"lights", "world", "camera", "integrators", "film", "denoise"}},
      {"app",
       {"platform", "console", "figures", "ui", "tools", "compare", "lab", "panels", "viewer", "window",
        "bench", "cli"}},
  };
  return table;
}

/// The layers that each layer may include besides itself.
const std::map<std::string, std::set<std::string>, std::less<>>& allowed() {
  static const std::map<std::string, std::set<std::string>, std::less<>> table = [] {
    std::map<std::string, std::set<std::string>, std::less<>> t;
    std::set<std::string> before;
    for (const char* folder : {"core", "sampling", "imaging", "bsdf", "media", "textures", "materials",
                               "lights", "accel", "scene"}) {
      t[folder] = before;
      before.insert(folder);
    }
    t["io"] = t["render"] = before; // siblings
    before.insert({"io", "render"});
    t["session"] = before;
    t["lab"] = {"core", "sampling", "imaging", "bsdf", "media", "textures", "materials"};
    before.insert({"session", "lab"});
    t["app"] = before;
    return t;
  }();
  return table;
}

/// "layer/room/file.h" by its parts; the room is empty for a file in the layer's own folder.
struct Place {
  std::string layer, room;
};
Place place_of(std::string_view path) {
  const std::size_t first = path.find('/'), second = path.find('/', first + 1);
  return {std::string(path.substr(0, first)),
          second == path.npos ? std::string() : std::string(path.substr(first + 1, second - first - 1))};
}

/// Where a room stands in its layer's order; nothing for rooms that there are not.
std::optional<std::size_t> rank(const Place& place) {
  const auto layer = rooms().find(place.layer);
  const std::vector<std::string> none;
  const std::vector<std::string>& order = layer == rooms().end() ? none : layer->second;
  if (place.room.empty()) return order.size();
  const auto found = std::find(order.begin(), order.end(), place.room);
  if (found == order.end()) return std::nullopt;
  return static_cast<std::size_t>(found - order.begin());
}

bool is_window_header(std::string_view header) {
  for (std::string_view start :
       {"GL/", "GLES", "KHR/", "EGL/", "GLFW/", "imgui", "backends/imgui", "epoxy/", "X11/"})
    if (header.starts_with(start)) return true;
  return false;
}

/// "path:line: what is wrong", one for each include of the text that must not be.
std::vector<std::string> wrong_includes(const std::string& path, std::string_view text) {
  const Place own = place_of(path);
  const std::string& folder = own.layer;
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
    std::string where = path + ":" + std::to_string(line) + ": ";
    if (is_window_header(header)) {
      if (folder != "app") wrong.push_back(where + std::string(header) + " is for app/ alone");
      continue;
    }
    if (!quoted) continue;
    const Place other = place_of(header);
    if (other.layer == header)
      wrong.push_back(where + std::string(header) + " names no folder");
    else if (!allowed().contains(other.layer))
      wrong.push_back(where + other.layer + "/ is no layer");
    else if (!rank(other))
      wrong.push_back(where + other.layer + "/" + other.room + "/ is no room");
    else if (other.layer != folder && !allowed().at(folder).contains(other.layer))
      wrong.push_back(where + folder + "/ may not include " + other.layer + "/");
    else if (other.layer == folder && rank(other) > rank(own))
      wrong.push_back(where + folder + "/" + own.room + "/ may not include " +
                      (other.room.empty() ? folder + "/ itself" : folder + "/" + other.room + "/"));
  }
  return wrong;
}

TEST(Architecture, TheCheckFindsWhatIsWrong) {
  EXPECT_EQ(wrong_includes("scene/a.h", "#pragma once\n#include \"core/math.h\"\n#include <vector>\n").size(),
            0u);
  EXPECT_EQ(
      wrong_includes("render/a.h", "#include \"render/film/film.h\"\n#include \"scene/document.h\"").size(),
      0u);
  EXPECT_EQ(wrong_includes("core/a.h", "#include \"scene/document.h\"\n"),
            std::vector<std::string>{"core/a.h:1: core/ may not include scene/"});
  EXPECT_EQ(wrong_includes("io/a.cpp", "\n  #  include \"render/film/film.h\""),
            std::vector<std::string>{"io/a.cpp:2: io/ may not include render/"});
  EXPECT_EQ(wrong_includes("render/a.cpp", "#include \"io/images/exr.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("session/a.cpp", "#include \"app/platform/gl.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("bsdf/a.h", "#include \"accel/accel.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("session/a.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>").size(), 2u);
  EXPECT_EQ(
      wrong_includes("app/a.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>\n#include \"io/images/exr.h\"")
          .size(),
      0u);
  EXPECT_EQ(wrong_includes("render/a.cpp", "#include \"film.h\"").size(), 1u);
  EXPECT_EQ(wrong_includes("render/a.cpp", "#include \"util/film.h\"").size(), 1u);
}

TEST(Architecture, TheCheckKnowsTheRoomsOfALayer) {
  EXPECT_EQ(wrong_includes("render/film/a.h", "#include \"render/integrators/transport.h\"").size(), 0u);
  EXPECT_EQ(wrong_includes("render/lights/a.h", "#include \"render/world/geometry.h\""),
            std::vector<std::string>{"render/lights/a.h:1: render/lights/ may not include render/world/"});
  EXPECT_EQ(wrong_includes("io/obj/a.h", "\n#include \"io/scene_reader.h\""),
            std::vector<std::string>{"io/obj/a.h:2: io/obj/ may not include io/ itself"});
  EXPECT_EQ(wrong_includes("io/a.h", "#include \"io/obj/obj_reader.h\"").size(), 0u);
  EXPECT_EQ(wrong_includes("app/main.cpp", "#include \"io/cellar/a.h\""),
            std::vector<std::string>{"app/main.cpp:1: io/cellar/ is no room"});
}

TEST(Architecture, SourcesIncludeOnlyWhatTheirLayerMay) {
  namespace fs = std::filesystem;
  fs::path root = fs::path(CANDELA_TEST_SOURCE_DIR) / "src";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    std::string ending = entry.path().extension().string();
    if (!entry.is_regular_file() || (ending != ".h" && ending != ".cpp")) continue;
    fs::path relative = fs::relative(entry.path(), root);
    const Place place = place_of(relative.generic_string());
    ASSERT_TRUE(allowed().contains(place.layer)) << relative << " is in no layer";
    ASSERT_TRUE(rank(place)) << relative << " is in no room";
    std::ifstream in(entry.path(), std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const std::string& problem : wrong_includes(relative.generic_string(), text))
      ADD_FAILURE() << problem;
    ++files;
  }
  EXPECT_GT(files, 50);
}

} // namespace
