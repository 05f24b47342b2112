// The dither of 8-bit pictures: no bands, the mean kept, the same bits every time.

#include "core/color.h"
#include "imaging/display_transform.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace candela::test {
namespace {

DisplaySettings plain(bool dither) {
  DisplaySettings display;
  display.tone_map = ToneMap::srgb;
  display.dither = dither;
  return display;
}

std::vector<std::uint8_t> mapped(const std::vector<vec3>& linear, int width, bool dither,
                                 ivec2 origin = ivec2(0)) {
  std::vector<std::uint8_t> rgb(3 * linear.size());
  tone_map_rgb8(linear, {width, origin}, plain(dither), rgb);
  return rgb;
}

/// In codes, 0 to 255.
double encoded(float x) {
  const double v = static_cast<double>(x);
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

float decoded(double code) { return linear_from_srgb(static_cast<float>(code / 255)); }

TEST(Dither, TheMeanOfAFlatPatchIsItsValue) {
  constexpr int kSide = 64;
  for (double code : {0.05, 0.4, 1.25, 7.5, 19.99, 100.3, 127.5, 201.01, 254.6}) {
    const float value = decoded(code);
    const auto rgb = mapped(std::vector<vec3>(kSide * kSide, vec3(value)), kSide, true);
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3) sum += rgb[i];
    // The lattice is more even than random numbers, whose standard deviation is at most 0.5 / 64.
    EXPECT_NEAR(sum / (kSide * kSide), encoded(value), 0.005) << code;
  }
}

TEST(Dither, SmallPatchesKeepTheMean) {
  // Any 8 x 8 pixels: a band of that size is invisible. A random dither would give 0.5 / 8.
  constexpr int kWidth = 200, kHeight = 100;
  const float value = decoded(10.5);
  const auto rgb = mapped(std::vector<vec3>(kWidth * kHeight, vec3(value)), kWidth, true);
  for (int y0 = 0; y0 + 8 <= kHeight; y0 += 3)
    for (int x0 = 0; x0 + 8 <= kWidth; x0 += 3) {
      double sum = 0;
      for (int y = y0; y < y0 + 8; ++y)
        for (int x = x0; x < x0 + 8; ++x) sum += rgb[3 * static_cast<std::size_t>(y * kWidth + x)];
      ASSERT_NEAR(sum / 64, encoded(value), 0.06) << x0 << ' ' << y0;
    }
}

TEST(Dither, AGradientHasNoBands) {
  // A dark ramp of 6 codes over 600 pixels: with rounding, a hundred columns are equal.
  constexpr int kWidth = 600, kHeight = 64;
  std::vector<vec3> linear;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) linear.emplace_back(decoded(4 + 6.0 * x / kWidth));
  auto longest_run = [&](const std::vector<std::uint8_t>& rgb) {
    int longest = 0, run = 0;
    for (int x = 1; x < kWidth; ++x) {
      bool equal = true;
      for (int y = 0; y < kHeight; ++y) {
        const auto i = 3 * static_cast<std::size_t>(y * kWidth + x);
        equal = equal && rgb[i] == rgb[i - 3];
      }
      run = equal ? run + 1 : 0;
      longest = std::max(longest, run);
    }
    return longest;
  };
  EXPECT_GT(longest_run(mapped(linear, kWidth, false)), 90);
  EXPECT_LE(longest_run(mapped(linear, kWidth, true)), 2) << "where the ramp passes a code";
  // The mean of a column does not jump: it rises like the ramp, by 0.01 per column. The lattice distributes
  // nearly all of 64 values correctly; rounding has errors of half a code.
  const auto rgb = mapped(linear, kWidth, true);
  for (int x = 0; x < kWidth; ++x) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y) sum += rgb[3 * static_cast<std::size_t>(y * kWidth + x)];
    ASSERT_NEAR(sum / kHeight, 4 + 6.0 * x / kWidth, 4.0 / kHeight) << x;
  }
}

TEST(Dither, CodesThemselvesStay) {
  for (int code = 0; code < 256; ++code) {
    const auto rgb = mapped(std::vector<vec3>(64 * 64, vec3(decoded(code))), 64, true);
    ASSERT_TRUE(std::ranges::all_of(rgb, [&](int c) { return c == code; })) << code;
  }
  for (float black : {0.0f, -1.0f, std::nanf(""), 1e-9f, -kInfinity})
    for (int c : mapped(std::vector<vec3>(64 * 64, vec3(black)), 64, true)) ASSERT_EQ(c, 0) << black;
  for (float white : {1.0f, 1.5f, 1e30f, kInfinity})
    for (int c : mapped(std::vector<vec3>(64 * 64, vec3(white)), 64, true)) ASSERT_EQ(c, 255) << white;
}

