// What a picture shows at a point, against values by hand.

#include "core/color.h"
#include "textures/texture.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

ImageTexture image(int width, int height, int channels, Texels::Data data) {
  return {"", std::make_shared<const Texels>(Texels{width, height, channels, std::move(data)})};
}

/// The use of a colour, or of a number.
TextureUse use(ColorSpace space = ColorSpace::srgb, TextureChannel channel = TextureChannel::rgb) {
  TextureUse u;
  u.color_space = space;
  u.channel = channel;
  return u;
}

bool near(vec3 a, vec3 b) { return glm::length(a - b) < 1e-6f; }

TEST(ImageTexture, BlendsLinearLightBetweenTexelCentres) {
  const ImageTexture t =
      image(2, 2, 3, std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128});
  const float grey = linear_from_srgb(128 / 255.0f);
  auto at = [&](vec2 uv) { return t.color(use(), uv); };
  EXPECT_PRED2(near, at({0.25f, 0.75f}), vec3(1, 0, 0)); // v = 1 is the top row
  EXPECT_PRED2(near, at({0.75f, 0.75f}), vec3(0, 1, 0));
  EXPECT_PRED2(near, at({0.25f, 0.25f}), vec3(0, 0, 1));
  EXPECT_PRED2(near, at({0.75f, 0.25f}), vec3(grey));
  EXPECT_PRED2(near, at({0.5f, 0.75f}), vec3(0.5f, 0.5f, 0));
  EXPECT_PRED2(near, at({0, 0.75f}), vec3(0.5f, 0.5f, 0)); // repeats
  EXPECT_PRED2(near, at({-3.75f, 5.75f}), vec3(1, 0, 0));
  EXPECT_PRED2(near, at({0.5f, 0.5f}), 0.25f * (vec3(1, 1, 1) + vec3(grey)));
  for (TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror})
    for (TextureFilter filter : {TextureFilter::nearest, TextureFilter::bilinear})
      for (float bad : {NAN, INFINITY, -INFINITY, 1e30f, -1e-9f, 1.0f, 0x1.fffffep-1f}) {
        TextureUse u = use();
        u.wrap = wrap, u.filter = filter;
        EXPECT_TRUE(is_finite(t.color(u, {bad, bad}))) << bad;
      }
}

TEST(ImageTexture, IntegersAreDecodedAsTheUseSays) {
  const ImageTexture bytes = image(1, 1, 3, std::vector<std::uint8_t>{0, 128, 255});
  EXPECT_EQ(bytes.color(use(ColorSpace::linear), vec2(0.5f)), vec3(0, 128 / 255.0f, 1));
  EXPECT_EQ(bytes.color(use(), vec2(0.5f)), vec3(0, linear_from_srgb(128 / 255.0f), 1));
  // 0.2140 is what 0.5 means as sRGB (IEC 61966-2-1).
  const ImageTexture deep = image(1, 1, 3, std::vector<std::uint16_t>{257, 32768, 65535});
  EXPECT_EQ(deep.color(use(ColorSpace::linear), vec2(0.5f)), vec3(257 / 65535.0f, 32768 / 65535.0f, 1));
  EXPECT_NEAR(deep.color(use(), vec2(0.5f)).y, 0.21405f, 1e-4f);
  // Neighbours that 8 bits could not tell apart.
  const ImageTexture next = image(1, 1, 1, std::vector<std::uint16_t>{32769});
  EXPECT_GT(next.number(use(ColorSpace::linear), vec2(0.5f)), 32768 / 65535.0f);
  const ImageTexture floats = image(1, 1, 3, std::vector<float>{-1, 0.5f, 1000});
  for (ColorSpace space : {ColorSpace::srgb, ColorSpace::linear})
    EXPECT_EQ(floats.color(use(space), vec2(0.5f)), vec3(-1, 0.5f, 1000)) << "floats are linear";
}

TEST(ImageTexture, ChannelsOfOneThreeAndFour) {
  const auto linear = ColorSpace::linear;
  using enum TextureChannel;
  const ImageTexture grey = image(1, 1, 1, std::vector<std::uint8_t>{51});
  for (TextureChannel c : {rgb, red, green, blue}) {
    EXPECT_FLOAT_EQ(grey.number(use(linear, c), vec2(0)), 0.2f);
    EXPECT_EQ(grey.color(use(linear, c), vec2(0)), vec3(51 / 255.0f));
  }
  EXPECT_EQ(grey.number(use(linear, alpha), vec2(0)), 1) << "nothing is transparent";
  const ImageTexture four = image(1, 1, 4, std::vector<std::uint8_t>{255, 0, 51, 102});
  EXPECT_EQ(four.color(use(linear), vec2(0)), vec3(1, 0, 51 / 255.0f));
  const float expected[] = {luminance(vec3(1, 0, 0.2f)), 1, 0, 0.2f, 0.4f};
  for (TextureChannel c : {rgb, red, green, blue, alpha}) {
    EXPECT_FLOAT_EQ(four.number(use(linear, c), vec2(0)), expected[static_cast<int>(c)]);
    if (c != rgb) {
      EXPECT_EQ(four.color(use(linear, c), vec2(0)), vec3(four.number(use(linear, c), vec2(0))));
    }
  }
  EXPECT_FLOAT_EQ(four.number(use(ColorSpace::srgb, alpha), vec2(0)), 0.4f) << "no colour, so not encoded";
}

