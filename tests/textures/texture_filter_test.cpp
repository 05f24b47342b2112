// Means over footprints, against sums over many points.

#include "support/seed.h"
#include "textures/texture.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

std::shared_ptr<const Texels> random_texels(int width, int height, int channels) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(test::fresh_seed()));
  std::vector<std::uint8_t> values(static_cast<std::size_t>(width * height * channels));
  for (auto& v : values) v = static_cast<std::uint8_t>(random());
  return std::make_shared<const Texels>(Texels{width, height, channels, std::move(values)});
}
Texture picture(std::shared_ptr<const Texels> texels) { return {"", ImageTexture{"", std::move(texels)}}; }
TextureUse trilinear(ColorSpace space = ColorSpace::srgb) {
  TextureUse use;
  use.filter = TextureFilter::trilinear;
  use.color_space = space;
  return use;
}
/// Mean of the texture itself over the footprint.
vec4 mean_of_points(const Texture& texture, TextureUse use, const TexturePoint& at) {
  use.filter = TextureFilter::bilinear;
  constexpr int kSide = 100;
  glm::dvec3 sum(0);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const vec2 s = (vec2(x, y) + 0.5f) / static_cast<float>(kSide) - 0.5f;
      sum += glm::dvec3(
          texture_color(texture, use, at.uv + s.x * at.footprint.major + s.y * at.footprint.minor));
    }
  return {vec3(sum / static_cast<double>(kSide * kSide)), 1};
}

TEST(MipPyramid, LevelsHaveTheMeanOfThePicture) {
  SCOPED_TRACE(test::seed_note());
  for (int channels : {1, 3, 4})
    for (auto [width, height] : {std::pair{8, 8}, {5, 3}, {1, 9}, {7, 1}, {13, 22}, {1, 1}}) {
      const auto texels = random_texels(width, height, channels);
      for (ColorSpace space : {ColorSpace::srgb, ColorSpace::linear}) {
        const MipPyramid pyramid(texels, space);
        const auto n = static_cast<std::size_t>(channels);
        std::vector<double> mean(n, 0);
        const auto& bytes = std::get<0>(texels->data);
        for (std::size_t i = 0; i < bytes.size(); ++i) {
          const float value = static_cast<float>(bytes[i]) / 255;
          const bool encoded = space == ColorSpace::srgb && i % n != 3;
          mean[i % n] += static_cast<double>(encoded ? linear_from_srgb(value) : value) / (width * height);
        }
        int w = width, h = height;
        for (const MipPyramid::Level& level : pyramid.levels()) {
          w = std::max(w / 2, 1), h = std::max(h / 2, 1);
          ASSERT_EQ(level.width, w);
          ASSERT_EQ(level.height, h);
          std::vector<double> here(n, 0);
          for (std::size_t i = 0; i < level.values.size(); ++i)
            here[i % n] += static_cast<double>(level.values[i]) / (w * h);
          for (std::size_t c = 0; c < n; ++c) EXPECT_NEAR(here[c], mean[c], 1e-6) << w << 'x' << h;
        }
        EXPECT_TRUE(w == 1 && h == 1);
      }
    }
}

TEST(MipPyramid, SmallFootprintsAreBilinearAndEndlessOnesTheMean) {
  const auto texels = random_texels(16, 8, 3);
  const Texture texture = picture(texels);
  const MipPyramid pyramid(texels, ColorSpace::srgb);
  TextureUse bilinear;
  const auto& last = pyramid.levels().back().values;
  for (TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror}) {
    TextureUse use = trilinear();
    use.wrap = bilinear.wrap = wrap;
    auto at = [&](vec2 major, vec2 minor) {
      return vec3(*texture_filtered(texture, use, {{0.3f, 0.7f}, {major, minor}}, &pyramid));
    };
    const vec3 point = texture_color(texture, bilinear, vec2(0.3f, 0.7f));
    EXPECT_EQ(at({0.05f, 0}, {0, 0.1f}), point);
    for (float big : {50.0f, 1e12f, INFINITY, NAN}) {
      const vec3 found = at({big, 0}, {0, big});
      EXPECT_TRUE(is_finite(found)) << big;
      if (!std::isnan(big)) { EXPECT_LT(glm::length(found - vec3(last[0], last[1], last[2])), 1e-6f) << big; }
    }
  }
}

