// Both SIMD implementations, lane by lane against scalar floats, and traversal with both.

#include "accel/simd/simd.h"
#include "accel/traversal.h"
#include "brute_force.h"

#include <omp.h>

namespace {

using namespace candela;
using namespace candela::test;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

template <class F>
class SimdFloat8 : public testing::Test {};
using Implementations = testing::Types<simd::PortableFloat8, simd::Float8>;
TYPED_TEST_SUITE(SimdFloat8, Implementations);

struct alignas(32) Lanes {
  std::array<float, 8> f;
};

template <class F, class Vector, class Scalar>
void expect_lanes(Vector vector, Scalar scalar) {
  const Lanes a{{1, -2, 0, kNotANumber, 4, kInfinity, -0.0f, 1e-40f}},
      b{{2, -2, 3, 1, kNotANumber, -kInfinity, 0, 3}};
  Lanes result;
  vector(F::load(a.f.data()), F::load(b.f.data())).store(result.f.data());
  for (std::size_t i = 0; i < 8; ++i) {
    float expected = scalar(a.f[i], b.f[i]);
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(result.f[i])) << i;
    else
      EXPECT_EQ(std::bit_cast<std::uint32_t>(result.f[i]), std::bit_cast<std::uint32_t>(expected)) << i;
  }
}

TYPED_TEST(SimdFloat8, Arithmetic) {
  using F = TypeParam;
  expect_lanes<F>([](F a, F b) { return a + b; }, [](float a, float b) { return a + b; });
  expect_lanes<F>([](F a, F b) { return a - b; }, [](float a, float b) { return a - b; });
  expect_lanes<F>([](F a, F b) { return a * b; }, [](float a, float b) { return a * b; });
  expect_lanes<F>([](F a, F b) { return a / b; }, [](float a, float b) { return a / b; });
  expect_lanes<F>([](F a, F) { return sqrt(a); }, [](float a, float) { return std::sqrt(a); });
  expect_lanes<F>([](F a, F b) { return a + F(2.5f) * b; }, [](float a, float b) { return a + 2.5f * b; });
}

/// The operand that NaN yields is part of the contract.
TYPED_TEST(SimdFloat8, MinMaxAndSelect) {
  using F = TypeParam;
  expect_lanes<F>([](F a, F b) { return min(a, b); }, [](float a, float b) { return a < b ? a : b; });
  expect_lanes<F>([](F a, F b) { return max(a, b); }, [](float a, float b) { return a > b ? a : b; });
  expect_lanes<F>([](F a, F b) { return select_less(a, b, F(1.0f), a); },
                  [](float a, float b) { return a < b ? 1.0f : a; });
  expect_lanes<F>([](F a, F b) { return simd::with_sign_of(b, a); },
                  [](float a, float b) { return a < 0 ? 0.0f - b : b; });
}

TYPED_TEST(SimdFloat8, Comparisons) {
  using F = TypeParam;
  const Lanes a{{1, 2, 3, kNotANumber, 5, 6, -0.0f, 8}}, b{{1, 3, 2, 4, kNotANumber, 6, 0, kInfinity}};
  F x = F::load(a.f.data()), y = F::load(b.f.data());
  EXPECT_EQ(less(x, y), 0b10000010u);
  EXPECT_EQ(less_equal(x, y), 0b11100011u);
  EXPECT_EQ(equal(x, y), 0b01100001u);
  EXPECT_EQ(equal(x, x), 0b11110111u);
}

TYPED_TEST(SimdFloat8, SelectsLanes) {
  using F = TypeParam;
  // Among them bits that are no number: they come through as they are.
  const Lanes a{{1, -2, 0, std::bit_cast<float>(0x7f800001u), 4, kInfinity, -0.0f, 1e-40f}},
      b{{2, -2, 3, 1, std::bit_cast<float>(0xffffffffu), -kInfinity, 0, 3}};
  for (simd::LaneMask mask = 0; mask <= simd::kAllLanes; ++mask) {
    Lanes result;
    select_lanes(mask, F::load(a.f.data()), F::load(b.f.data())).store(result.f.data());
    for (std::size_t i = 0; i < 8; ++i) {
      const float expected = mask >> i & 1 ? a.f[i] : b.f[i]; // bit for bit: NaN, too
      EXPECT_EQ(std::bit_cast<std::uint32_t>(result.f[i]), std::bit_cast<std::uint32_t>(expected))
          << mask << ", lane " << i;
    }
  }
}

