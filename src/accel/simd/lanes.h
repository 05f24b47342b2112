#pragma once
// Lanes and vectors of four, without intrinsics: what headers need that only name packs or write kernels as
// templates.

#include <bit>
#include <cstdint>
#include <limits>

namespace candela::simd {

inline constexpr int kLanes = 8;
inline constexpr std::uint32_t kAllLanes = 0xff;
using LaneMask = std::uint32_t;

/// Calls f(lane) for every set lane, from the lowest.
template <class Function>
inline void for_each_lane(LaneMask lanes, Function&& f) {
  for (; lanes; lanes &= lanes - 1) f(std::countr_zero(lanes));
}

/// Four floats, mostly for x, y, z and a lane that nobody reads.
using Vec4 = float __attribute__((vector_size(16)));
using IntVec4 = std::int32_t __attribute__((vector_size(16)));

/// b if either is NaN.
inline Vec4 min4(Vec4 a, Vec4 b) { return a < b ? a : b; }
inline Vec4 max4(Vec4 a, Vec4 b) { return a > b ? a : b; }
inline Vec4 abs4(Vec4 a) { return reinterpret_cast<Vec4>(reinterpret_cast<IntVec4>(a) & 0x7fffffff); }
/// For magnitudes that are not negative.
inline Vec4 copysign4(Vec4 magnitude, Vec4 sign) {
  return reinterpret_cast<Vec4>(reinterpret_cast<IntVec4>(magnitude) |
                                (reinterpret_cast<IntVec4>(sign) & std::numeric_limits<std::int32_t>::min()));
}

} // namespace candela::simd
