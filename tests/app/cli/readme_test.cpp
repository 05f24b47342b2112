// The README's generated parts are what the program generates, and its list of keys is complete.

#include "app/cli/scene_tables.h"
#include "app/cli/settings_command.h"
#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

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

TEST(Readme, HoldsTheGeneratedTables) {
  const std::string readme = source("README.md");
  const std::map<std::string, std::string> tables = {{"settings", settings_markdown()},
                                                     {"materials", materials_markdown()},
                                                     {"lights", lights_markdown()},
                                                     {"shapes", shapes_markdown()}};
  for (const auto& [name, table] : tables)
    EXPECT_EQ(between(readme, fmt::format("<!-- {} -->\n", name), fmt::format("<!-- /{} -->", name)), table)
        << "put between the marks of " << name << " (`candela settings --markdown` prints the settings):\n"
        << table;
}

/// The words of a list's keys, "Ctrl+Shift+S" being one; what stands before it on its line, if it is given.
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

/// What is printed on a key.
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
  const auto readme = key_words(between(source("README.md"), "| key | does |\n|---|---|\n", "\n\n"),
                                std::regex("\\| ([^|]*) \\|[^|]*\\|"));
  const auto help =
      key_words(between(source("src/app/panels/panels_overlay.cpp"), "kViewKeys[] = {", "void key_list("),
                std::regex("\\{\"([^\"]*)\","));
  for (const std::string& key : keys) {
    auto has = [&](const std::set<std::string>& words) {
      // The period of the number pad is that of the keyboard.
      return words.contains(key) || ((key == "." || key == "number pad .") &&
                                     (words.contains(".") || words.contains("number pad .")));
    };
    EXPECT_TRUE(has(readme)) << key << " is missing in README.md";
    EXPECT_TRUE(has(help)) << key << " is missing in the help (F1)";
  }
}

} // namespace
} // namespace candela