TEST(MipPyramid, FilteredIsNearTheMeanOverTheFootprint) {
  SCOPED_TRACE(test::seed_note());
  const auto texels = random_texels(64, 64, 3);
  const Texture texture = picture(texels);
  const MipPyramid pyramid(texels, ColorSpace::linear);
  const TextureUse use = trilinear(ColorSpace::linear);
  // A square, a long one askew, one whose longer axis is called minor.
  for (const UvFootprint& f :
       {UvFootprint{{0.125f, 0}, {0, 0.125f}}, UvFootprint{{0.2f, 0.15f}, {-0.03f, 0.04f}},
        UvFootprint{{0.05f, 0}, {0, 0.25f}}}) {
    double filtered = 0, point = 0;
    for (int i = 0; i < 60; ++i) {
      const TexturePoint at(vec2(0.37f, 0.61f) * static_cast<float>(i), f);
      const vec4 mean = mean_of_points(texture, use, at);
      TextureUse plain = use;
      plain.filter = TextureFilter::bilinear;
      filtered +=
          static_cast<double>(length_squared(vec3(*texture_filtered(texture, use, at, &pyramid) - mean)));
      point += static_cast<double>(length_squared(texture_color(texture, plain, at.uv) - vec3(mean)));
    }
    EXPECT_LT(filtered, 0.05 * point) << f.major.x << ' ' << f.minor.y;
  }
}

TEST(MipPyramid, LongFootprintsDoNotBlurAcross) {
  // Stripes along v: a footprint ten times as long along them sees one stripe.
  std::vector<std::uint8_t> stripes(32 * 32);
  for (std::size_t i = 0; i < stripes.size(); ++i) stripes[i] = i % 4 < 2 ? 255 : 0;
  const auto texels = std::make_shared<const Texels>(Texels{32, 32, 1, std::move(stripes)});
  const MipPyramid pyramid(texels, ColorSpace::linear);
  const vec2 white(1.0f / 32, 0.5f); // in the middle of a stripe
  const auto along = texture_filtered(picture(texels), trilinear(ColorSpace::linear),
                                      {white, {{0, 8.0f / 32}, {1.0f / 32, 0}}}, &pyramid);
  EXPECT_NEAR(along->x, 1, 1e-5f);
  const auto across = texture_filtered(picture(texels), trilinear(ColorSpace::linear),
                                       {white, {{8.0f / 32, 0}, {0, 1.0f / 32}}}, &pyramid);
  EXPECT_NEAR(across->x, 0.5f, 0.05f);
}

TEST(CheckerTexture, IsIntegratedOverABox) {
  const Texture checker{"", CheckerTexture{{1, 0.5f, 0}, {0, 0.25f, 4}, 3}};
  TextureUse use = trilinear();
  use.uv.scale = {1, 0.5f};
  for (const vec2 sides : {vec2(0.1f), vec2(0.5f, 0.07f), vec2(0.9f, 3), vec2(0.3f, 20)})
    for (int i = 0; i < 20; ++i) {
      const vec2 place = vec2(0.37f, 0.71f) * static_cast<float>(i - 10);
      const TexturePoint at(place, {{sides.x, 0}, {0, sides.y}});
      const vec4 found = *texture_filtered(checker, use, at, nullptr);
      EXPECT_LT(glm::length(found - mean_of_points(checker, use, at)), 0.1f) << place.x << ' ' << sides.y;
    }
  for (float big : {1e7f, INFINITY, NAN})
    EXPECT_TRUE(is_finite(vec3(*texture_filtered(checker, use, {vec2(0), {{big, 0}, {0, big}}}, nullptr))));
  const auto even = texture_filtered(checker, use, {vec2(0.1f, 0.2f), {vec2(1e-5f, 0), vec2(0)}}, nullptr);
  EXPECT_EQ(vec3(*even), vec3(1, 0.5f, 0));
}

} // namespace
} // namespace candela
