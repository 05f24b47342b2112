// A texture as a grid of values and pixels, against values by hand and the look-ups of the renderer.

#include "core/color.h"
#include "support/textures.h"
#include "textures/texture_grid.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

using test::picture_texture;
using Pixels = std::vector<std::uint8_t>;

TextureGridOptions plain(ColorSpace space = ColorSpace::srgb) {
  TextureGridOptions options;
  options.color_space = space;
  return options;
}

std::shared_ptr<const Texture> pattern(TextureModel model) {
  return std::make_shared<const Texture>(Texture{"", std::move(model)});
}

Pixels pixels_of(const TextureGrid& grid, const TextureDisplay& display = {}, int reduction = 0) {
  return grid_pixels(grid, display, reduction, ivec2(0), reduced_size(grid.size(), reduction));
}

TEST(TextureGrid, APictureIsShownByteByByte) {
  Pixels all;
  for (int i = 0; i < 256; ++i)
    all.insert(all.end(), {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 7});
  for (ColorSpace space : {ColorSpace::srgb, ColorSpace::linear}) { // also a normal map's
    const Pixels shown = pixels_of(TextureGrid(picture_texture(16, 16, all), plain(space)));
    for (std::size_t i = 0; i < 256; ++i)
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(shown[4 * i + c], all[3 * i + c]) << i;
  }
}

TEST(TextureGrid, TellsWhatIsStoredAndWhatItMeans) {
  const auto texture = picture_texture(2, 1, {128, 0, 255, 64, 10, 20, 30, 255}, 4);
  const TextureGrid grid(texture, plain());
  const auto stored = grid.stored({0, 0});
  ASSERT_TRUE(stored);
  EXPECT_TRUE(stored->integer);
  EXPECT_EQ(stored->channels, 4);
  EXPECT_EQ(stored->values, (std::array<float, 4>{128, 0, 255, 64}));
  EXPECT_EQ(grid.value({0, 0}), vec4(linear_from_srgb(128 / 255.0f), 0, 1, 64 / 255.0f));
  EXPECT_EQ(TextureGrid(texture, plain(ColorSpace::linear)).value({0, 0}),
            vec4(128 / 255.0f, 0, 1, 64 / 255.0f));
  EXPECT_EQ(grid.uv({0, 0}), vec2(0.25f, 0.5f));
}

TEST(TextureGrid, ChannelsAndExposure) {
  const TextureGrid grid(picture_texture(1, 1, {200, 100, 50, 64}, 4), plain());
  auto shown = [&](ShownChannel channel, float exposure = 0) { return pixels_of(grid, {channel, exposure}); };
  EXPECT_EQ(shown(ShownChannel::rgb), (Pixels{200, 100, 50, 255}));
  EXPECT_EQ(shown(ShownChannel::red), (Pixels{200, 200, 200, 255}));
  EXPECT_EQ(shown(ShownChannel::green), (Pixels{100, 100, 100, 255}));
  EXPECT_EQ(shown(ShownChannel::blue), (Pixels{50, 50, 50, 255}));
  EXPECT_EQ(shown(ShownChannel::alpha, 3), (Pixels{64, 64, 64, 255}));
  auto texels = std::make_shared<const Texels>(Texels{1, 1, 1, std::vector<float>{4}});
  const TextureGrid bright(pattern(ImageTexture{"", texels}), plain());
  EXPECT_EQ(pixels_of(bright, {ShownChannel::rgb, -3})[0], 188) << "half of white";
  EXPECT_EQ(pixels_of(bright)[0], 255);
}

TEST(TextureGrid, CopiesFollowTheWrapMode) {
  const auto texture = picture_texture(2, 2, {1, 2, 3, 4}, 1); // v = 0 is the row of 3 and 4
  auto rows = [&](TextureWrap wrap) {
    TextureGridOptions options = plain();
    options.copies = 2;
    options.wrap = wrap;
    const Pixels shown = pixels_of(TextureGrid(texture, options));
    std::string text;
    for (std::size_t i = 0; i < shown.size(); i += 4) text += static_cast<char>('0' + shown[i]);
    return text;
  };
  EXPECT_EQ(rows(TextureWrap::repeat), "1212"
                                       "3434"
                                       "1212"
                                       "3434");
  EXPECT_EQ(rows(TextureWrap::clamp), "1222"
                                      "1222"
                                      "1222"
                                      "3444");
  EXPECT_EQ(rows(TextureWrap::mirror), "3443"
                                       "1221"
                                       "1221"
                                       "3443");
}

/// Every value of a grid of a parameter is what the renderer's look-up gives there.
void expect_as_looked_up(const TextureModel& model, const TextureUse& use) {
  const Texture texture{"", model};
  for (int copies : {1, 2}) {
    TextureGridOptions options;
    options.look = ParameterLook{use, false, {2, 0.5f, 1}, {-0.25f, 0.1f, 0}, 0, 1};
    options.resolution = 24;
    options.copies = copies;
    const TextureGrid grid(std::make_shared<const Texture>(texture), options);
    const ivec2 size = grid.size();
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const float n = static_cast<float>(copies);
        const vec2 uv(n * (static_cast<float>(x) + 0.5f) / static_cast<float>(size.x),
                      n * (1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(size.y)));
        const vec3 want = glm::clamp(
            vec3(2, 0.5f, 1) * texture_color(texture, use, uv) + vec3(-0.25f, 0.1f, 0), 0.0f, 1.0f);
        ASSERT_LT(glm::length(vec3(grid.value({x, y})) - want), 2e-5f) << x << ", " << y;
      }
  }
}

