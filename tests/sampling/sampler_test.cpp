#include "sampling/sampler.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>
#include <set>

namespace candela::test {
namespace {

constexpr SamplerType kTypes[] = {SamplerType::independent, SamplerType::stratified, SamplerType::sobol};
constexpr auto kDimensions = static_cast<std::uint32_t>(Dimension::count);
Dimension dimension(std::uint32_t i) { return static_cast<Dimension>(i); }

/// All that one number depends on.
struct Key {
  uvec2 pixel;
  std::uint32_t sample, bounce;
  Dimension dimension;
  std::uint32_t index;
};

vec2 draw(Sampler& sampler, const Key& k) {
  sampler.start(k.pixel, k.sample);
  sampler.set_bounce(k.bounce);
  return sampler.get_2d(k.dimension, k.index);
}

TEST(Sampler, ANumberDependsOnItsKeyAlone) {
  for (SamplerType type : kTypes) {
    std::vector<Key> keys;
    for (std::uint32_t i = 0; i < 500; ++i)
      keys.push_back({{hash32(i) & 4095, hash32(i + 7777) & 4095},
                      hash32(i * 3) >> (i % 32),
                      i % 9,
                      dimension(i % kDimensions),
                      i % 5});
    std::vector<vec2> forwards;
    std::vector<float> forwards_1d;
    Sampler first(type, 42, 5);
    for (const Key& k : keys) {
      forwards.push_back(draw(first, k));
      forwards_1d.push_back(first.get_1d(k.dimension, k.index));
    }
    // In another order, by another object that has done other things, and twice.
    Sampler second(type, 42, 5);
    for (std::size_t i = keys.size(); i-- > 0;) {
      second.start({9, 9}, 3);
      second.set_bounce(2);
      draw(second, keys[i]);
      ASSERT_EQ(draw(second, keys[i]), forwards[i]) << static_cast<int>(type) << ' ' << i;
      ASSERT_EQ(second.get_1d(keys[i].dimension, keys[i].index), forwards_1d[i]);
    }
  }
}

TEST(Sampler, StartGoesToBounceZero) {
  for (SamplerType type : kTypes) {
    Sampler a(type, 1), b(type, 1);
    a.start({3, 4}, 5);
    b.start({1, 1}, 1);
    b.set_bounce(6);
    b.start({3, 4}, 5);
    EXPECT_EQ(a.get_2d(Dimension::lens), b.get_2d(Dimension::lens));
    b.set_bounce(0);
    EXPECT_EQ(a.get_2d(Dimension::lens), b.get_2d(Dimension::lens));
  }
}

TEST(Sampler, EveryPartOfTheKeyCounts) {
  for (SamplerType type : kTypes) {
    Sampler a(type, 1), b(type, 2), far(type, 1ull << 40 | 1);
    const Key base{{10, 20}, 6, 1, Dimension::light_position, 0};
    std::vector<vec2> values = {draw(a, base), draw(b, base), draw(far, base)};
    for (Key k : {Key{{11, 20}, 6, 1, Dimension::light_position, 0},
                  Key{{10, 21}, 6, 1, Dimension::light_position, 0},
                  Key{{20, 10}, 6, 1, Dimension::light_position, 0},
                  Key{{10, 20}, 7, 1, Dimension::light_position, 0},
                  Key{{10, 20}, 6, 2, Dimension::light_position, 0},
                  Key{{10, 20}, 6, 1, Dimension::bsdf_direction, 0},
                  Key{{10, 20}, 6, 1, Dimension::light_position, 1},
                  Key{{10, 20}, 6, 1, Dimension::light_position, 2}})
      values.push_back(draw(a, k));
    std::set<std::pair<float, float>> different;
    for (vec2 v : values) different.insert({v.x, v.y});
    EXPECT_EQ(different.size(), values.size()) << static_cast<int>(type);
  }
}

TEST(Sampler, ValuesAreBelowOne) {
  for (SamplerType type : kTypes) {
    for (int strata : {1, 3, 16, 65535}) {
      Sampler sampler(type, 7, strata);
      for (std::uint32_t i = 0; i < 100000; ++i) {
        sampler.start({i & 1023, i >> 10}, hash32(i));
        vec2 p = sampler.get_2d(Dimension::film);
        float x = sampler.get_1d(Dimension::russian_roulette);
        ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1 && x >= 0 && x < 1);
      }
    }
  }
}

TEST(Sampler, LaineKarrasIsANestedScramble) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    std::uint32_t x = hash32(i), seed = hash32(i + 99999);
    for (int bit = 0; bit < 32; ++bit) {
      std::uint32_t changed = laine_karras(x, seed) ^ laine_karras(x ^ (1u << bit), seed);
      // No lower bit sees it, and the bit itself does: this makes it a permutation, too.
      ASSERT_EQ(std::countr_zero(changed), bit);
    }
  }
}

