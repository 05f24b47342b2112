#include "app/cli/settings_command.h"
#include "scene/document.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace candela {
namespace {

using nlohmann::json;

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(SettingsCommand, JsonHoldsEveryRowWithADefaultThatCanBeSet) {
  json rows = json::parse(settings_json());
  ASSERT_EQ(rows.size(), settings_table().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = settings_table()[i];
    EXPECT_EQ(rows[i]["key"], row.key);
    EXPECT_EQ(rows[i]["help"], row.help);
    EXPECT_TRUE(rows[i]["restarts"].is_string());
    const json& value = rows[i]["default"];
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
    Document document;
    apply_setting(document, fmt::format("{}={}", row.key, text));
    EXPECT_TRUE(document == Document()) << row.key << '=' << text;
  }
}

TEST(SettingsCommand, JsonTellsTypesAndBounds) {
  json rows = json::parse(settings_json());
  auto row = [&](std::string_view key) {
    return *std::ranges::find_if(rows, [&](const json& r) { return r["key"] == key; });
  };
  EXPECT_EQ(row("film.width")["minimum"], 1);
  EXPECT_TRUE(row("film.width")["minimum"].is_number_integer());
  EXPECT_EQ(row("camera.vertical_fov")["unit"], "degrees");
  EXPECT_EQ(row("camera.vertical_fov")["default"], 45);
  EXPECT_TRUE(row("camera.position")["maximum"].is_null());
  EXPECT_EQ(row("display.tone_map")["choices"],
            json({"reinhard", "reinhard_simple", "filmic", "aces", "srgb"}));
  EXPECT_EQ(row("display.tone_map")["restarts"], "the display");
}

TEST(SettingsCommand, MarkdownIsATableOfFiveColumns) {
  auto table = lines(settings_markdown());
  ASSERT_EQ(table.size(), settings_table().size() + 2);
  for (const std::string& line : table) {
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    EXPECT_EQ(bars, 6) << line;
  }
}

TEST(SettingsCommand, TextNamesEveryKeyWithItsDomain) {
  std::string text = settings_text();
  for (const auto& row : settings_table()) {
    EXPECT_NE(text.find(fmt::format("\n{} ", row.key)), std::string::npos) << row.key;
    EXPECT_NE(text.find(field_domain(row)), std::string::npos) << row.key;
  }
}

TEST(SettingsCommand, PrintsTheFormAskedFor) {
  for (auto [want_json, want_markdown, expected] : {std::tuple(false, false, settings_text()),
                                                    {true, false, settings_json()},
                                                    {false, true, settings_markdown()}}) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_settings(want_json, want_markdown), 0);
    std::fflush(stdout);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), expected);
  }
}

} // namespace
} // namespace candela