TEST(TextureGrid, AParameterSeesWhatTheRendererLooksUp) {
  TextureUse use;
  use.uv = {{3, 1.7f}, {0.31f, -0.2f}, radians(0.0f)};
  use.filter = TextureFilter::nearest;
  const auto picture = picture_texture(5, 3, Pixels(45, 90));
  expect_as_looked_up(picture->model, use);
  use.channel = TextureChannel::green;
  use.wrap = TextureWrap::mirror;
  use.filter = TextureFilter::bilinear;
  Pixels texels;
  for (int i = 0; i < 45; ++i) texels.push_back(static_cast<std::uint8_t>(5 * i));
  expect_as_looked_up(picture_texture(5, 3, texels)->model, use);
  use.channel = TextureChannel::rgb;
  expect_as_looked_up(NoiseTexture(), use);
  expect_as_looked_up(WorleyTexture(), use);
  expect_as_looked_up(GradientTexture(), use);
}

TEST(TextureGrid, ANumberIsOneValue) {
  TextureGridOptions options;
  options.look = ParameterLook{{}, true, vec3(0.5f), vec3(0.125f), 0, 1};
  options.look->use.color_space = ColorSpace::linear;
  const TextureGrid grid(picture_texture(1, 1, {255, 0, 0}), options);
  EXPECT_NEAR(grid.value({0, 0}).x, 0.5f * 0.212671f + 0.125f, 1e-6f) << "its luminance";
  EXPECT_EQ(grid.value({0, 0}).x, grid.value({0, 0}).z);
  EXPECT_FALSE(grid.stored({0, 0}));
}

TEST(TextureGrid, PatternsAreEvaluatedOverTheUnitSquare) {
  TextureGridOptions options;
  options.resolution = 16;
  const TextureGrid grid(pattern(CheckerTexture{{1, 0, 0}, {0, 0, 1}, 2}), options);
  EXPECT_EQ(grid.size(), ivec2(16));
  EXPECT_EQ(vec3(grid.value({0, 15})), vec3(1, 0, 0)) << "even at the origin, which is below";
  EXPECT_EQ(vec3(grid.value({8, 15})), vec3(0, 0, 1));
  EXPECT_EQ(vec3(grid.value({8, 7})), vec3(1, 0, 0));
}

TEST(TextureGrid, LevelsAreThoseOfThePyramid) {
  Pixels texels;
  for (int i = 0; i < 6 * 4 * 3; ++i) texels.push_back(static_cast<std::uint8_t>(3 * i));
  const auto texture = picture_texture(6, 4, texels);
  const auto pyramid = std::make_shared<const MipPyramid>(texture->image()->texels, ColorSpace::srgb);
  TextureGridOptions options = plain();
  options.level = 1;
  const TextureGrid grid(texture, options, pyramid);
  ASSERT_EQ(grid.size(), ivec2(3, 2));
  const auto& level = pyramid->levels()[0];
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(grid.value({i % 3, i / 3}).y, level.values[static_cast<std::size_t>(3 * i + 1)]);
  options.level = 99;
  EXPECT_EQ(TextureGrid(texture, options, pyramid).size(), ivec2(1)) << "the last";
}

TEST(TextureGrid, ReducedPixelsAreMeansOfLight) {
  const TextureGrid grid(picture_texture(4, 2, {0, 255, 9, 9, 255, 0, 9, 9}, 1), plain());
  EXPECT_EQ(reduced_size({5, 3}, 1), ivec2(3, 2));
  const Pixels shown = pixels_of(grid, {}, 1);
  ASSERT_EQ(shown.size(), 8u);
  EXPECT_EQ(shown[0], 188) << "half of the light, not half of the code";
  EXPECT_EQ(shown[4], 9);
}

TEST(TextureGrid, PartsOfItFitTogether) {
  TextureGridOptions options;
  options.resolution = 50;
  const TextureGrid grid(pattern(NoiseTexture()), options);
  for (int reduction : {0, 1, 3}) {
    const Pixels whole = pixels_of(grid, {}, reduction);
    const ivec2 size = reduced_size(grid.size(), reduction), origin(2, 3), part(3, 2);
    const Pixels some = grid_pixels(grid, {}, reduction, origin, part);
    for (int y = 0; y < part.y; ++y)
      for (int x = 0; x < part.x; ++x)
        for (int c = 0; c < 4; ++c)
          ASSERT_EQ(some[static_cast<std::size_t>(4 * (y * part.x + x) + c)],
                    whole[static_cast<std::size_t>(4 * ((y + origin.y) * size.x + x + origin.x) + c)]);
  }
}

TEST(TextureGrid, GivesUp) {
  Progress progress;
  progress.cancel();
  const TextureGrid grid(pattern(NoiseTexture()), {});
  EXPECT_THROW(grid_pixels(grid, {}, 0, ivec2(0), ivec2(8), &progress), Cancelled);
}

} // namespace
} // namespace candela