TEST(Sampler, SecondSobolDimensionIsPascalsTriangle) {
  // Column k of the generator matrix has bit j, counted from the top of the value, where C(k, j) is odd.
  for (std::uint32_t k = 0; k < 32; ++k) {
    std::uint64_t row = 1; // row k of Pascal's triangle mod 2, bit j for C(k, j)
    for (std::uint32_t i = 0; i < k; ++i) row ^= row << 1;
    ASSERT_EQ(sobol_second_reversed(1u << k), static_cast<std::uint32_t>(row)) << k;
  }
  for (std::uint32_t i = 0; i < 1000; ++i)
    ASSERT_EQ(sobol_second_reversed(hash32(i) ^ hash32(i + 1)),
              sobol_second_reversed(hash32(i)) ^ sobol_second_reversed(hash32(i + 1)));
  EXPECT_EQ(reverse_bits(0x00000001u), 0x80000000u);
  EXPECT_EQ(reverse_bits(0x12345678u), 0x1e6a2c48u);
}

/// Whether the 2^m points have one in each elementary interval of size 2^-m, of every shape.
bool is_net(const std::vector<vec2>& points, int m) {
  for (int x_bits = 0; x_bits <= m; ++x_bits) {
    std::vector<bool> taken(points.size());
    for (vec2 p : points) {
      auto x = static_cast<std::size_t>(std::ldexp(p.x, x_bits)),
           y = static_cast<std::size_t>(std::ldexp(p.y, m - x_bits));
      std::size_t interval = (x << (m - x_bits)) | y;
      if (taken[interval]) return false;
      taken[interval] = true;
    }
  }
  return true;
}

TEST(Sampler, SobolRunsAreNetsInEveryPixelAndDimension) {
  for (std::uint32_t pixel = 0; pixel < 12; ++pixel) {
    Sampler sampler(SamplerType::sobol, pixel / 4);
    for (std::uint32_t d = 0; d < kDimensions; ++d) {
      for (std::uint32_t index : {0u, 3u}) {
        for (int m = 0; m <= 9; ++m) {
          for (std::uint32_t run : {0u, 1u, 2u, 1000u}) {
            std::vector<vec2> points;
            for (std::uint32_t i = 0; i < (1u << m); ++i)
              points.push_back(draw(sampler, {{pixel, 5}, (run << m) + i, pixel % 3, dimension(d), index}));
            ASSERT_TRUE(is_net(points, m)) << pixel << ' ' << d << ' ' << m << ' ' << run;
          }
        }
      }
    }
  }
}

TEST(Sampler, TheNetTestSeesABrokenNet) {
  Sampler sampler(SamplerType::sobol, 1);
  std::vector<vec2> points;
  for (std::uint32_t i = 0; i < 256; ++i) points.push_back(draw(sampler, {{0, 0}, i, 0, Dimension::film, 0}));
  ASSERT_TRUE(is_net(points, 8));
  std::swap(points[3].x, points[4].x);
  EXPECT_FALSE(is_net(points, 8));
}

TEST(Sampler, StratifiedBlocksFillEveryCellOnce) {
  for (std::uint32_t strata : {1u, 2u, 3u, 4u, 5u, 8u, 13u}) {
    std::uint32_t cells = strata * strata;
    Sampler sampler(SamplerType::stratified, 3, static_cast<int>(strata));
    std::set<std::vector<std::uint32_t>> orders;
    for (std::uint32_t block = 0; block < 20; ++block) {
      std::vector<std::uint32_t> order;
      std::vector<float> line;
      for (std::uint32_t i = 0; i < cells; ++i) {
        vec2 p =
            draw(sampler,
                 {{block / 4, 7}, block * cells + i, block % 2, dimension(block % kDimensions), block % 3});
        line.push_back(sampler.get_1d(Dimension::russian_roulette));
        // Half a step of the 24-bit grid: a cell's first values may be rounded down to below its edge.
        auto cell = [&](float x) { return static_cast<std::uint32_t>((double(x) + 0x1p-25) * strata); };
        order.push_back(cell(p.y) * strata + cell(p.x));
      }
      orders.insert(order);
      std::ranges::sort(order);
      for (std::uint32_t i = 0; i < cells; ++i) ASSERT_EQ(order[i], i) << strata << ' ' << block;
      std::ranges::sort(line);
      for (std::uint32_t i = 0; i < cells; ++i) {
        ASSERT_GE(double(line[i]), double(i) / cells - 0x1p-24);
        ASSERT_LT(double(line[i]), double(i + 1) / cells);
      }
    }
    if (strata > 3) { EXPECT_EQ(orders.size(), 20u); } // each block has an order of its own
  }
}

