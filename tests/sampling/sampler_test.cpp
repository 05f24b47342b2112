#include "sampler_draws.h"

#include <gtest/gtest.h>

#include <set>

namespace candela::test {
namespace {

TEST(Sampler, ANumberDependsOnItsKeyAlone) {
  for (SamplerType type : kSamplerTypes) {
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

TEST(Sampler, ManyDrawsAtOnceAreTheSameToTheBit) {
  for (SamplerType type : kSamplerTypes)
    for (std::uint32_t count : {0u, 1u, 15u, 64u, 150u}) { // less and more than is made at once
      std::vector<Sampler> samplers(count, Sampler(type, 7, 3));
      std::vector<Sampler::Draw> draws;
      for (std::uint32_t i = 0; i < count; ++i) {
        samplers[i].start({i % 5, i / 5}, hash32(i) >> (i % 32));
        samplers[i].set_bounce(i % 4);
        draws.push_back({&samplers[i], i % 3});
      }
      std::vector<vec2> points(count);
      std::vector<float> numbers(count);
      Sampler::get_2d(draws, Dimension::bsdf_direction, points);
      Sampler::get_1d(draws, Dimension::russian_roulette, numbers);
      for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(points[i], samplers[i].get_2d(Dimension::bsdf_direction, i % 3))
            << static_cast<int>(type) << ' ' << i;
        ASSERT_EQ(numbers[i], samplers[i].get_1d(Dimension::russian_roulette, i % 3));
      }
    }
}

TEST(Sampler, BranchesOfAllSamplesAreOneSequence) {
  for (SamplerType type : kSamplerTypes) {
    std::set<std::pair<float, float>> seen;
    for (std::uint32_t i = 0; i < 32; ++i)
      for (std::uint32_t k = 0; k < 3; ++k) {
        Sampler whole(type, 7, 3), part(type, 7, 3);
        whole.start({5, 8}, 3 * i + k), whole.set_bounce(2);
        part.start({5, 8}, i), part.set_bounce(2);
        Sampler branch = part.branch(k, 3);
        vec2 p = branch.get_2d(Dimension::bsdf_direction);
        if (type != SamplerType::independent) { // of which any sequence is as good
          EXPECT_EQ(p, whole.get_2d(Dimension::bsdf_direction));
        }
        branch.set_bounce(3);
        vec2 further = branch.get_2d(Dimension::bsdf_direction);
        EXPECT_TRUE(seen.insert({p.x, p.y}).second && seen.insert({further.x, further.y}).second)
            << static_cast<int>(type) << ' ' << i << ' ' << k;
      }
  }
}

TEST(Sampler, StartGoesToBounceZero) {
  for (SamplerType type : kSamplerTypes) {
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
  for (SamplerType type : kSamplerTypes) {
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
  for (SamplerType type : kSamplerTypes) {
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

} // namespace
} // namespace candela::test
