#include "sampler_draws.h"
#include "sampling/sequences.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace candela::test {
namespace {

TEST(Sequences, LaineKarrasIsANestedScramble) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    std::uint32_t x = hash32(i), seed = hash32(i + 99999);
    for (int bit = 0; bit < 32; ++bit) {
      std::uint32_t changed = laine_karras(x, seed) ^ laine_karras(x ^ (1u << bit), seed);
      // No lower bit sees it, and the bit itself does: this makes it a permutation, too.
      ASSERT_EQ(std::countr_zero(changed), bit);
    }
  }
}

TEST(Sequences, SecondSobolDimensionIsPascalsTriangle) {
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

TEST(Sequences, TransposedPascalHasRegularBlocks) {
  for (std::uint32_t j = 0; j < 32; ++j) { // column j is C(n, j) mod 2 over n
    std::uint32_t column = pascal_transposed(1u << j);
    for (std::uint32_t n = 0; n < 32; ++n) ASSERT_EQ((column >> n) & 1, (n & j) == j ? 1u : 0u);
  }
  for (int first = 0; first < 20; ++first) {
    for (int k = 1; k <= 12; ++k) {
      std::set<std::uint32_t> blocks; // rows first .. first + k - 1 of all vectors of k digits
      for (std::uint32_t m = 0; m < (1u << k); ++m)
        blocks.insert((pascal_transposed(m) >> first) & ((1u << k) - 1));
      ASSERT_EQ(blocks.size(), 1u << k) << first << ' ' << k;
    }
  }
}

TEST(Sequences, MortonCodesInterleave) {
  EXPECT_EQ(morton_code(0xffff, 0), 0x55555555u);
  EXPECT_EQ(morton_code(0, 0xffff), 0xaaaaaaaau);
  EXPECT_EQ(morton_code(3, 5), 0b100111u);
  EXPECT_EQ(morton_code(0x10003, 0x20005), 0b100111u); // 16 bits each
}

/// The leading `digits` digits of scrambled radical inverses in `base` of base^digits consecutive numbers.
template <class Inverse>
void expect_one_per_interval(std::uint64_t base, std::uint64_t first, int digits, Inverse inverse) {
  std::uint64_t count = 1;
  for (int i = 0; i < digits; ++i) count *= base;
  std::vector<bool> taken(count);
  for (std::uint64_t i = first; i < first + count; ++i) {
    // Half a unit, because the fraction is rounded down.
    std::uint64_t interval = ((static_cast<std::uint64_t>(inverse(i)) * 2 + 1) * count) >> 33;
    ASSERT_FALSE(taken[interval]) << base << ' ' << first << ' ' << digits;
    taken[interval] = true;
  }
}

TEST(Sequences, ScrambledRadicalInversesStayStratified) {
  for (std::uint64_t key = 0; key < 20; ++key) {
    for (std::uint64_t first : {0u, 1u, 1000u, 123456789u}) {
      for (int digits = 0; digits <= 10; ++digits)
        expect_one_per_interval(2, first, digits, [&](std::uint64_t i) {
          return scrambled_radical_inverse_2(static_cast<std::uint32_t>(i), hash64(key));
        });
      for (int digits = 0; digits <= 7; ++digits)
        expect_one_per_interval(3, first, digits,
                                [&](std::uint64_t i) { return scrambled_radical_inverse_3(i, hash64(key)); });
    }
  }
}

TEST(Sequences, ShuffleBySixesKeepsRunsTogether) {
  for (std::uint64_t key = 0; key < 10; ++key) {
    for (std::uint32_t length : {2u, 6u, 12u, 36u, 72u, 216u, 432u}) {
      for (std::uint32_t run : {0u, 1u, 2u, 5u, 6u, 77u, 4294967295u / length}) {
        std::set<std::uint64_t> images;
        std::uint64_t begin = static_cast<std::uint64_t>(run) * length;
        std::uint64_t end = std::min<std::uint64_t>(begin + length, 1ull << 32);
        for (std::uint64_t i = begin; i < end; ++i)
          images.insert(shuffle_by_sixes(static_cast<std::uint32_t>(i), hash64(key)));
        ASSERT_EQ(images.size(), end - begin);
        ASSERT_EQ(*images.begin() / length, *images.rbegin() / length) << length << ' ' << run;
      }
    }
  }
}

/// Squared length of the shortest vector of the lattice of 2^m points, relative to the hexagonal lattice of
/// that density: reduction by Lagrange, in exact arithmetic.
double shortest_vector(std::uint32_t generator, int m) {
  using Integer = std::int64_t;
  Integer n = Integer{1} << m;
  Integer ux = 0, uy = n, vx = 1, vy = static_cast<Integer>(generator) & (n - 1);
  auto dot = [](Integer ax, Integer ay, Integer bx, Integer by) {
    return static_cast<long double>(ax) * static_cast<long double>(bx) +
           static_cast<long double>(ay) * static_cast<long double>(by);
  };
  while (true) {
    auto q = std::llround(dot(ux, uy, vx, vy) / dot(vx, vy, vx, vy));
    ux -= q * vx;
    uy -= q * vy;
    if (dot(ux, uy, ux, uy) >= dot(vx, vy, vx, vy)) break;
    std::swap(ux, vx);
    std::swap(uy, vy);
  }
  return static_cast<double>(dot(vx, vy, vx, vy)) / static_cast<double>(n) * std::sqrt(3.0) / 2;
}

/// Least |h1 h2| with h1 + generator h2 = 0 modulo 2^m, h2 in 1 .. 2^m - 1, relative to 2^m. The best
/// approximations, by Euclid's algorithm, have it.
double zaremba_index(std::uint32_t generator, int m) {
  std::int64_t n = std::int64_t{1} << m;
  std::int64_t r0 = n, r1 = static_cast<std::int64_t>(generator) & (n - 1), q0 = 0, q1 = 1;
  double least = kInfinity;
  while (r1 != 0) {
    least = std::min(least, static_cast<double>(q1) * static_cast<double>(r1));
    std::int64_t quotient = r0 / r1;
    std::tie(r0, r1) = std::pair(r1, r0 - quotient * r1);
    std::tie(q0, q1) = std::pair(q1, q0 + quotient * q1);
  }
  return least / static_cast<double>(n);
}

TEST(Sequences, EveryLatticeIsGood) {
  EXPECT_NEAR(shortest_vector(1, 10), 2.0 / 1024 * std::sqrt(3.0) / 2, 1e-12); // the diagonal
  EXPECT_EQ(zaremba_index(1, 10), 1.0 / 1024);
  for (int m = 1; m <= 10; ++m) { // by trying all
    std::int64_t n = std::int64_t{1} << m, least = n;
    for (std::int64_t h = 1; h < n; ++h) {
      std::int64_t r = h * kLatticeGenerator % n;
      if (r != 0) least = std::min({least, h * r, h * (n - r)});
    }
    EXPECT_EQ(zaremba_index(kLatticeGenerator, m), double(least) / double(n)) << m;
  }
  for (int m = 1; m <= 32; ++m) {
    EXPECT_GT(shortest_vector(kLatticeGenerator, m), 0.52 * 0.52) << m;
    EXPECT_GT(zaremba_index(kLatticeGenerator, m), 0.057) << m;
  }
}

TEST(Sequences, PermuteIsAPermutation) {
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

/// Scrambled points are uniform, whatever their number, and pairs of them as independent as nesting allows:
/// once two numbers differ in a digit, all that follow are independent.
TEST(SequencesStatistical, ScramblingIsFair) {
  SCOPED_TRACE(seed_note());
  constexpr int kDraws = 200000;
  const std::uint32_t numbers[] = {0, 1, 2, 3, 5, 8, 9, 26, 27, 1000, 4294967295u};
  int tests = 2 * static_cast<int>(std::size(numbers)) + 4;
  auto inverse = [](std::uint32_t base, std::uint32_t i, std::uint64_t seed) {
    return base == 2 ? scrambled_radical_inverse_2(i, seed) : scrambled_radical_inverse_3(i, seed);
  };
  for (std::uint32_t base : {2u, 3u}) {
    for (std::uint32_t i : numbers) {
      std::vector<double> observed(216), expected(216, kDraws / 216.0);
      for (std::uint64_t t = 0; t < kDraws; ++t)
        observed[(static_cast<std::uint64_t>(inverse(base, i, hash_combine(fresh_seed(), t))) * 216) >> 32]++;
      EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(tests)) << base << ' ' << i;
    }
    // Two numbers that differ in their first or second digit: base^3 intervals for each.
    for (std::uint32_t differ : {1u, base}) {
      std::uint64_t cells = base * base * base;
      std::vector<double> observed(cells * cells), expected(cells * cells);
      std::uint64_t common = differ == 1 ? 1 : base;
      for (std::uint64_t t = 0; t < kDraws; ++t) {
        std::uint64_t seed = hash_combine(fresh_seed() + 1, t);
        std::uint64_t a = (static_cast<std::uint64_t>(inverse(base, 7, seed)) * cells) >> 32;
        std::uint64_t b = (static_cast<std::uint64_t>(inverse(base, 7 + differ, seed)) * cells) >> 32;
        observed[a * cells + b] += 1;
      }
      std::uint64_t block = cells / common, half = block / base;
      for (std::uint64_t a = 0; a < cells; ++a)
        for (std::uint64_t b = 0; b < cells; ++b)
          if (a / block == b / block && a / half != b / half)
            expected[a * cells + b] = double(kDraws) / double(cells * (block - half));
      EXPECT_GT(chi_square_test(observed, expected).p_value, sidak_threshold(tests)) << base << ' ' << differ;
    }
  }
}

/// A good shuffle makes any order equally likely; of few elements all orders can be counted.
TEST(SequencesStatistical, PermuteIsFair) {
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

} // namespace
} // namespace candela::test
