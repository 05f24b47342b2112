#pragma once
// Full spheres, hit from outside and from inside.

#include "accel/primitives/pack.h"

namespace candela {

/// World space.
struct SphereGeometry {
  vec3 center{0};
  float radius = 1;
};

struct alignas(32) SpherePack {
  std::array<std::array<float, kWidth>, 3> center;
  std::array<float, kWidth> radius;
  std::array<std::uint32_t, kWidth> primitive;

  static SpherePack unused() { return {{kNowhere, kNowhere, kNowhere}, {}, {}}; }
  bool operator==(const SpherePack&) const = default;
};

namespace primitives {

struct Spheres {
  struct Input {
    std::span<const SphereGeometry> spheres = {};
  };
  using Pack = SpherePack;
  static constexpr std::uint32_t kLeafCapacity = kWidth;
  static constexpr float kLeafCost = 1;

  static std::size_t count(const Input& input) { return input.spheres.size(); }

  static Bounds3 bounds(const Input& input, std::size_t i) {
    const SphereGeometry& s = input.spheres[i];
    if (!accel_detail::usable(s.center) || !accel_detail::usable_radius(s.radius)) return {};
    return accel_detail::padded(s.center, vec3(s.radius));
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    accel_detail::fill_lanes(pack, primitives, [&](std::size_t lane, std::uint32_t i) {
      accel_detail::set_axes(pack.center, lane, input.spheres[i].center);
      pack.radius[lane] = input.spheres[i].radius;
    });
  }

  /// Both roots without cancellation, also for small and far spheres (Haines et al. 2019, "Precision
  /// Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7): the discriminant from the
  /// distance between centre and line, the smaller root from the product of the roots.
  template <class F>
  static void intersect(const Pack& pack, const Ray& ray, float t_min, float t_max,
                        accel_detail::LaneHits& hits) {
    using accel_detail::dot3;
    std::array<F, 3> d, f;
    for (std::size_t i = 0; i < 3; ++i) {
      int axis = static_cast<int>(i);
      d[i] = F(ray.direction[axis]);
      f[i] = F::load(pack.center[i].data()) - F(ray.origin[axis]);
    }
    F a = dot3(d, d), b = dot3(f, d), radius = F::load(pack.radius.data()), along = b / a;
    std::array<F, 3> perpendicular{f[0] - along * d[0], f[1] - along * d[1], f[2] - along * d[2]};
    F discriminant = radius * radius - dot3(perpendicular, perpendicular);
    hits.lanes = less_equal(F(0.0f), discriminant);
    if (!hits.lanes) return;
    F distance2 = dot3(f, f), radius2 = radius * radius;
    F q = b + with_sign_of(sqrt(a * max(discriminant, F(0.0f))), b);
    F t0 = (distance2 - radius2) / q, t1 = q / a;
    F first = min(t0, t1), second = max(t0, t1);
    // From inside, or with the first hit before t_min, the second one counts.
    F t = select_less(F(t_min), first, first, second);
    hits.lanes &= less(F(t_min), t) & less(t, F(t_max));
    t.store(hits.t.data());
  }

  static vec2 parameters(const Pack&, std::size_t, const Ray&, const accel_detail::LaneHits&) {
    return vec2(0);
  }
};

} // namespace primitives

} // namespace candela
