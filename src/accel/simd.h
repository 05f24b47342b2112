#pragma once
// Eight floats at a time, with one interface and two implementations that give the same bits: AVX intrinsics
// where the compiler may use them, and compiler vector extensions everywhere else. Kernels are templates over
// the implementation, so one program can run (and a test compare) both.
//
// Every operation is IEEE single precision with one rounding. A comparison gives a bit per lane, lane 0
// lowest. Bits in an integer register cost a move but make "any", "which" and loops over lanes free of
// shuffles.

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace candela::simd {

inline constexpr int kLanes = 8;
inline constexpr std::uint32_t kAllLanes = 0xff;
using LaneMask = std::uint32_t;

/// Calls f(lane) for every set lane, from the lowest.
template <class Function>
inline void for_each_lane(LaneMask lanes, Function&& f) {
  for (; lanes; lanes &= lanes - 1) f(std::countr_zero(lanes));
}

/// Two halves of four rather than one vector of eight, whose calling convention depends on compiler flags.
struct PortableFloat8 {
  using Half = float __attribute__((vector_size(16)));
  using HalfInt = std::int32_t __attribute__((vector_size(16)));
  Half lo, hi;

  PortableFloat8() = default;
  PortableFloat8(Half low, Half high) : lo(low), hi(high) {}
  explicit PortableFloat8(float x) : lo{x, x, x, x}, hi{x, x, x, x} {}
  /// p is aligned to 32 bytes.
  static PortableFloat8 load(const float* p) {
    return {*reinterpret_cast<const Half*>(p), *reinterpret_cast<const Half*>(p + 4)};
  }
  void store(float* p) const { *reinterpret_cast<Half*>(p) = lo, *reinterpret_cast<Half*>(p + 4) = hi; }

  friend PortableFloat8 operator+(PortableFloat8 a, PortableFloat8 b) { return {a.lo + b.lo, a.hi + b.hi}; }
  friend PortableFloat8 operator-(PortableFloat8 a, PortableFloat8 b) { return {a.lo - b.lo, a.hi - b.hi}; }
  friend PortableFloat8 operator*(PortableFloat8 a, PortableFloat8 b) { return {a.lo * b.lo, a.hi * b.hi}; }
  friend PortableFloat8 operator/(PortableFloat8 a, PortableFloat8 b) { return {a.lo / b.lo, a.hi / b.hi}; }

  /// a < b ? a : b, so b if either is NaN; the box test relies on that.
  friend PortableFloat8 min(PortableFloat8 a, PortableFloat8 b) { return select_less(a, b, a, b); }
  /// a > b ? a : b, so b if either is NaN.
  friend PortableFloat8 max(PortableFloat8 a, PortableFloat8 b) { return select_less(b, a, a, b); }
  friend PortableFloat8 sqrt(PortableFloat8 a) {
    for (int i = 0; i < 4; ++i) a.lo[i] = std::sqrt(a.lo[i]), a.hi[i] = std::sqrt(a.hi[i]);
    return a;
  }

  friend LaneMask less(PortableFloat8 a, PortableFloat8 b) { return bits(a.lo < b.lo, a.hi < b.hi); }
  friend LaneMask less_equal(PortableFloat8 a, PortableFloat8 b) { return bits(a.lo <= b.lo, a.hi <= b.hi); }
  friend LaneMask equal(PortableFloat8 a, PortableFloat8 b) { return bits(a.lo == b.lo, a.hi == b.hi); }
  /// a < b ? x : y
  friend PortableFloat8 select_less(PortableFloat8 a, PortableFloat8 b, PortableFloat8 x, PortableFloat8 y) {
    return {blend(a.lo < b.lo, x.lo, y.lo), blend(a.hi < b.hi, x.hi, y.hi)};
  }

private:
  static Half blend(HalfInt mask, Half x, Half y) {
    return reinterpret_cast<Half>((mask & reinterpret_cast<HalfInt>(x)) |
                                  (~mask & reinterpret_cast<HalfInt>(y)));
  }
  static LaneMask bits(HalfInt low, HalfInt high) {
#if defined(__SSE2__)
    return static_cast<LaneMask>(_mm_movemask_ps(reinterpret_cast<__m128>(low)) |
                                 _mm_movemask_ps(reinterpret_cast<__m128>(high)) << 4);
#else
    LaneMask result = 0;
    for (int i = 0; i < 4; ++i) result |= (low[i] ? 1u << i : 0u) | (high[i] ? 16u << i : 0u);
    return result;
#endif
  }
};

#if defined(__AVX__)

struct AvxFloat8 {
  __m256 v;

  AvxFloat8() = default;
  AvxFloat8(__m256 value) : v(value) {}
  explicit AvxFloat8(float x) : v(_mm256_set1_ps(x)) {}
  static AvxFloat8 load(const float* p) { return _mm256_load_ps(p); }
  void store(float* p) const { _mm256_store_ps(p, v); }

  friend AvxFloat8 operator+(AvxFloat8 a, AvxFloat8 b) { return _mm256_add_ps(a.v, b.v); }
  friend AvxFloat8 operator-(AvxFloat8 a, AvxFloat8 b) { return _mm256_sub_ps(a.v, b.v); }
  friend AvxFloat8 operator*(AvxFloat8 a, AvxFloat8 b) { return _mm256_mul_ps(a.v, b.v); }
  friend AvxFloat8 operator/(AvxFloat8 a, AvxFloat8 b) { return _mm256_div_ps(a.v, b.v); }

  friend AvxFloat8 min(AvxFloat8 a, AvxFloat8 b) { return _mm256_min_ps(a.v, b.v); }
  friend AvxFloat8 max(AvxFloat8 a, AvxFloat8 b) { return _mm256_max_ps(a.v, b.v); }
  friend AvxFloat8 sqrt(AvxFloat8 a) { return _mm256_sqrt_ps(a.v); }

  friend LaneMask less(AvxFloat8 a, AvxFloat8 b) { return compare<_CMP_LT_OQ>(a, b); }
  friend LaneMask less_equal(AvxFloat8 a, AvxFloat8 b) { return compare<_CMP_LE_OQ>(a, b); }
  friend LaneMask equal(AvxFloat8 a, AvxFloat8 b) { return compare<_CMP_EQ_OQ>(a, b); }
  friend AvxFloat8 select_less(AvxFloat8 a, AvxFloat8 b, AvxFloat8 x, AvxFloat8 y) {
    return _mm256_blendv_ps(y.v, x.v, _mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ));
  }

private:
  template <int predicate>
  static LaneMask compare(AvxFloat8 a, AvxFloat8 b) {
#if defined(__AVX512VL__)
    return _mm256_cmp_ps_mask(a.v, b.v, predicate);
#else
    return static_cast<LaneMask>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, predicate)));
#endif
  }
};

using Float8 = AvxFloat8;

#else

using Float8 = PortableFloat8;

#endif

/// (a < 0 ? -magnitude : magnitude) for magnitudes of either sign.
template <class F>
inline F with_sign_of(F magnitude, F a) {
  return select_less(a, F(0.0f), F(0.0f) - magnitude, magnitude);
}

} // namespace candela::simd
