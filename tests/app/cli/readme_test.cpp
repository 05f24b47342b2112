// The documents: generated tables are up to date, the list of keys is complete, links resolve.

#include "app/cli/scene_tables.h"
#include "app/cli/settings_command.h"
#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

namespace candela {
namespace {

std::string source(const std::string& name) {
  return test::read_text(std::string(CANDELA_TEST_SOURCE_DIR) + "/" + name);
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const auto from = text.find(begin), to = text.find(end, from);
  EXPECT_NE(from, std::string::npos) << begin;
  EXPECT_NE(to, std::string::npos) << end;
  if (from == std::string::npos || to == std::string::npos) return {};
  return text.substr(from + begin.size(), to - from - begin.size());
}

struct GeneratedTable {
  const char* name;
  const char* file;
  std::string text;
};

TEST(Readme, HoldsTheGeneratedTables) {
  const GeneratedTable tables[] = {{"settings", "scenes/settings.md", settings_markdown()},
                                   {"materials", "scenes/README.md", materials_markdown()},
                                   {"lights", "scenes/README.md", lights_markdown()},
                                   {"media", "scenes/README.md", media_markdown()},
                                   {"phases", "scenes/README.md", phases_markdown()},
                                   {"shapes", "scenes/README.md", shapes_markdown()},
                                   {"motion", "scenes/README.md", motion_markdown()}};
  for (const auto& [name, file, table] : tables)
    EXPECT_EQ(between(source(file), fmt::format("<!-- {} -->\n", name), fmt::format("<!-- /{} -->", name)),
              table)
        << "put between the marks of " << name << " in " << file
        << " (`candela settings --markdown` prints the settings):\n"
        << table;
}

/// The documents of the source tree, relative to its root.
std::vector<std::string> documents() {
  namespace fs = std::filesystem;
  const fs::path root(CANDELA_TEST_SOURCE_DIR);
  std::vector<std::string> out = {"README.md"};
  for (const char* folder : {"src", "scenes", "tests", "assets"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".md") out.push_back(fs::relative(entry.path(), root).generic_string());
  return out;
}

/// The anchors of GitHub's headings: lower case, blanks as hyphens, no punctuation.
std::string anchor(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ' || c == '-')
      out += '-';
  }
  return out;
}

std::set<std::string> anchors(const std::string& text) {
  static const std::regex kHeading("(^|\n)#+ ([^\n]*)");
  std::set<std::string> out;
  for (std::sregex_iterator at(text.begin(), text.end(), kHeading), end; at != end; ++at)
    out.insert(anchor((*at)[2]));
  return out;
}

/// A document's broken links, as "link: why".
std::vector<std::string> broken_links(const std::string& document, const std::string& text) {
  namespace fs = std::filesystem;
  static const std::regex kLink("\\]\\(([^)\\s]+)\\)");
  const fs::path root(CANDELA_TEST_SOURCE_DIR);
  std::vector<std::string> out;
  for (std::sregex_iterator at(text.begin(), text.end(), kLink), end; at != end; ++at) {
    const std::string link = (*at)[1];
    if (link.find("://") != std::string::npos) continue;
    const std::string file = link.substr(0, link.find('#'));
    const fs::path target = file.empty() ? root / document : root / fs::path(document).parent_path() / file;
    if (!fs::exists(target))
      out.push_back(link + ": no such file");
    else if (link.size() > file.size() &&
             !anchors(test::read_text(target.string())).contains(link.substr(file.size() + 1)))
      out.push_back(link + ": no such heading");
  }
  return out;
}

TEST(Readme, LinksOfAllDocumentsResolve) {
  EXPECT_EQ(broken_links("src/README.md", "[a](app/README.md#the-window), ![b](../assets/window.png)").size(),
            0u);
  EXPECT_EQ(broken_links("README.md", "[a](cellar.md) [b](README.md#attic)"),
            (std::vector<std::string>{"cellar.md: no such file", "README.md#attic: no such heading"}));
  const std::vector<std::string> all = documents();
  EXPECT_GE(all.size(), 8u);
  for (const std::string& document : all)
    for (const std::string& problem : broken_links(document, source(document)))
      ADD_FAILURE() << document << ": " << problem;
}

TEST(Readme, TheMapNamesEveryRoom) {
  namespace fs = std::filesystem;
  const fs::path src = fs::path(CANDELA_TEST_SOURCE_DIR) / "src";
  const std::string map = source("src/README.md"), program = source("src/app/README.md");
  int rooms = 0;
  for (const auto& layer : fs::directory_iterator(src)) {
    if (!layer.is_directory()) continue;
    const std::string name = layer.path().filename().string();
    EXPECT_NE(map.find("`" + name + "/"), std::string::npos) << name;
    for (const auto& room : fs::directory_iterator(layer)) {
      if (!room.is_directory()) continue;
      const std::string inner = room.path().filename().string();
      const std::string& readme = name == "app" ? program : map;
      const std::string entry =
          name == "app" ? fmt::format("`{}/`", inner) : fmt::format("`{}/{}/`", name, inner);
      EXPECT_NE(readme.find(entry), std::string::npos) << entry;
      ++rooms;
    }
  }
  EXPECT_GT(rooms, 20);
}

TEST(Readme, FitsAFirstHalfHour) {
  const std::string readme = source("README.md");
  EXPECT_LE(std::ranges::count(readme, '\n'), 200);
}

/// The keys in a list, such as "Ctrl+Shift+S", with the group in front of them, such as "number pad".
std::set<std::string> key_words(const std::string& list, const std::regex& line) {
  std::set<std::string> words;
  for (std::sregex_iterator at(list.begin(), list.end(), line), end; at != end; ++at) {
    std::string keys = std::regex_replace((*at)[1].str(), std::regex("[, ]+"), " ") + " ";
    std::string before; // "number pad 1 3 7" are all of the number pad
    for (const char* group : {"number pad ", "Ctrl "})
      if (keys.starts_with(group)) before = group, keys = keys.substr(before.size());
    for (std::size_t i = 0; i < keys.size(); i = keys.find(' ', i) + 1)
      words.insert(before + keys.substr(i, keys.find(' ', i) - i));
  }
  return words;
}

/// The label of a key.
std::string printed(const std::string& name) {
  static const std::map<std::string, std::string> kNames = {{"escape", "Esc"}, {"equal", "+"},
                                                            {"minus", "-"},    {"period", "."},
                                                            {"del", "Delete"}, {"digit_0", "0"}};
  if (const auto known = kNames.find(name); known != kNames.end()) return known->second;
  if (name.starts_with("keypad_")) return "number pad " + (name == "keypad_period" ? "." : name.substr(7));
  std::string out = name;
  out[0] = static_cast<char>(std::toupper(out[0]));
  return out;
}

std::vector<std::string> handled_keys(const std::string& code) {
  static const std::regex kKey("(case|\\(key ==) Key::([a-z_0-9]+)");
  std::vector<std::string> out;
  for (std::sregex_iterator at(code.begin(), code.end(), kKey), end; at != end; ++at) out.push_back((*at)[2]);
  return out;
}

TEST(Readme, AndTheHelpNameEveryKeyThatDoesSomething) {
  const std::string shortcuts = source("src/app/viewer/viewer_shortcuts.cpp");
  const std::string control =
      between(shortcuts, "void Viewer::run_control_shortcut(", "void Viewer::run_plain_shortcut(");
  const std::string plain = between(shortcuts, "void Viewer::run_plain_shortcut(", "void Viewer::escape(");
  const std::string views = between(shortcuts, "axis_view(Key key, bool control) {", "default:");
  std::set<std::string> keys = {"B"}; // held, in a comparison
  for (const std::string& code :
       {plain, views, source("src/app/viewer/inspector.cpp"), source("src/app/viewer/viewer_input.cpp")})
    for (const std::string& key : handled_keys(code)) keys.insert(printed(key));
  for (const std::string& key : handled_keys(control)) {
    const std::string name = printed(key);
    if (name == "number pad 0") continue; // as 0
    keys.insert((std::isalpha(static_cast<unsigned char>(name[0])) != 0 ? "Ctrl+" : "Ctrl ") + name);
  }
  EXPECT_GT(keys.size(), 45u);
  EXPECT_TRUE(keys.contains("M") && keys.contains("Ctrl+Q") && keys.contains("Space") && keys.contains("H"));
  const auto readme = key_words(between(source("src/app/README.md"), "| key | does |\n|---|---|\n", "\n\n"),
                                std::regex("\\| ([^|]*) \\|[^|]*\\|"));
  const auto help =
      key_words(between(source("src/app/panels/panels_overlay.cpp"), "kViewKeys[] = {", "void key_list("),
                std::regex("\\{\"([^\"]*)\","));
  for (const std::string& key : keys) {
    auto has = [&](const std::set<std::string>& words) {
      // The period of the number pad equals that of the keyboard.
      return words.contains(key) || ((key == "." || key == "number pad .") &&
                                     (words.contains(".") || words.contains("number pad .")));
    };
    EXPECT_TRUE(has(readme)) << key << " is missing in src/app/README.md";
    EXPECT_TRUE(has(help)) << key << " is missing in the help (F1)";
  }
}

} // namespace
} // namespace candela
