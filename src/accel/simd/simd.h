#pragma once
// Eight floats at a time, with one interface and two implementations that give the same bits: AVX intrinsics
// where the compiler may use them, and compiler vector extensions everywhere else. Kernels are templates over
// the implementation, so one program can run (and a test compare) both.
//
// Every operation is IEEE single precision with one rounding. A comparison gives a bit per lane, lane 0
// lowest. Bits in an integer register cost a move but make "any", "which" and loops over lanes free of
// shuffles.

#include "accel/simd/lanes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

#if defined(__SSE2__)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 takes the intrinsics' own undefined operands for a mistake (PR 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif

namespace candela::simd {

/// Something with a key to sort by. The key comes second, so that on this little-endian machine the whole is
/// an integer of 64 bits that sorts by key (if that is not negative), then by value.
template <class Value>
struct Keyed {
  static_assert(sizeof(Value) == 4 && std::endian::native == std::endian::little);
  Value value;
  float key;
};

/// Two halves of four rather than one vector of eight, whose calling convention depends on compiler flags.
struct PortableFloat8 {
  using Half = Vec4;
  using HalfInt = IntVec4;
  Half lo, hi;

  PortableFloat8() = default;
  PortableFloat8(Half low, Half high) : lo(low), hi(high) {}
  explicit PortableFloat8(float x) : lo{x, x, x, x}, hi{x, x, x, x} {}
  /// p is aligned to 32 bytes. By memcpy, for a lane may be something else than a float.
  static PortableFloat8 load(const float* p) {
    PortableFloat8 result;
    std::memcpy(&result, std::assume_aligned<32>(p), sizeof(result));
    return result;
  }
  void store(float* p) const { std::memcpy(std::assume_aligned<32>(p), this, sizeof(*this)); }
  Vec4 lower() const { return lo; } ///< lanes 0 to 3
  Vec4 upper() const { return hi; } ///< lanes 4 to 7

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

  /// x in the lanes, y in the others.
  friend PortableFloat8 select_lanes(LaneMask lanes, PortableFloat8 x, PortableFloat8 y) {
    const HalfInt bit{1, 2, 4, 8}, all = HalfInt{} + static_cast<std::int32_t>(lanes);
    return {blend((all & bit) != 0, x.lo, y.lo), blend((all >> 4 & bit) != 0, x.hi, y.hi)};
  }
  /// Of the lowest of the lanes, of which there is one at least.
  friend float first_lane(PortableFloat8 a, LaneMask lanes) {
    int i = std::countr_zero(lanes);
    return i < 4 ? a.lo[i] : a.hi[i - 4];
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
  Vec4 lower() const { return reinterpret_cast<Vec4>(_mm256_castps256_ps128(v)); }
  Vec4 upper() const { return reinterpret_cast<Vec4>(_mm256_extractf128_ps(v, 1)); }

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

  friend AvxFloat8 select_lanes(LaneMask lanes, AvxFloat8 x, AvxFloat8 y) {
#if defined(__AVX512VL__)
    return _mm256_mask_mov_ps(y.v, static_cast<__mmask8>(lanes), x.v);
#else
    return _mm256_blendv_ps(y.v, x.v, _mm256_set_m128(half_mask(lanes >> 4), half_mask(lanes)));
#endif
  }

  friend float first_lane(AvxFloat8 a, LaneMask lanes) {
#if defined(__AVX512VL__)
    // A shuffle has half the latency of memory, and the next box test waits for this.
    return _mm256_cvtss_f32(_mm256_maskz_compress_ps(static_cast<__mmask8>(lanes), a.v));
#else
    alignas(32) float lane[kLanes];
    a.store(lane);
    return lane[std::countr_zero(lanes)];
#endif
  }

private:
  /// The lowest four bits as four lanes.
  static __m128 half_mask(LaneMask lanes) {
    const __m128i bit = _mm_setr_epi32(1, 2, 4, 8);
    return _mm_castsi128_ps(
        _mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(lanes)), bit), bit));
  }
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

