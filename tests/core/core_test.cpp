// Errors, hashes, bases, rays and colours.

#include "core/basis.h"
#include "core/bounds.h"
#include "core/color.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/ray.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace candela;
using namespace candela::test;

TEST(Errors, SayWhereWhatWhyAndHow) {
  Error e = input_error({"a.json", 3, 7}, "materials[2].roughness", "2 is out of range",
                        "give a number from 0 to 1");
  EXPECT_STREQ(e.what(), "a.json:3:7: materials[2].roughness: 2 is out of range: give a number from 0 to 1");
  EXPECT_EQ(e.code(), ExitCode::bad_input);
  EXPECT_EQ(limit_error({"a", 0, 0}, "b", "c", "d").code(), ExitCode::limit);
  EXPECT_STREQ(limit_error({"a", 0, 0}, "b", "c", "d").what(), "a: b: c: d");
  EXPECT_STREQ(usage_error("--spp", "x", "y").what(), "--spp: x: y");
  EXPECT_EQ(usage_error("--spp", "x", "y").code(), ExitCode::usage);
  EXPECT_EQ(output_error("o.png", "disc full", "make room").code(), ExitCode::output);
  EXPECT_EQ(to_string(Location{"f", 4, 0}), "f:4");
  EXPECT_EQ(to_string(Location{"f", 0, 9}), "f");
}

/// Strict avalanche: a flipped input bit flips each output bit with chance 1/2.
template <class Hash, class Word>
void expect_avalanche(Hash hash, Word, std::uint64_t salt) {
  constexpr int kBits = sizeof(Word) * 8, kTrials = 4000;
  std::vector<int> flips(kBits * kBits);
  for (std::uint64_t t = 0; t < kTrials; ++t) {
    auto x = static_cast<Word>(hash_combine(fresh_seed() + salt, t * 77 + 1));
    Word h = hash(x);
    for (int i = 0; i < kBits; ++i) {
      Word difference = h ^ hash(x ^ (Word{1} << i));
      for (int o = 0; o < kBits; ++o) flips[static_cast<std::size_t>(i * kBits + o)] += (difference >> o) & 1;
    }
  }
  double chi_square = 0;
  for (int f : flips) chi_square += (f - kTrials / 2.0) * (f - kTrials / 2.0) / (kTrials / 4.0);
  // Not a test of exactness: the flips of a permutation are not quite independent; a factor of two is a poor
  // hash.
  EXPECT_LT(chi_square / static_cast<double>(flips.size()), 1.2) << seed_note();
  for (int f : flips) EXPECT_NEAR(f, kTrials / 2.0, 7 * std::sqrt(kTrials / 4.0)) << seed_note();
}

TEST(HashStatistical, AvalancheOf32And64Bits) {
  expect_avalanche([](std::uint32_t x) { return hash32(x); }, std::uint32_t{}, 1);
  expect_avalanche([](std::uint64_t x) { return hash64(x); }, std::uint64_t{}, 2);
  expect_avalanche([](std::uint64_t x) { return hash_combine(x, 5); }, std::uint64_t{}, 3);
  expect_avalanche([](std::uint64_t x) { return hash_combine(5, x); }, std::uint64_t{}, 4);
}

TEST(HashStatistical, CountersGiveUniformValues) {
  std::vector<double> bins(256), expected(256, 1000);
  for (std::uint64_t i = 0; i < 256000; ++i)
    bins[static_cast<std::size_t>(
        to_unit_float(static_cast<std::uint32_t>(hash_combine(fresh_seed(), i) >> 32)) * 256)] += 1;
  EXPECT_GT(chi_square_test(bins, expected).p_value, kFalseAlarm) << seed_note();
}

TEST(Hash, UnitFloatsAreBelowOne) {
  EXPECT_EQ(to_unit_float(0), 0);
  EXPECT_EQ(to_unit_float(0xffffffffu), kOneMinusEpsilon);
  EXPECT_NE(hash_combine(1, 2), hash_combine(2, 1));
}

TEST(Basis, IsOrthonormalAndRightHanded) {
  SCOPED_TRACE(seed_note());
  for (std::uint64_t i = 0; i < 20000; ++i) {
    auto u = [&](std::uint64_t k) {
      return 2 * to_unit_float(static_cast<std::uint32_t>(hash_combine(fresh_seed() + k, i))) - 1;
    };
    vec3 v(u(1), u(2), u(3));
    if (i < 3) v = {i == 0 ? 1e-20f : 0.0f, i == 1 ? 1e-8f : 0.0f, i == 2 ? 1.0f : -1.0f}; // near -z
    if (glm::length(v) < 0.1f) continue;
    vec3 n = glm::normalize(v);
    Basis b = Basis::from_normal(n);
    ASSERT_NEAR(glm::length(b.s), 1, 1e-6f);
    ASSERT_NEAR(glm::length(b.t), 1, 1e-6f);
    ASSERT_NEAR(glm::dot(b.s, b.t), 0, 1e-6f);
    ASSERT_NEAR(glm::length(glm::cross(b.s, b.t) - n), 0, 2e-6f);
    ASSERT_NEAR(glm::length(b.to_world(b.to_local(v)) - v), 0, 1e-6f);
    ASSERT_EQ(b.to_world({0, 0, 1}), n);
  }
}

TEST(Ray, OffsetGoesToTheSideOfTheDirectionBeyondTheError) {
  SCOPED_TRACE(seed_note());
  for (std::uint64_t i = 0; i < 20000; ++i) {
    auto u = [&](std::uint64_t k) {
      return 2 * to_unit_float(static_cast<std::uint32_t>(hash_combine(fresh_seed() + k, i))) - 1;
    };
    vec3 p = 100.0f * vec3(u(1), u(2), u(3)), error = 1e-4f * glm::abs(vec3(u(4), u(5), u(6)));
    vec3 n = glm::normalize(vec3(u(7), u(8), u(9)) + 1e-3f), w = vec3(u(10), u(11), u(12));
    double side = glm::dot(w, n) < 0 ? -1 : 1;
    glm::dvec3 moved = glm::dvec3(offset_ray_origin(p, error, n, w)) - glm::dvec3(p);
    // Beyond any point of the error box, seen along the normal, but for what rounding of p itself takes.
    double along = side * glm::dot(moved, glm::dvec3(n)),
           box = static_cast<double>(glm::dot(glm::abs(n), error));
    ASSERT_GE(along, box * (1 - 1e-5) - 1e-7);
    ASSERT_LE(along, box + 5e-5);
  }
}

TEST(Bounds, EmptyAndGrown) {
  Bounds3 b;
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(b.half_area(), 0);
  b.grow(vec3(1, 2, 3));
  EXPECT_FALSE(b.empty());
  EXPECT_EQ(b, (Bounds3{{1, 2, 3}, {1, 2, 3}}));
  b.grow(Bounds3{{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(b.half_area(), 1 * 2 + 2 * 3 + 3 * 1);
  EXPECT_EQ(b.center(), vec3(0.5f, 1, 1.5f));
}

TEST(Color, SrgbIsItsOwnInverse) {
  for (int i = 0; i <= 1000; ++i) {
    float x = static_cast<float>(i) / 1000;
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(x)), x, 2e-6f);
  }
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.214041f, 1e-6f); // IEC 61966-2-1
  EXPECT_NEAR(luminance(vec3(1)), 1, 1e-6f);
}

} // namespace
