// Each number of a sampler is uniform, and numbers with different keys are independent; with pixels as
// trials.

#include "sampler_draws.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <functional>
#include <string_view>

namespace candela::test {
namespace {

constexpr std::uint32_t kSide = 512; // pixels

/// Chi-square of pairs of numbers over all pixels, or as many that are independent.
template <class Pair>
double pair_p_value(SamplerType type, Pair pair) {
  constexpr std::size_t kCells = 16;
  std::vector<double> observed(kCells * kCells),
      expected(kCells * kCells, double(kSide) * kSide / (kCells * kCells));
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      vec2 p = pair(independent_pixel(type, x, y));
      observed[static_cast<std::size_t>(p.y * kCells) * kCells + static_cast<std::size_t>(p.x * kCells)] += 1;
    }
  }
  return chi_square_test(observed, expected).p_value;
}

TEST(SamplerStatistical, EachSampleIsUniform) {
  SCOPED_TRACE(seed_note());
  const std::uint32_t samples[] = {0, 1, 2, 3, 17, 255, 256, 65537};
  int tests = kSamplerTypeCount * static_cast<int>(std::size(samples)) * static_cast<int>(kDimensions);
  for (SamplerType type : kSamplerTypes) {
    Sampler sampler(type, fresh_seed(), 3);
    for (std::uint32_t sample : samples) {
      for (std::uint32_t d = 0; d < kDimensions; ++d) {
        double p = pair_p_value(type, [&](uvec2 pixel) {
          return draw(sampler, {pixel, sample, 1, dimension(d), d % 2});
        });
        EXPECT_GT(p, sidak_threshold(tests)) << static_cast<int>(type) << ' ' << sample << ' ' << d;
      }
    }
  }
}

TEST(SamplerStatistical, OneDimensionalDrawsAreUniform) {
  SCOPED_TRACE(seed_note());
  for (SamplerType type : kSamplerTypes) {
    Sampler sampler(type, fresh_seed() + 1, 3);
    std::vector<double> observed(256), expected(256, double(kSide) * kSide / 256);
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      sampler.start(independent_pixel(type, i % kSide, i / kSide), 11);
      observed[static_cast<std::size_t>(sampler.get_1d(Dimension::opacity) * 256)] += 1;
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(kSamplerTypeCount))
        << static_cast<int>(type);
  }
}

/// Pairs of numbers whose keys differ in one thing are independent, each component with each.
TEST(SamplerStatistical, KeysAreNotCorrelated) {
  SCOPED_TRACE(seed_note());
  struct Pairing {
    const char* name;
    std::function<Key(Key)> other;
  };
  const Pairing pairings[] = {
      {"dimension", [](Key k) { return k.dimension = Dimension::bsdf_direction, k; }},
      {"next dimension", [](Key k) { return k.dimension = Dimension::bsdf_lobe, k; }},
      {"bounce", [](Key k) { return k.bounce += 1, k; }},
      {"far bounce", [](Key k) { return k.bounce += 8, k; }},
      {"index", [](Key k) { return k.index += 1, k; }},
      {"pixel in x", [](Key k) { return k.pixel.x += 1, k; }},
      {"pixel in y", [](Key k) { return k.pixel.y += 1, k; }},
      {"pixel transposed",
       [](Key k) {
         return Key{{k.pixel.y + 1, k.pixel.x + kSide}, k.sample, k.bounce, k.dimension, 0};
       }},
      {"far sample", [](Key k) { return k.sample += 4096 * 7 * 9, k; }},
  };
  int tests = kSamplerTypeCount * 4 * static_cast<int>(std::size(pairings));
  for (SamplerType type : kSamplerTypes) {
    Sampler sampler(type, fresh_seed() + 2, 3);
    for (const Pairing& pairing : pairings) {
      // Samples 4096 * 63 apart share no block of the stratified sampler; those of a sequence are never
      // independent. Neighbours of blue_noise fill each other's gaps.
      std::string_view name = pairing.name;
      if (name == "far sample" && type != SamplerType::independent && type != SamplerType::stratified)
        continue;
      if (type == SamplerType::blue_noise && (name == "pixel in x" || name == "pixel in y")) continue;
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
          double p = pair_p_value(type, [&](uvec2 pixel) {
            Key key{pixel, 5, 2, Dimension::light_position, 0};
            vec2 first = draw(sampler, key);
            return vec2(first[a], draw(sampler, pairing.other(key))[b]);
          });
          EXPECT_GT(p, sidak_threshold(tests))
              << static_cast<int>(type) << ' ' << pairing.name << ' ' << a << b;
        }
      }
    }
  }
}

TEST(SamplerStatistical, SeedsAreNotCorrelated) {
  SCOPED_TRACE(seed_note());
  for (SamplerType type : kSamplerTypes) {
    Sampler a(type, fresh_seed() & ~1ull, 3), b(type, fresh_seed() | 1ull, 3);
    double p = pair_p_value(type, [&](uvec2 pixel) {
      Key key{pixel, 5, 2, Dimension::light_position, 0};
      return vec2(draw(a, key).x, draw(b, key).x);
    });
    EXPECT_GT(p, sidak_threshold(kSamplerTypeCount)) << static_cast<int>(type);
  }
}

} // namespace
} // namespace candela::test
