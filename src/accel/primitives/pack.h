#pragma once
// What the kinds of primitives share: the shape of a pack, and the checks and paddings of their bounds. A
// pack holds up to eight primitives, each field as eight floats side by side, so that one SIMD instruction
// treats all of them.

#include "accel/simd/lanes.h"
#include "core/bounds.h"
#include "core/ray.h"

#include <array>
#include <span>

namespace candela {

inline constexpr int kWidth = simd::kLanes;

/// Coordinates of eight primitives that no ray hits: products and differences of them are NaN. So lanes in
/// use need no mask, and no primitive is in several lanes of a pack.
inline constexpr std::array<float, kWidth> kNowhere{kInfinity, kInfinity, kInfinity, kInfinity,
                                                    kInfinity, kInfinity, kInfinity, kInfinity};

namespace accel_detail {

/// What an intersection kernel finds: the lanes hit, and their t in memory, because single lanes are read
/// next; and where its kind finds it anyway, Hit::u.
struct LaneHits {
  simd::LaneMask lanes = 0;
  alignas(32) std::array<float, kWidth> t, u;
};

inline bool usable(vec3 p) {
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
         std::abs(p.z) <= kMaxCoordinate;
}
inline bool usable_radius(float radius) { return radius > 0 && radius <= kMaxCoordinate; }

/// Grown by what rounding may have cut off.
inline Bounds3 padded(vec3 center, vec3 extent) {
  vec3 pad = (glm::abs(center) + extent) * 0x1p-22f;
  return {center - extent - pad, center + extent + pad};
}

template <class F>
F dot3(const std::array<F, 3>& a, const std::array<F, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline void set_axes(std::array<std::array<float, kWidth>, 3>& field, std::size_t lane, vec3 value) {
  for (int a = 0; a < 3; ++a) field[static_cast<std::size_t>(a)][lane] = value[a];
}

/// Fills the first lanes of a pack: set(lane, primitive) for each; the rest stays unused.
template <class Pack, class SetLane>
void fill_lanes(Pack& pack, std::span<const std::uint32_t> primitives, SetLane set) {
  pack = Pack::unused();
  for (std::size_t lane = 0; lane < primitives.size(); ++lane) {
    pack.primitive[lane] = primitives[lane];
    set(lane, primitives[lane]);
  }
}

} // namespace accel_detail

} // namespace candela