TEST(Sampler, PermuteIsAPermutation) {
  for (std::uint32_t length = 1; length <= 300; ++length) {
    for (std::uint64_t key = 0; key < 5; ++key) {
      std::vector<bool> taken(length);
      for (std::uint32_t i = 0; i < length; ++i) {
        std::uint32_t p = permute(i, length, hash64(key + length));
        ASSERT_LT(p, length);
        ASSERT_FALSE(taken[p]);
        taken[p] = true;
      }
    }
  }
}

// From here on: chance, with the pixels as independent trials.

constexpr std::uint32_t kSide = 512; // pixels

/// Chi-square of pairs of numbers over all pixels.
template <class Pair>
double pair_p_value(Pair pair) {
  constexpr std::size_t kCells = 16;
  std::vector<double> observed(kCells * kCells),
      expected(kCells * kCells, double(kSide) * kSide / (kCells * kCells));
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      vec2 p = pair(uvec2(x, y));
      observed[static_cast<std::size_t>(p.y * kCells) * kCells + static_cast<std::size_t>(p.x * kCells)] += 1;
    }
  }
  return chi_square_test(observed, expected).p_value;
}

TEST(SamplerStatistical, EachSampleIsUniform) {
  SCOPED_TRACE(seed_note());
  const std::uint32_t samples[] = {0, 1, 2, 3, 17, 255, 256, 65537};
  int tests = 3 * static_cast<int>(std::size(samples)) * static_cast<int>(kDimensions);
  for (SamplerType type : kTypes) {
    Sampler sampler(type, fresh_seed(), 3);
    for (std::uint32_t sample : samples) {
      for (std::uint32_t d = 0; d < kDimensions; ++d) {
        double p = pair_p_value([&](uvec2 pixel) {
          return draw(sampler, {pixel, sample, 1, dimension(d), d % 2});
        });
        EXPECT_GT(p, sidak_threshold(tests)) << static_cast<int>(type) << ' ' << sample << ' ' << d;
      }
    }
  }
}

