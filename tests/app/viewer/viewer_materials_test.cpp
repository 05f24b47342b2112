// Materials of other materials, by the Materials panel.

#include "app/harness.h"

#include <fmt/format.h>

namespace candela::test {
namespace {

struct ViewerMaterials : ::testing::Test {
  ViewerHarness hand;

  ViewerMaterials() { hand.unfold_all(); }
  const std::vector<Material>& materials() { return hand.document().scene.materials; }
};

TEST_F(ViewerMaterials, ABlendNamesTwoAndTheirWeight) {
  hand.click("materials/0");
  hand.choose("material.type", "blend");
  hand.choose("material.first", "red");
  hand.choose("material.second", "green");
  hand.type_into("material.weight", "0.25");
  hand.frame(2);
  const auto& blend = std::get<BlendMaterial>(materials()[0].model);
  EXPECT_EQ(materials()[static_cast<std::size_t>(blend.first)].name, "red");
  EXPECT_EQ(materials()[static_cast<std::size_t>(blend.second)].name, "green");
  EXPECT_EQ(blend.weight.value, 0.25f);
  EXPECT_TRUE(hand.find("material.weight.texture").has_value()) << "the weight may be a texture";
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().error, "");
  hand.choose("material.first", "none");
  EXPECT_EQ(std::get<BlendMaterial>(materials()[0].model).first, -1);
}

TEST_F(ViewerMaterials, NothingThatContainsItIsOffered) {
  hand.click("materials/0");
  hand.choose("material.type", "two_sided");
  hand.choose("material.back", "red");
  const int red = std::get<TwoSidedMaterial>(materials()[0].model).back;
  hand.click(fmt::format("materials/{}", red));
  hand.choose("material.type", "blend");
  hand.click("material.first");
  hand.frame(2);
  EXPECT_TRUE(hand.find("material.first/green").has_value());
  EXPECT_FALSE(hand.find("material.first/white").has_value()) << "that names this one";
  EXPECT_FALSE(hand.find("material.first/red").has_value()) << "itself";
}

TEST_F(ViewerMaterials, APartOfOthersCannotBecomeInvisible) {
  hand.click("materials/0");
  hand.choose("material.type", "blend");
  hand.choose("material.first", "red");
  const int red = std::get<BlendMaterial>(materials()[0].model).first;
  hand.click(fmt::format("materials/{}", red));
  hand.choose("material.type", "null");
  EXPECT_EQ(material_type_name(materials()[static_cast<std::size_t>(red)]), "diffuse");
  EXPECT_NE(hand.state().error.find("'red' is invisible"), std::string::npos) << hand.state().error;
  hand.choose("material.type", "mirror");
  EXPECT_EQ(hand.state().error, "");
  EXPECT_EQ(document_problem(hand.document()), "");
}

} // namespace
} // namespace candela::test
