// Adding a material, a light or a texture kind takes its file and its entry in a list: no other code may
// branch over the models of a list one by one.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The alternatives in "using NAME = std::variant<A, B>;", or those that a list has more than another one, in
/// "using NAME = decltype(detail::with_more<A, B>(…));".
std::set<std::string> alternatives(const std::string& text, const std::string& name) {
  std::smatch list;
  if (!std::regex_search(
          text, list,
          std::regex("using " + name + " =\\s*(?:std::variant|decltype\\(detail::with_more)<([^>]*)>")))
    return {};
  std::set<std::string> out;
  const std::string names = list[1];
  const std::regex kName("\\w+");
  for (std::sregex_iterator at(names.begin(), names.end(), kName), end; at != end; ++at)
    out.insert(at->str());
  return out;
}

/// The models for which the text tests a variant's type.
std::set<std::string> tested_models(const std::string& text, const std::set<std::string>& models) {
  static const std::regex kTest(
      "(?:get_if|holds_alternative)\\s*<\\s*(\\w+)\\s*>|is_same_v\\s*<[^;{]*?,\\s*(\\w+)\\s*>");
  std::set<std::string> out;
  for (std::sregex_iterator at(text.begin(), text.end(), kTest), end; at != end; ++at)
    for (const std::string& name : {(*at)[1].str(), (*at)[2].str()})
      if (models.contains(name)) out.insert(name);
  return out;
}

struct ModelList {
  const char *header, *name;
};

class ExtensionPoints : public ::testing::TestWithParam<ModelList> {};

/// A feature of one model (an environment's panorama, say) may be handled elsewhere, and may replace another
/// model. From three on it is a chain that a new model would have to join.
constexpr std::size_t kMostTested = 2;

TEST_P(ExtensionPoints, NoFileBranchesOverTheModels) {
  const fs::path root = fs::path(CANDELA_TEST_SOURCE_DIR) / "src";
  const std::set<std::string> models = alternatives(text_of(root / GetParam().header), GetParam().name);
  ASSERT_GE(models.size(), 2u) << GetParam().header << " has no list " << GetParam().name;
  const std::string room = fs::path(GetParam().header).parent_path().generic_string() + "/";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string ending = entry.path().extension().string();
    if (!entry.is_regular_file() || (ending != ".h" && ending != ".cpp")) continue;
    const std::string file = fs::relative(entry.path(), root).generic_string();
    if (file.starts_with(room)) continue;
    const std::set<std::string> tested = tested_models(text_of(entry.path()), models);
    EXPECT_LE(tested.size(), kMostTested) << file << " branches over the models of " << GetParam().name;
    ++files;
  }
  EXPECT_GT(files, 50);
}

INSTANTIATE_TEST_SUITE_P(Lists, ExtensionPoints,
                         ::testing::Values(ModelList{"materials/material_list.h", "ScatteringModel"},
                                           ModelList{"materials/material_list.h", "MaterialModel"},
                                           ModelList{"lights/light.h", "LightDescModel"},
                                           ModelList{"textures/texture.h", "TextureModel"}),
                         [](const auto& list) { return std::string(list.param.name); });

TEST(ExtensionPointsCheck, FindsChains) {
  const std::set<std::string> models = alternatives("using M =\n    std::variant<A, Bc, D>;", "M");
  EXPECT_EQ(models, (std::set<std::string>{"A", "Bc", "D"}));
  EXPECT_EQ(tested_models("if (std::get_if<A>(&m)) {} else if (std::holds_alternative< Bc >(m)) {}", models),
            (std::set<std::string>{"A", "Bc"}));
  EXPECT_EQ(tested_models("if constexpr (std::is_same_v<std::decay_t<decltype(m)>, D>) {}", models),
            std::set<std::string>{"D"});
  EXPECT_EQ(tested_models("m = A{}; std::get_if<Other>(&m);", models), std::set<std::string>{});
}

} // namespace
