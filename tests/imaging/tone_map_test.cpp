#include "core/color.h"
#include "imaging/tone_map.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace candela {
namespace {

constexpr ToneMap kAll[] = {ToneMap::reinhard, ToneMap::reinhard_simple, ToneMap::filmic, ToneMap::aces,
                            ToneMap::srgb};

/// IEC 61966-2-1 in double, rounded to the nearest code.
int reference_code(float x) {
  double v = std::clamp(static_cast<double>(x), 0.0, 1.0);
  double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<int>(std::floor(255 * s + 0.5));
}

DisplaySettings display_of(ToneMap kind, float exposure = 0, float white = 4) {
  DisplaySettings d;
  d.tone_map = kind;
  d.exposure = exposure;
  d.white_point = white;
  d.dither = false;
  return d;
}

TEST(ToneMapSrgb, AgreesWithTheFormulaAtEveryChangeOfTheCode) {
  for (int code = 1; code <= 255; ++code) {
    double s = (code - 0.5) / 255;
    float x = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    // The floats around the change, which is between two of them.
    float at = x;
    for (int i = 0; i < 4; ++i) at = std::nextafter(at, 0.0f);
    bool seen[2] = {false, false};
    for (int i = 0; i < 9; ++i, at = std::nextafter(at, 2.0f)) {
      ASSERT_EQ(srgb8_from_linear(at), reference_code(at)) << "code " << code << ", " << at;
      seen[srgb8_from_linear(at) == code] = true;
    }
    EXPECT_TRUE(seen[0] && seen[1]) << "the change to code " << code << " was not met";
  }
}

TEST(ToneMapSrgb, AgreesWithTheFormulaAndIsMonotonicOnDenseSamples) {
  int last = 0;
  std::uint32_t end = std::bit_cast<std::uint32_t>(1.25f);
  for (std::uint32_t bits = 0; bits < end; bits += 1009) { // prime: every low half is met
    float x = std::bit_cast<float>(bits);
    int code = srgb8_from_linear(x);
    ASSERT_EQ(code, reference_code(x)) << x;
    ASSERT_GE(code, last) << x;
    last = code;
  }
  EXPECT_EQ(last, 255);
}

TEST(ToneMapSrgb, EveryCodeSurvivesItsDecoding) {
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(srgb8_from_linear(linear_from_srgb(static_cast<float>(code) / 255.0f)), code);
}

TEST(ToneMapSrgb, ValuesOutsideAreClipped) {
  EXPECT_EQ(srgb8_from_linear(-1), 0);
  EXPECT_EQ(srgb8_from_linear(-kInfinity), 0);
  EXPECT_EQ(srgb8_from_linear(std::nanf("")), 0);
  EXPECT_EQ(srgb8_from_linear(1), 255);
  EXPECT_EQ(srgb8_from_linear(3e38f), 255);
  EXPECT_EQ(srgb8_from_linear(kInfinity), 255);
}

TEST(ToneMap, ReinhardMapsTheWhitePointToOne) {
  for (float white : {0.01f, 0.5f, 1.0f, 4.0f, 100.0f, 1e6f}) {
    vec3 mapped = tone_mapped(vec3(white), display_of(ToneMap::reinhard, 0, white));
    // The luminance's weights sum to 1 within a rounding error.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mapped[c], 1, 1e-5f) << white;
  }
}

TEST(ToneMap, ReinhardHasItsClosedFormAndKeepsTheColour) {
  vec3 color(0.2f, 1.5f, 3.0f);
  float white = 2.5f, l = luminance(color);
  float expected = l * (1 + l / (white * white)) / (1 + l);
  vec3 mapped = tone_mapped(color, display_of(ToneMap::reinhard, 0, white));
  EXPECT_NEAR(luminance(mapped), expected, 1e-6f);
  EXPECT_NEAR(mapped.y / mapped.x, color.y / color.x, 1e-5f);
  EXPECT_NEAR(mapped.z / mapped.x, color.z / color.x, 1e-5f);
  // A white point far away leaves L / (1 + L).
  mapped = tone_mapped(vec3(1), display_of(ToneMap::reinhard, 0, 1e6f));
  EXPECT_NEAR(mapped.x, 0.5f, 1e-6f);
}

TEST(ToneMap, SimpleReinhardHasNoWhitePoint) {
  const vec3 color(0.2f, 1.5f, 3.0f);
  const float l = luminance(color);
  for (float white : {0.5f, 4.0f}) {
    const vec3 mapped = tone_mapped(color, display_of(ToneMap::reinhard_simple, 0, white));
    EXPECT_NEAR(luminance(mapped), l / (1 + l), 1e-6f);
    EXPECT_NEAR(mapped.y / mapped.x, color.y / color.x, 1e-5f);
  }
  EXPECT_NEAR(tone_mapped(vec3(1), display_of(ToneMap::reinhard_simple)).y, 0.5f, 1e-6f);
}

TEST(ToneMap, AcesIsHillsFit) {
  // On greys the matrices do nothing (their rows sum to 1): the curve alone remains.
  auto curve = [](double x) {
    return (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
  };
  for (float x : {0.0f, 0.01f, 0.18f, 1.0f, 16.0f}) {
    const vec3 mapped = tone_mapped(vec3(x), display_of(ToneMap::aces));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(mapped[c]), curve(static_cast<double>(x)), 3e-5) << x;
  }
  EXPECT_NEAR(tone_mapped(vec3(0.18f), display_of(ToneMap::aces)).y, 0.1056f, 1e-4f);
  // A red that is far too bright loses its saturation.
  const vec3 dim = tone_mapped({0.1f, 0, 0}, display_of(ToneMap::aces));
  const vec3 bright = tone_mapped({100, 0, 0}, display_of(ToneMap::aces));
  EXPECT_LT(dim.y, 0.05f * dim.x);
  EXPECT_GT(bright.y, 0.3f * bright.x);
}

TEST(ToneMap, TheWhiteLevelIsTheFirstThatIsWhite) {
  for (ToneMap kind : kAll)
    for (float stops : {0.0f, 3.0f, -2.5f}) {
      const DisplaySettings display = display_of(kind, stops);
      const float white = white_level(display);
      ASSERT_TRUE(white > 0);
      if (white == kInfinity) continue;
      EXPECT_EQ(srgb8_from_linear(tone_mapped(vec3(1.001f * white), display).y), 255);
      EXPECT_LT(srgb8_from_linear(tone_mapped(vec3(0.999f * white), display).y), 255);
    }
  // 254.5 / 255 encoded is 0.9955 linear.
  EXPECT_NEAR(white_level(display_of(ToneMap::srgb)), 0.9955f, 1e-3f);
}

TEST(ToneMap, FilmicIsHablesCurve) {
  // ((x (0.15 x + 0.05) + 0.004) / (x (0.15 x + 0.5) + 0.06) - 1/15) at twice the value, over that at 11.2.
  auto curve = [](double x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 1.0 / 15;
  };
  for (float x : {0.0f, 0.01f, 0.18f, 1.0f, 3.0f, 20.0f}) {
    vec3 mapped = tone_mapped(vec3(x, 0, 0), display_of(ToneMap::filmic));
    EXPECT_NEAR(static_cast<double>(mapped.x), curve(2 * static_cast<double>(x)) / curve(11.2), 2e-6) << x;
    EXPECT_NEAR(mapped.y, 0, 1e-7f);
  }
  EXPECT_NEAR(tone_mapped(vec3(5.6f), display_of(ToneMap::filmic)).x, 1, 1e-6f);
}

TEST(ToneMap, SrgbLeavesLinearValues) {
  vec3 color(0.1f, 0.7f, 12);
  EXPECT_EQ(tone_mapped(color, display_of(ToneMap::srgb)), color);
}

TEST(ToneMap, ExposureMultipliesByPowersOfTwo) {
  vec3 color(0.1f, 0.3f, 0.05f);
  for (ToneMap kind : kAll)
    for (float stops : {-3.0f, 1.0f, 4.0f})
      EXPECT_EQ(tone_mapped(color, display_of(kind, stops)),
                tone_mapped(color * std::exp2(stops), display_of(kind)));
}

TEST(ToneMap, EveryCurveRises) {
  for (ToneMap kind : kAll)
    for (float white : {0.5f, 4.0f, 1000.0f}) {
      float last = -1;
      for (float x = 0; x < 1e5f; x = x * 1.01f + 1e-4f) {
        float mapped = tone_mapped(vec3(x), display_of(kind, 0, white)).y;
        // Where the curve is nearly flat, rounding may take back a few units in the last place.
        ASSERT_GE(mapped, last * (1 - 1e-6f)) << x;
        last = mapped;
      }
    }
}

TEST(ToneMap, NonFiniteAndExtremeValuesAreBlackOrWhite) {
  for (ToneMap kind : kAll)
    for (float white : {0.01f, 4.0f, 1e6f})
      for (float stops : {-20.0f, 0.0f, 20.0f}) {
        DisplaySettings display = display_of(kind, stops, white);
        std::vector<vec3> in = {vec3(std::nanf("")), vec3(kInfinity), vec3(-kInfinity),
                                vec3(3e38f),         vec3(-5),        vec3(0)};
        if (kind != ToneMap::aces) // which mixes the channels
          in.emplace_back(std::nanf(""), kInfinity, -1);
        std::vector<std::uint8_t> out(3 * in.size());
        tone_map_rgb8(in, {1}, display, out);
        std::vector<std::uint8_t> expected = {0,   0, 0, 255, 255, 255, 0, 0, 0,   255, 255,
                                              255, 0, 0, 0,   0,   0,   0, 0, 255, 0};
        expected.resize(out.size());
        EXPECT_EQ(out, expected) << static_cast<int>(kind) << ' ' << white << ' ' << stops;
      }
}

TEST(ToneMap, PicturesAreMappedPixelByPixel) {
  std::mt19937 random(3);
  std::exponential_distribution<float> value(1);
  for (std::size_t count : {0u, 1u, 2u, 255u, 256u, 257u, 1000u}) { // around the size of a block
    std::vector<vec3> in(count);
    for (vec3& pixel : in)
      for (int c = 0; c < 3; ++c) pixel[c] = value(random);
    for (ToneMap kind : kAll) {
      DisplaySettings display = display_of(kind, 0.5f, 3);
      std::vector<std::uint8_t> rgb(3 * count), rgba(4 * count);
      tone_map_rgb8(in, {100}, display, rgb);
      tone_map_rgba8(in, {100}, display, rgba);
      for (std::size_t i = 0; i < count; ++i) {
        vec3 mapped = tone_mapped(in[i], display);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(rgb[3 * i + c], srgb8_from_linear(mapped[static_cast<int>(c)]));
          ASSERT_EQ(rgba[4 * i + c], rgb[3 * i + c]);
        }
        ASSERT_EQ(rgba[4 * i + 3], 255);
      }
    }
  }
}

} // namespace
} // namespace candela
