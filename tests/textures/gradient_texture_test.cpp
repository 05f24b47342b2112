// Ramps, by hand and against their mean over many points.

#include "support/patterns.h"
#include "textures/gradient_texture.h"

namespace candela {
namespace {

using test::Random;
using enum GradientShape;

GradientTexture gradient(GradientShape shape, bool smooth = false) {
  GradientTexture t;
  t.shape = shape, t.smooth = smooth;
  return t;
}
TextureUse wrapping(TextureWrap wrap) {
  TextureUse use;
  use.wrap = wrap;
  return use;
}
constexpr TextureWrap kWraps[] = {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror};

TEST(GradientTexture, IsAPattern) {
  for (GradientShape shape : {linear, radial, angular})
    for (bool smooth : {false, true}) test::expect_pattern(gradient(shape, smooth));
}

TEST(GradientTexture, GoesAlongU) {
  const GradientTexture t = gradient(linear), s = gradient(linear, true);
  const auto repeat = wrapping(TextureWrap::repeat), clamp = wrapping(TextureWrap::clamp),
             mirror = wrapping(TextureWrap::mirror);
  for (float v : {-7.0f, 0.0f, 0.3f}) {
    EXPECT_FLOAT_EQ(t.share(repeat, {0.25f, v}), 0.25f);
    EXPECT_FLOAT_EQ(s.share(repeat, {0.25f, v}), 0.15625f); // 3/16 - 2/64
    EXPECT_FLOAT_EQ(t.share(repeat, {-0.25f, v}), 0.75f);
    EXPECT_FLOAT_EQ(t.share(repeat, {5.25f, v}), 0.25f);
    EXPECT_FLOAT_EQ(t.share(clamp, {-0.25f, v}), 0);
    EXPECT_FLOAT_EQ(t.share(clamp, {5.25f, v}), 1);
    EXPECT_FLOAT_EQ(t.share(clamp, {1, v}), 1);
    EXPECT_FLOAT_EQ(t.share(mirror, {1.25f, v}), 0.75f);
    EXPECT_FLOAT_EQ(t.share(mirror, {-0.25f, v}), 0.25f);
  }
}

TEST(GradientTexture, GoesOutwardsAndAround) {
  const auto clamp = wrapping(TextureWrap::clamp);
  EXPECT_FLOAT_EQ(gradient(radial).share(clamp, {0.5f, 0.5f}), 0);
  EXPECT_FLOAT_EQ(gradient(radial).share(clamp, {1, 0.5f}), 1);
  EXPECT_FLOAT_EQ(gradient(radial).share(clamp, {0.5f, 0.25f}), 0.5f);
  EXPECT_FLOAT_EQ(gradient(radial).share(clamp, {0.2f, 0.1f}), 1) << "3-4-5";
  EXPECT_FLOAT_EQ(gradient(radial).share(clamp, {0.35f, 0.3f}), 0.5f);
  EXPECT_FLOAT_EQ(gradient(radial).share(clamp, {3, 0.5f}), 1);
  for (TextureWrap wrap : kWraps)
    for (int i = 0; i < 8; ++i) {
      const float angle = 2 * kPi * (static_cast<float>(i) + 0.25f) / 8;
      const vec2 uv = 0.5f + 0.3f * vec2(std::cos(angle), std::sin(angle));
      EXPECT_NEAR(gradient(angular).share(wrapping(wrap), uv), (static_cast<float>(i) + 0.25f) / 8, 1e-6);
    }
}

TEST(GradientTexture, SlopesAreThoseOfTheRampAndItsEase) {
  SCOPED_TRACE(test::seed_note());
  Random random(3);
  const auto clamp = wrapping(TextureWrap::clamp);
  for (int i = 0; i < 20000; ++i) {
    const vec2 uv = 0.5f + random.in_square(3), step = random.in_square(1e-2f);
    const float length = glm::length(step) + 1e-5f;
    for (bool smooth : {false, true}) {
      const float ease = smooth ? 1.5f : 1.0f;
      auto moved = [&](GradientShape shape) {
        return std::abs(gradient(shape, smooth).share(clamp, uv + step) -
                        gradient(shape, smooth).share(clamp, uv));
      };
      EXPECT_LE(moved(linear), ease * length);
      EXPECT_LE(moved(radial), 2 * ease * length);
    }
  }
}

TEST(GradientTexture, FootprintsGiveTheMean) {
  SCOPED_TRACE(test::seed_note());
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    const vec2 uv = 0.5f + random.in_square(6);
    const vec2 sides(0.01f + 3 * random(), 0.01f + random());
    const TexturePoint at(uv, {{sides.x, 0}, {0, sides.y}});
    for (TextureWrap wrap : kWraps)
      for (bool smooth : {false, true}) {
        const GradientTexture t = gradient(linear, smooth);
        const TextureUse use = wrapping(wrap);
        EXPECT_NEAR(t.mean_share(use, at), test::sampled_share(t, use, at, 400), 4e-3) << i;
      }
    // The other shapes: the ramp is straight only where the footprint is small to the distance.
    const vec2 off = 0.5f + glm::normalize(random.in_square(1) + 1e-4f) * (0.2f + random());
    const TexturePoint small(off, {0.02f * random.in_square(2), 0.02f * random.in_square(2)});
    for (GradientShape shape : {radial, angular}) {
      const GradientTexture t = gradient(shape, true);
      const TextureUse use = wrapping(TextureWrap::repeat);
      const float point = t.share(use, off);
      const bool at_seam = point < 0.15f || point > 0.85f; // of a slanted footprint
      EXPECT_NEAR(t.mean_share(use, small), test::sampled_share(t, use, small, 60), at_seam ? 0.2f : 4e-3f);
    }
  }
  // Across an edge the mean tells how wide the footprint is on the ramp.
  for (float off : {-0.03f, -0.01f, 0.0f, 0.02f}) {
    const TexturePoint rim({1 + off, 0.5f}, {{0.1f, 0}, {0, 1e-3f}}),
        seam({0.9f, 0.5f + off}, {{0, 0.1f}, {1e-3f, 0}});
    const auto clamp = wrapping(TextureWrap::clamp);
    const float at_rim = test::sampled_share(gradient(radial), clamp, rim, 400);
    const float at_seam = test::sampled_share(gradient(angular), clamp, seam, 400);
    EXPECT_NEAR(gradient(radial).mean_share(clamp, rim), at_rim, 1e-3) << off;
    EXPECT_NEAR(gradient(angular).mean_share(clamp, seam), at_seam, 5e-3) << off;
  }
  for (GradientShape shape : {linear, radial, angular})
    for (bool smooth : {false, true})
      EXPECT_NEAR(gradient(shape, smooth).mean_share({}, {{0.7f, 0.6f}, {{1e4f, 0}, {0, 1e4f}}}), 0.5f, 1e-3);
}

} // namespace
} // namespace candela