TEST(ImageTexture, WrapsAndFilters) {
  const ImageTexture ramp = image(4, 1, 1, std::vector<float>{0, 1, 2, 3});
  auto at = [&](TextureWrap wrap, TextureFilter filter, float u) {
    TextureUse how = use();
    how.wrap = wrap, how.filter = filter;
    return ramp.number(how, {u, 0.5f});
  };
  using enum TextureWrap;
  const auto near = TextureFilter::nearest, blend = TextureFilter::bilinear;
  struct Case {
    TextureWrap wrap;
    TextureFilter filter;
    float u, expected;
  };
  for (const Case& c : {Case{repeat, near, 0.3f, 1},
                        {repeat, near, 1.3f, 1},
                        {repeat, near, -0.1f, 3},
                        {clamp, near, -0.1f, 0},
                        {clamp, near, 1.6f, 3},
                        {clamp, near, 1, 3},
                        {mirror, near, 1.1f, 3},
                        {mirror, near, 1.9f, 0},
                        {mirror, near, -0.3f, 1},
                        {mirror, near, 2.3f, 1},
                        {repeat, blend, 0.25f, 0.5f},
                        {repeat, blend, 0, 1.5f},
                        {clamp, blend, 0, 0},
                        {clamp, blend, 7, 3},
                        {mirror, blend, 0, 0},
                        {mirror, blend, 1, 3},
                        {mirror, blend, 1.25f, 2.5f},
                        {clamp, blend, 0.25f, 0.5f}})
    EXPECT_NEAR(at(c.wrap, c.filter, c.u), c.expected, 1e-5f)
        << static_cast<int>(c.wrap) << static_cast<int>(c.filter) << ' ' << c.u;
}

TEST(ImageTexture, IsEqualByContent) {
  const ImageTexture a = image(1, 1, 1, std::vector<std::uint8_t>{7});
  EXPECT_EQ(a, image(1, 1, 1, std::vector<std::uint8_t>{7}));
  EXPECT_FALSE(a == image(1, 1, 1, std::vector<std::uint8_t>{8}));
  EXPECT_FALSE(a == image(1, 1, 1, std::vector<std::uint16_t>{7}));
}

TEST(CheckerTexture, HasSquaresOfTwoColours) {
  Texture checker{"", CheckerTexture{{1, 0, 0}, {0, 0, 4}, 2}};
  TextureUse how;
  const vec3 even(1, 0, 0), odd(0, 0, 4);
  EXPECT_EQ(texture_color(checker, how, vec2(0.1f, 0.1f)), even);
  EXPECT_EQ(texture_color(checker, how, vec2(0.6f, 0.1f)), odd);
  EXPECT_EQ(texture_color(checker, how, vec2(0.6f, 0.6f)), even);
  EXPECT_EQ(texture_color(checker, how, vec2(-0.1f, 0.1f)), odd);
  EXPECT_EQ(texture_color(checker, how, vec2(-7.6f, -0.1f)), odd);
  EXPECT_EQ(texture_number(checker, how, vec2(0.6f, 0.1f)), luminance(odd));
  how.channel = TextureChannel::blue;
  EXPECT_EQ(texture_number(checker, how, vec2(0.6f, 0.1f)), 4);
  EXPECT_EQ(texture_color(checker, how, vec2(0.6f, 0.1f)), vec3(4));
  how.uv.scale = vec2(2);
  EXPECT_EQ(texture_number(checker, how, vec2(0.3f, 0.1f)), 4);
}

TEST(Texture, KindsAreKnownByName) {
  for (std::string_view name : texture_kind_names()) {
    const auto model = texture_of_kind(name);
    ASSERT_TRUE(model);
    std::visit([&](const auto& kind) { EXPECT_EQ(kind.kName, name); }, *model);
  }
  EXPECT_FALSE(texture_of_kind("marble"));
  EXPECT_TRUE(texture_problem({"", CheckerTexture{vec3(1), vec3(0), -1}}).starts_with("squares: "));
}

TEST(Texels, KeepTheChannelsThatSaySomething) {
  auto fewest = [](int channels, Texels::Data data) {
    return with_fewest_channels({2, 1, channels, std::move(data)});
  };
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(fewest(4, Bytes{1, 2, 3, 255, 4, 5, 6, 255}), (Texels{2, 1, 3, Bytes{1, 2, 3, 4, 5, 6}}));
  EXPECT_EQ(fewest(4, Bytes{1, 1, 1, 255, 4, 4, 4, 255}), (Texels{2, 1, 1, Bytes{1, 4}}));
  EXPECT_EQ(fewest(3, Bytes{1, 1, 1, 4, 4, 4}), (Texels{2, 1, 1, Bytes{1, 4}}));
  EXPECT_EQ(fewest(4, Bytes{1, 1, 1, 255, 4, 4, 4, 254}).channels, 4);
  EXPECT_EQ(fewest(3, Bytes{1, 1, 1, 4, 4, 5}).channels, 3);
  EXPECT_EQ(fewest(3, std::vector<float>{2, 2, 2, 3, 3, 3}), (Texels{2, 1, 1, std::vector<float>{2, 3}}));
  EXPECT_EQ(srgb8_texels({2, 1, 1, std::vector<std::uint16_t>{0, 65535}}), (Bytes{0, 0, 0, 255, 255, 255}));
  EXPECT_STREQ(texels_problem({2, 1, 3, Bytes{1}}), "its pixels do not fit its size");
  EXPECT_STREQ(texels_problem({1, 1, 1, std::vector<float>{NAN}}), "a pixel is not finite");
}

} // namespace
} // namespace candela
