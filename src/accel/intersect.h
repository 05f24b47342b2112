#pragma once
// From the lanes of a pack that a ray hits to the closest hit so far.

#include "accel/layout.h"

#include <tuple>

namespace candela::accel_detail {

/// The lane of least t among some; of those that share it, one with the lowest primitive.
inline std::size_t closest_lane(simd::LaneMask lanes, const std::array<float, kWidth>& t,
                                const std::array<std::uint32_t, kWidth>& primitive) {
  auto best = static_cast<std::size_t>(std::countr_zero(lanes));
  simd::for_each_lane(lanes & (lanes - 1), [&](int lane) {
    auto i = static_cast<std::size_t>(lane);
    if (t[i] < t[best] || (t[i] == t[best] && primitive[i] < primitive[best])) best = i;
  });
  return best;
}

/// Of hits at the same t one has to be chosen, and in a way that does not depend on the order in which a ray
/// comes to them, so that the image is independent of batching. This is asked where a hit is as far as the
/// closest one so far, `found`, whose t is NaN where there is none.
inline bool precedes(const Hit& hit, const Hit& found) {
  return std::tie(hit.instance, hit.kind, hit.primitive) <
         std::tie(found.instance, found.kind, found.primitive);
}

/// Whether a triangle is hit with t in (t_min, t_max). For the closest hit, sets hit and lowers t_max to its
/// t; at the t of the hit so far, if the triangle precedes.
template <class F, bool any_hit>
[[gnu::always_inline]] inline bool intersect_triangles(const TrianglePack& pack, const ShearedRay<F>& ray,
                                                       float t_min, float& t_max, Hit& hit) {
  const TriangleHits<F> found(pack, ray);
  if (!found.lanes) return false;
  simd::LaneMask closer = found.lanes & less(F(t_min), found.t) & less(found.t, F(t_max));
  if constexpr (any_hit) return closer;
  if (!closer) {
    closer = found.lanes & equal(found.t, F(hit.t));
    if (!closer) [[likely]]
      return false;
  }

  auto i = static_cast<std::size_t>(std::countr_zero(closer));
  float closest = first_lane(found.t, closer);
  if (closer & (closer - 1)) [[unlikely]] {
    alignas(32) std::array<float, kWidth> ts;
    found.t.store(ts.data());
    i = closest_lane(closer, ts, pack.primitive);
    closest = ts[i];
  }
  if (closest == hit.t) [[unlikely]] {
    if (!precedes({closest, 0, 0, pack.primitive[i], kNoInstance, PrimitiveKind::triangle}, hit))
      return false;
  }
  t_max = closest;
  alignas(32) std::array<float, kWidth> vs, ws, determinants;
  found.edge.v.store(vs.data()), found.edge.w.store(ws.data());
  found.determinant.store(determinants.data());
  float inverse = 1 / determinants[i];
  hit = {closest, vs[i] * inverse, ws[i] * inverse, pack.primitive[i], kNoInstance, PrimitiveKind::triangle};
  return true;
}

} // namespace candela::accel_detail