TEST(DitherStatistical, IsAtMostOneFromTheRoundedCodeAndNeverFromTheWrongSide) {
  std::mt19937_64 random(fresh_seed());
  std::uniform_real_distribution<float> stops(-22, 1);
  std::vector<vec3> linear(1 << 16);
  for (vec3& pixel : linear)
    for (int c = 0; c < 3; ++c) pixel[c] = std::exp2(stops(random));
  const auto rounded = mapped(linear, 256, false), dithered = mapped(linear, 256, true);
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    ASSERT_LE(std::abs(rounded[i] - dithered[i]), 1) << seed_note();
    const double exact = std::min(encoded(linear[i / 3][static_cast<int>(i % 3)]), 255.0);
    ASSERT_LT(std::abs(dithered[i] - exact), 1.0) << seed_note();
  }
}

TEST(Dither, GreysStayGrey) {
  std::vector<vec3> linear;
  for (int i = 0; i < 5000; ++i) linear.emplace_back(static_cast<float>(i) * 2e-4f);
  const auto rgb = mapped(linear, 50, true);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    ASSERT_EQ(rgb[i], rgb[i + 1]);
    ASSERT_EQ(rgb[i], rgb[i + 2]);
  }
}

TEST(Dither, DependsOnThePlaceAlone) {
  // Independent of the blocks in which a picture is processed: sizes around theirs, and parts of a picture.
  constexpr int kWidth = 700, kHeight = 9;
  const std::vector<vec3> linear(kWidth * kHeight, vec3(decoded(30.37)));
  const auto whole = mapped(linear, kWidth, true);
  EXPECT_EQ(whole, mapped(linear, kWidth, true));
  for (const glm::ivec4 part :
       {glm::ivec4(0, 0, 1, 9), glm::ivec4(13, 2, 255, 5), glm::ivec4(300, 1, 256, 3),
        glm::ivec4(5, 0, 257, 2), glm::ivec4(699, 8, 1, 1), glm::ivec4(1, 3, 600, 6)}) {
    const std::vector<vec3> some(static_cast<std::size_t>(part.z * part.w), linear[0]);
    const auto rgb = mapped(some, part.z, true, {part.x, part.y});
    for (int y = 0; y < part.w; ++y)
      for (int x = 0; x < part.z; ++x)
        ASSERT_EQ(rgb[3 * static_cast<std::size_t>(y * part.z + x)],
                  whole[3 * static_cast<std::size_t>((part.y + y) * kWidth + part.x + x)])
            << part.x << ' ' << x << ' ' << y;
  }
}

TEST(Dither, WindowAndFilesAreTheSame) {
  std::vector<vec3> linear;
  for (int i = 0; i < 777; ++i) linear.emplace_back(static_cast<float>(i) * 1e-3f, 0.2f, 0.01f);
  std::vector<std::uint8_t> rgb(3 * linear.size()), rgba(4 * linear.size());
  for (ToneMap kind : {ToneMap::reinhard, ToneMap::filmic, ToneMap::aces, ToneMap::srgb}) {
    DisplaySettings display = plain(true);
    display.tone_map = kind;
    tone_map_rgb8(linear, {37}, display, rgb);
    tone_map_rgba8(linear, {37}, display, rgba);
    for (std::size_t i = 0; i < linear.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(rgba[4 * i + c], rgb[3 * i + c]);
      ASSERT_EQ(rgba[4 * i + 3], 255);
    }
  }
}

TEST(Dither, OnlyWhatIsSeenNotWhatIsRead) {
  // Colours that represent numbers are exact; radiance is dithered unless disabled.
  const std::vector<vec3> linear(64 * 64, vec3(decoded(30.5)));
  auto varies = [&](const DisplaySettings& display, View view) {
    std::vector<std::uint8_t> rgb(3 * linear.size());
    display_rgb8(linear, {64}, display_transform(linear, 64, 64, display, view, 1), rgb);
    for (std::size_t i = 3; i < rgb.size(); ++i)
      if (rgb[i] != rgb[i % 3]) return true;
    return false;
  };
  for (int view = 0; view <= static_cast<int>(View::nonfinite); ++view)
    for (FalseColor colors : {FalseColor::automatic, FalseColor::off}) {
      DisplaySettings display;
      display.false_color = colors;
      EXPECT_EQ(varies(display, View{view}), View{view} == View::radiance) << view;
      display.dither = false;
      EXPECT_FALSE(varies(display, View{view})) << view;
    }
  DisplaySettings display;
  std::vector<std::uint8_t> rgb(3 * linear.size());
  display.false_color = FalseColor::viridis;
  display_rgb8(linear, {64}, display_transform(linear, 64, 64, display, View::radiance, 1), rgb);
  for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_EQ(rgb[i], rgb[i % 3]) << "the legend's colours";
}

} // namespace
} // namespace candela::test
