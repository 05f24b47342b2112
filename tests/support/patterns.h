#pragma once
// What tests ask of every pattern between two colours.

#include "core/hash.h"
#include "support/seed.h"
#include "textures/texture_kind.h"

#include <gtest/gtest.h>

namespace candela::test {

/// Uniform random numbers from a fresh seed.
class Random {
public:
  explicit Random(std::uint64_t stream) : state_(hash_combine(fresh_seed(), stream)) {}
  float operator()() {
    return to_unit_float(static_cast<std::uint32_t>(hash_combine(state_, ++count_) >> 32));
  }
  vec2 in_square(float side) {
    const float x = (*this)();
    return side * (vec2(x, (*this)()) - 0.5f);
  }
  int integer() { return static_cast<int>((*this)() * 1e9f); }

private:
  std::uint64_t state_, count_ = 0;
};

/// The share of color_b over a footprint, by n x n lookups.
template <class Kind>
float sampled_share(const Kind& kind, const TextureUse& use, const TexturePoint& at, int n) {
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const vec2 st = (vec2(i, j) + 0.5f) / static_cast<float>(n) - 0.5f;
      sum +=
          static_cast<double>(kind.share(use, at.uv + st.x * at.footprint.major + st.y * at.footprint.minor));
    }
  return static_cast<float>(sum / (n * n));
}

/// Shares are in [0, 1] and finite anywhere, a footprint of nothing is a point, colours are the mixture,
/// numbers follow the channel, and the rows hold the defaults.
template <TextureKind Kind>
void expect_pattern(Kind kind) {
  SCOPED_TRACE(seed_note());
  kind.color_a = {0.25f, 1, 0}, kind.color_b = {1, 0.5f, 4};
  Random random(1);
  TextureUse use;
  for (int i = 0; i < 2000; ++i) {
    const vec2 uv = random.in_square(i < 1000 ? 10.0f : 1e5f);
    const float t = kind.share(use, uv);
    ASSERT_GE(t, 0);
    ASSERT_LE(t, 1);
    const vec3 expected = glm::mix(kind.color_a, kind.color_b, t);
    use.channel = TextureChannel::rgb;
    EXPECT_EQ(kind.color(use, uv), expected);
    EXPECT_EQ(kind.number(use, uv), luminance(expected));
    EXPECT_EQ(kind.filtered(use, TexturePoint(uv)), vec4(expected, 1));
    use.channel = TextureChannel::blue;
    EXPECT_EQ(kind.color(use, uv), vec3(expected.z));
    EXPECT_EQ(kind.number(use, uv), expected.z);
    use.channel = TextureChannel::alpha;
    EXPECT_EQ(kind.number(use, uv), 1);
    const float size = std::exp2(20 * random() - 15);
    const TexturePoint area(uv, {size * random.in_square(2), size * random.in_square(2)});
    const float mean = kind.mean_share(use, area);
    ASSERT_GE(mean, 0);
    ASSERT_LE(mean, 1);
  }
  for (float x : {NAN, INFINITY, -INFINITY, 1e30f, -3e38f, 1e-40f})
    for (vec2 uv : {vec2(x), vec2(x, 0.5f), vec2(0.5f, x)}) {
      const float t = kind.share(use, uv);
      EXPECT_TRUE(t >= 0 && t <= 1) << x;
      for (const UvFootprint& odd : {UvFootprint{vec2(0.1f), vec2(0.1f)}, UvFootprint{vec2(x), vec2(0)},
                                     UvFootprint{vec2(1e30f), vec2(x)}})
        EXPECT_TRUE(is_finite(vec3(kind.filtered(use, {uv, odd})))) << x;
    }
  for (const auto& row : Kind::rows()) {
    EXPECT_EQ(field_problem(row, row.address(kind)), "") << row.key;
    EXPECT_TRUE(row.key != "name" && row.key != "type") << row.key << " is a key of every texture in a file";
  }
  EXPECT_TRUE(kind.cells().x > 0 && kind.cells().y > 0);
}

} // namespace candela::test