/// Stores (value[i], keys[i]) of all lanes but the lowest at `out`, in order, and gives the lowest one's
/// value; out has room for eight whatever that is.
template <class F, class Value>
inline Value take_first(F keys, const std::array<Value, kLanes>& values, LaneMask lanes, Keyed<Value>* out) {
  alignas(32) std::array<float, kLanes> key;
  keys.store(key.data());
  for_each_lane(lanes & (lanes - 1), [&](int lane) {
    auto i = static_cast<std::size_t>(lane);
    *out++ = {values[i], key[i]};
  });
  return values[static_cast<std::size_t>(std::countr_zero(lanes))];
}

/// Stores (value[i], keys[i]) of the lanes at `out`, the greatest key first and equal keys by value, and
/// gives how many; out has room for eight whatever that is. No key is negative.
template <class F, class Value>
inline int store_descending(F keys, const std::array<Value, kLanes>& values, LaneMask lanes,
                            Keyed<Value>* out) {
  alignas(32) std::array<float, kLanes> key;
  keys.store(key.data());
  int count = 0;
  for_each_lane(lanes, [&](int lane) {
    auto i = static_cast<std::size_t>(lane);
    Keyed<Value> entry{values[i], key[i]};
    auto bits = [](Keyed<Value> e) { return std::bit_cast<std::uint64_t>(e); };
    int at = count++;
    for (; at > 0 && bits(out[at - 1]) < bits(entry); --at) out[at] = out[at - 1];
    out[at] = entry;
  });
  return count;
}

#if defined(__AVX512VL__) && !defined(NOSORT)

/// The entries of the lanes side by side, the others 0. To a register: compressing straight to memory is
/// microcoded on AMD.
template <class Value>
inline __m512i compress_entries(AvxFloat8 keys, const std::array<Value, kLanes>& values, LaneMask lanes) {
  const __m512i interleave = _mm512_setr_epi32(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
  __m256i value = _mm256_load_si256(reinterpret_cast<const __m256i*>(values.data()));
  __m512i both = _mm512_inserti64x4(_mm512_castsi256_si512(value), _mm256_castps_si256(keys.v), 1);
  return _mm512_maskz_compress_epi64(static_cast<__mmask8>(lanes),
                                     _mm512_permutexvar_epi32(interleave, both));
}

template <class Value>
inline Value take_first(AvxFloat8 keys, const std::array<Value, kLanes>& values, LaneMask lanes,
                        Keyed<Value>* out) {
  __m512i e = compress_entries(keys, values, lanes);
  _mm512_storeu_si512(out, _mm512_alignr_epi64(e, e, 1));
  // From the register: what is stored can be loaded only some cycles later, and the next node waits for it.
  // With the order of children (Collapse::order) this gave 8 % more shadow rays in Sponza.
  return std::bit_cast<Value>(_mm_cvtsi128_si32(_mm512_castsi512_si128(e)));
}

/// A bitonic network in one register: the mispredicted branches of an insertion sort cost 6 % of all time for
/// diffuse rays, and nothing for coherent ones.
template <class Value>
inline int store_descending(AvxFloat8 keys, const std::array<Value, kLanes>& values, LaneMask lanes,
                            Keyed<Value>* out) {
  __m512i e = compress_entries(keys, values, lanes);
  // Lanes in `lesser` keep the lesser of themselves and their partner, the others the greater.
  auto exchange = [&e](__mmask8 lesser, __m512i partner) {
    e = _mm512_mask_min_epu64(_mm512_max_epu64(e, partner), lesser, e, partner);
  };
  auto partner_1 = [&e] { return _mm512_shuffle_epi32(e, _MM_PERM_BADC); };
  auto partner_2 = [&e] { return _mm512_permutex_epi64(e, 0b01001110); };
  auto partner_4 = [&e] { return _mm512_shuffle_i64x2(e, e, 0b01001110); };
  int count = std::popcount(lanes);
  exchange(0b01100110, partner_1());
  if (count > 2) {
    exchange(0b00111100, partner_2());
    exchange(0b01011010, partner_1());
    if (count > 4) {
      exchange(0b11110000, partner_4());
      exchange(0b11001100, partner_2());
      exchange(0b10101010, partner_1());
    }
  }
  _mm512_storeu_si512(out, e);
  return count;
}

#endif

} // namespace candela::simd