/// For every set of lanes, with equal keys among them.
TYPED_TEST(SimdFloat8, TakesTheFirstAndSorts) {
  using F = TypeParam;
  using Entry = simd::Keyed<std::uint32_t>;
  const Lanes keys{{3, 1, 4, 1, 5, kInfinity, 0, 4}};
  alignas(32) const std::array<std::uint32_t, 8> values{80, 70, 60, 50, 40, 30, 20, 10};
  F k = F::load(keys.f.data());
  for (simd::LaneMask lanes = 1; lanes < 256; ++lanes) {
    std::vector<std::pair<float, std::uint32_t>> expected;
    for (std::size_t i = 0; i < 8; ++i)
      if (lanes >> i & 1) expected.emplace_back(keys.f[i], values[i]);
    auto stored = [&](auto store) {
      std::array<Entry, 8> out;
      auto count = static_cast<std::size_t>(store(out.data()));
      std::vector<std::pair<float, std::uint32_t>> result;
      for (std::size_t i = 0; i < count; ++i) result.emplace_back(out[i].key, out[i].value);
      return result;
    };
    std::uint32_t first = 0;
    const auto others = stored([&](Entry* out) {
      first = simd::take_first(k, values, lanes, out);
      return std::popcount(lanes) - 1;
    });
    EXPECT_EQ(first, expected.front().second);
    EXPECT_EQ(others, decltype(expected)(expected.begin() + 1, expected.end())) << lanes;
    EXPECT_EQ(first_lane(k, lanes), expected.front().first);
    std::sort(expected.rbegin(), expected.rend());
    EXPECT_EQ(stored([&](Entry* out) { return simd::store_descending(k, values, lanes, out); }), expected)
        << lanes;
  }
}

TYPED_TEST(SimdFloat8, Halves) {
  const Lanes a{{3, 1, 4, 1, 5, kInfinity, 0, 4}};
  TypeParam x = TypeParam::load(a.f.data());
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(x.lower()[i], a.f[static_cast<std::size_t>(i)]);
    EXPECT_EQ(x.upper()[i], a.f[static_cast<std::size_t>(i + 4)]);
  }
}

TEST(Simd, FourFloats) {
  simd::Vec4 a{1, -2, 0, -kInfinity}, b{2, -3, -0.0f, 1};
  simd::Vec4 least = simd::min4(a, b), greatest = simd::max4(a, b), size = simd::abs4(a);
  simd::Vec4 signed_size = simd::copysign4(size, b);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(least[i], a[i] < b[i] ? a[i] : b[i]);
    EXPECT_EQ(greatest[i], a[i] > b[i] ? a[i] : b[i]);
    EXPECT_EQ(size[i], std::abs(a[i]));
    EXPECT_EQ(signed_size[i], std::copysign(a[i], b[i]));
    EXPECT_EQ(std::signbit(signed_size[i]), std::signbit(b[i]));
  }
}

TEST(Simd, LoopsOverLanesInOrder) {
  std::vector<int> lanes;
  simd::for_each_lane(0b10010110u, [&](int lane) { lanes.push_back(lane); });
  EXPECT_EQ(lanes, (std::vector{1, 2, 4, 7}));
}

TestScene mixed_scene(int triangles, float size) {
  Random random(11);
  TestScene scene;
  for (int i = 0; i < triangles; ++i) {
    vec3 c = random.in_cube(), a = c + random.in_cube(size);
    scene.add_triangle(c, a, c + random.in_cube(size));
  }
  for (int i = 0; i < triangles / 10; ++i) {
    vec3 c = random.in_cube(), n = random.direction();
    scene.spheres.push_back({random.in_cube(), 0.5f * size});
    scene.discs.push_back({c, size, n});
  }
  return scene;
}

