// Textures in the window: selected for a parameter, dropped on it, edited.

#include "app/harness.h"
#include "io/images/image_file.h"
#include "support/materials.h"

namespace {

using namespace candela;
using namespace candela::test;

const TextureUse& use(ViewerHarness& hand, std::string_view key) {
  return use_of(hand.document().scene.materials[1], key);
}

TEST(ViewerTexturesUi, APictureDroppedOnAParameterIsItsTexture) {
  ScratchFolder folder;
  write_srgb8_image(2, 1, std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255}, folder / "a.png");
  ViewerHarness hand;
  hand.unfold_all();
  hand.click("materials/1");
  for (const char* key : {"diffuse", "opacity", "emission"}) {
    hand.move(hand.reveal(std::string("material.") + key + ".texture"));
    hand.frame(2);
    hand.send(FilesDropped{{folder / "a.png"}});
    hand.wait_until("it is read", [&] { return use(hand, key).texture >= 0; });
  }
  EXPECT_EQ(hand.state().error, "");
  EXPECT_EQ(hand.document().scene.lights.size(), 1u) << "it does not light the scene";
  ASSERT_EQ(hand.document().scene.textures.size(), 1u) << "one file is one texture";
  EXPECT_EQ(hand.document().scene.textures[0]->name, "a.png");
  EXPECT_EQ(use(hand, "opacity").color_space, ColorSpace::linear);
  hand.wait_for_picture();
  hand.screenshot("texture_picker");
  hand.send(FilesDropped{{folder / "gone.png"}});
  hand.wait_until("it is refused", [&] { return !hand.state().error.empty(); });
}

TEST(ViewerTexturesUi, ATextureIsChosenEditedAndTakenAway) {
  ViewerHarness hand;
  hand.unfold_all();
  hand.click("materials/1");
  hand.choose("material.diffuse.texture", "new checker");
  ASSERT_EQ(use(hand, "diffuse").texture, 0);
  ASSERT_TRUE(std::holds_alternative<CheckerTexture>(hand.document().scene.textures[0]->model));
  hand.unfold("material.diffuse.texture_use", "material.diffuse.texture.wrap");
  hand.type_into("material.diffuse.texture.scale_u", "3");
  hand.type_into("material.diffuse.texture.squares", "5");
  hand.choose("material.diffuse.texture.channel", "green");
  EXPECT_EQ(use(hand, "diffuse").uv.scale, vec2(3, 1));
  EXPECT_EQ(use(hand, "diffuse").channel, TextureChannel::green);
  EXPECT_EQ(std::get<CheckerTexture>(hand.document().scene.textures[0]->model).squares, 5);
  hand.choose("material.opacity.texture", "0");
  EXPECT_EQ(use(hand, "opacity").texture, 0) << "the same texture";
  hand.choose("material.diffuse.texture", "none");
  EXPECT_EQ(use(hand, "diffuse"), ColorParameter::standard_use());
}

} // namespace