TEST(SamplerStatistical, OneDimensionalDrawsAreUniform) {
  SCOPED_TRACE(seed_note());
  for (SamplerType type : kTypes) {
    Sampler sampler(type, fresh_seed() + 1, 3);
    std::vector<double> observed(256), expected(256, double(kSide) * kSide / 256);
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      sampler.start({i % kSide, i / kSide}, 11);
      observed[static_cast<std::size_t>(sampler.get_1d(Dimension::opacity) * 256)] += 1;
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(3)) << static_cast<int>(type);
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
  int tests = 3 * 4 * static_cast<int>(std::size(pairings));
  for (SamplerType type : kTypes) {
    Sampler sampler(type, fresh_seed() + 2, 3);
    for (const Pairing& pairing : pairings) {
      // Samples 4096 * 63 apart share no run of the Sobol' sampler, and no block of the stratified one.
      if (type == SamplerType::sobol && std::string(pairing.name) == "far sample") continue;
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
          double p = pair_p_value([&](uvec2 pixel) {
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
  for (SamplerType type : kTypes) {
    Sampler a(type, fresh_seed() & ~1ull, 3), b(type, fresh_seed() | 1ull, 3);
    double p = pair_p_value([&](uvec2 pixel) {
      Key key{pixel, 5, 2, Dimension::light_position, 0};
      return vec2(draw(a, key).x, draw(b, key).x);
    });
    EXPECT_GT(p, sidak_threshold(3)) << static_cast<int>(type);
  }
}

/// A shuffle worth the name makes any order equally likely; of few elements all orders can be counted.
TEST(SamplerStatistical, PermuteIsFair) {
  SCOPED_TRACE(seed_note());
  constexpr int kDraws = 240000;
  std::vector<double> observed(256), expected(256);
  for (int i = 0; i < kDraws; ++i) {
    std::uint64_t key = hash_combine(fresh_seed(), static_cast<std::uint64_t>(i));
    std::size_t order = 0;
    for (std::uint32_t k = 0; k < 4; ++k) order = order * 4 + permute(k, 4, key);
    observed[order] += 1;
  }
  std::vector<std::size_t> p = {0, 1, 2, 3};
  do expected[((p[0] * 4 + p[1]) * 4 + p[2]) * 4 + p[3]] = kDraws / 24.0;
  while (std::ranges::next_permutation(p).found);
  EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(3));
  // Where any two elements of 16 and of 9 go.
  for (std::uint32_t length : {16u, 9u}) {
    std::vector<double> pairs(length * length * length * length);
    std::vector<double> pairs_expected(pairs.size());
    double each = kDraws / double(length * (length - 1)) / double(length * (length - 1));
    for (std::uint32_t i = 0; i < kDraws; ++i) {
      std::uint64_t key = hash_combine(fresh_seed() + length, i);
      std::uint32_t a = i % length, b = (a + 1 + i / length % (length - 1)) % length;
      pairs[((a * length + b) * length + permute(a, length, key)) * length + permute(b, length, key)] += 1;
    }
    for (std::uint32_t a = 0; a < length; ++a)
      for (std::uint32_t b = 0; b < length; ++b)
        for (std::uint32_t pa = 0; pa < length; ++pa)
          for (std::uint32_t pb = 0; pb < length; ++pb)
            if (a != b && pa != pb) pairs_expected[((a * length + b) * length + pa) * length + pb] = each;
    EXPECT_GT(chi_square_test(pairs, pairs_expected).p_value, sidak_threshold(3)) << length;
  }
}

/// Mean squared error over pixels of the mean of f over a pixel's first `samples`.
template <class F>
double mean_squared_error(SamplerType type, std::uint32_t samples, double exact, F f) {
  Sampler sampler(type, fresh_seed() + 3, 16);
  double sum = 0;
  constexpr std::uint32_t kPixels = 400;
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (std::uint32_t s = 0; s < samples; ++s) {
      sampler.start({pixel, 1}, s);
      mean += f(sampler) / samples;
    }
    sum += (mean - exact) * (mean - exact);
  }
  return sum / kPixels;
}

TEST(SamplerStatistical, StructureConvergesFasterOnASmoothIntegral) {
  SCOPED_TRACE(seed_note());
  auto smooth = [](const Sampler& s) {
    vec2 p = s.get_2d(Dimension::lens);
    return std::exp(double(p.x)) * std::sin(std::numbers::pi * double(p.y));
  };
  double exact = (std::numbers::e - 1) * 2 / std::numbers::pi;
  double independent = mean_squared_error(SamplerType::independent, 256, exact, smooth);
  // In theory a factor of about 256 for a jittered grid, and 256^2 for scrambled nets, but for constants.
  EXPECT_LT(mean_squared_error(SamplerType::stratified, 256, exact, smooth), independent / 30);
  EXPECT_LT(mean_squared_error(SamplerType::sobol, 256, exact, smooth), independent / 1000);
  // In 1-D, too, and on a count that is no power of two.
  auto line = [](const Sampler& s) { return std::exp(double(s.get_1d(Dimension::opacity))); };
  independent = mean_squared_error(SamplerType::independent, 300, std::numbers::e - 1, line);
  EXPECT_LT(mean_squared_error(SamplerType::sobol, 300, std::numbers::e - 1, line), independent / 30);
}

TEST(SamplerStatistical, PaddedDimensionsAreNoWorseThanIndependent) {
  SCOPED_TRACE(seed_note());
  // The product's variance is all in the interaction of dimensions that were not made to fit each other: were
  // they to run through their intervals in the same order, the error would be 64 times as large.
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      auto product = [=](const Sampler& s) {
        return (double(s.get_2d(Dimension::lens)[a]) - 0.5) * (double(s.get_2d(Dimension::film)[b]) - 0.5);
      };
      double independent = mean_squared_error(SamplerType::independent, 64, 0, product);
      EXPECT_LT(mean_squared_error(SamplerType::sobol, 64, 0, product), independent * 2) << a << b;
      EXPECT_LT(mean_squared_error(SamplerType::stratified, 64, 0, product), independent * 2) << a << b;
    }
  }
}

} // namespace
} // namespace candela::test