/// The same bits from both, including which of two hits at the same t wins.
TEST(AccelPortable, FindsTheSameHits) {
  TestScene scene = mixed_scene(3000, 0.1f);
  scene.triangles.insert(scene.triangles.end(), scene.triangles.begin(), scene.triangles.begin() + 1000);
  Accel accel = Accel::build(scene.input());
  const AccelTree& tree = *AccelAccess::tree(accel);
  Random random(12);
  int hits = 0;
  for (int i = 0; i < 50000; ++i) {
    vec3 origin = random.in_cube(2);
    Ray ray{origin, 0, random.in_cube() - origin, i % 4 ? kInfinity : 0.7f};
    if (i % 7 == 0) ray.direction.x = 0;
    Hit portable;
    bool found = accel_detail::trace<simd::PortableFloat8, false>(tree, ray, portable);
    auto hit = accel.intersect(ray);
    ASSERT_EQ(found, hit.has_value());
    Hit unused;
    ASSERT_EQ((accel_detail::trace<simd::PortableFloat8, true>(tree, ray, unused)), accel.occluded(ray));
    if (!found) continue;
    ++hits;
    ASSERT_EQ(portable.t, hit->t);
    ASSERT_EQ(portable.u, hit->u);
    ASSERT_EQ(portable.v, hit->v);
    ASSERT_EQ(portable.primitive, hit->primitive);
    ASSERT_EQ(portable.kind, hit->kind);
  }
  EXPECT_GT(hits, 20000);
}

/// Large enough for every parallel path of the build.
TEST(AccelDeterminism, AnyNumberOfThreadsBuildsTheSameTree) {
  TestScene scene = mixed_scene(280000, 0.01f);
  int threads_before = omp_get_max_threads();
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
    omp_set_num_threads(1);
    Accel one = Accel::build(scene.input(), quality);
    const AccelTree& a = *AccelAccess::tree(one);
    for (int threads : {2, 5}) {
      omp_set_num_threads(threads);
      Accel other = Accel::build(scene.input(), quality);
      const AccelTree& b = *AccelAccess::tree(other);
      EXPECT_TRUE(a.nodes == b.nodes) << threads;
      EXPECT_TRUE(a.triangles() == b.triangles()) << threads;
      EXPECT_TRUE(a.packs<primitives::Spheres>() == b.packs<primitives::Spheres>()) << threads;
      EXPECT_TRUE(a.packs<primitives::Discs>() == b.packs<primitives::Discs>()) << threads;
      EXPECT_TRUE(a.root == b.root);
    }
  }
  omp_set_num_threads(threads_before);
}

/// A bumpy sheet: 64 bytes a triangle for nodes and packs, vertices and all.
TEST(AccelStatistics, AMeshTakesFewBytes) {
  TestScene scene;
  constexpr std::uint32_t kSize = 150;
  for (std::uint32_t y = 0; y <= kSize; ++y)
    for (std::uint32_t x = 0; x <= kSize; ++x) {
      float u = static_cast<float>(x), v = static_cast<float>(y);
      scene.vertices.push_back(
          {u, v, 3 * std::sin(0.1f * u) * std::cos(0.13f * v) + 0.3f * std::sin(u + 2 * v)});
    }
  for (std::uint32_t y = 0; y < kSize; ++y)
    for (std::uint32_t x = 0; x < kSize; ++x) {
      std::uint32_t a = y * (kSize + 1) + x, b = a + kSize + 1;
      scene.triangles.push_back({a, a + 1, b + 1});
      scene.triangles.push_back({a, b + 1, b});
    }
  for (BuildQuality quality : {BuildQuality::fast, BuildQuality::high}) {
    Accel accel = Accel::build(scene.input(), quality);
    EXPECT_EQ(accel.stats().count(PrimitiveKind::triangle), scene.triangles.size());
    EXPECT_LE(accel.memory_bytes(), 64 * scene.triangles.size());
  }
}

TEST(AccelStatistics, AddUp) {
  TestScene scene = mixed_scene(1000, 0.1f);
  Accel high = Accel::build(scene.input()), fast = Accel::build(scene.input(), BuildQuality::fast);
  for (const Accel* accel : {&high, &fast}) {
    AccelStats stats = accel->stats();
    const AccelTree& tree = *AccelAccess::tree(*accel);
    EXPECT_EQ(stats.count(PrimitiveKind::triangle), 1000u);
    EXPECT_EQ(stats.count(PrimitiveKind::sphere), 100u);
    EXPECT_EQ(stats.count(PrimitiveKind::disc), 100u);
    EXPECT_EQ(stats.leaves, tree.triangles().size() + tree.packs<primitives::Spheres>().size() +
                                tree.packs<primitives::Discs>().size());
    EXPECT_EQ(accel->memory_bytes(), stats.bytes);
    EXPECT_GT(stats.bytes, stats.count(PrimitiveKind::triangle) * 40);
    EXPECT_GT(stats.depth, 1);
  }
  // What the dynamic programming is for.
  EXPECT_LT(high.stats().sah_cost, fast.stats().sah_cost);
}

} // namespace
