// The README's generated parts are what the program generates.

#include "app/settings_command.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace candela {
namespace {

TEST(Readme, HoldsTheSettingsTable) {
  std::ifstream in(CANDELA_TEST_SOURCE_DIR "/README.md");
  std::stringstream text;
  text << in.rdbuf();
  std::string readme = text.str();
  const std::string begin = "<!-- settings -->\n", end = "<!-- /settings -->";
  auto from = readme.find(begin);
  auto to = readme.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(readme.substr(from + begin.size(), to - from - begin.size()), settings_markdown())
      << "put the output of `candela settings --markdown` between the marks";
}

} // namespace
} // namespace candela
