#pragma once
// Flat discs, hit from both sides.

#include "accel/primitives/pack.h"

namespace candela {

/// World space; the normal is of unit length.
struct DiscGeometry {
  vec3 center{0};
  float radius = 1;
  vec3 normal{0, 0, 1};
};

struct alignas(32) DiscPack {
  std::array<std::array<float, kWidth>, 3> center, normal;
  std::array<float, kWidth> radius;
  std::array<std::uint32_t, kWidth> primitive;

  static DiscPack unused() { return {{kNowhere, kNowhere, kNowhere}, {}, {}, {}}; }
  bool operator==(const DiscPack&) const = default;
};

namespace primitives {

struct Discs {
  struct Input {
    std::span<const DiscGeometry> discs = {};
  };
  using Pack = DiscPack;
  static constexpr std::uint32_t kLeafCapacity = kWidth;
  static constexpr float kLeafCost = 1;

  static std::size_t count(const Input& input) { return input.discs.size(); }

  static Bounds3 bounds(const Input& input, std::size_t i) {
    const DiscGeometry& d = input.discs[i];
    if (!accel_detail::usable(d.center) || !accel_detail::usable_radius(d.radius)) return {};
    if (!is_finite(d.normal) || d.normal == vec3(0)) return {};
    // The extent along an axis is that of a circle: r sqrt(1 - n_i^2), here free of cancellation.
    vec3 n2 = d.normal * d.normal;
    vec3 tangent = glm::sqrt(vec3(n2.y + n2.z, n2.z + n2.x, n2.x + n2.y));
    return accel_detail::padded(d.center, d.radius * tangent);
  }

  static void fill(Pack& pack, const Input& input, std::span<const std::uint32_t> primitives) {
    accel_detail::fill_lanes(pack, primitives, [&](std::size_t lane, std::uint32_t i) {
      accel_detail::set_axes(pack.center, lane, input.discs[i].center);
      accel_detail::set_axes(pack.normal, lane, input.discs[i].normal);
      pack.radius[lane] = input.discs[i].radius;
    });
  }

  template <class F>
  static void intersect(const Pack& pack, const Ray& ray, float t_min, float t_max,
                        accel_detail::LaneHits& hits) {
    using accel_detail::dot3;
    std::array<F, 3> d, f, n;
    for (std::size_t i = 0; i < 3; ++i) {
      int axis = static_cast<int>(i);
      d[i] = F(ray.direction[axis]);
      f[i] = F::load(pack.center[i].data()) - F(ray.origin[axis]);
      n[i] = F::load(pack.normal[i].data());
    }
    // Parallel to the plane: NaN or infinite, which the range test rejects.
    F t = dot3(f, n) / dot3(d, n), radius = F::load(pack.radius.data());
    std::array<F, 3> p{t * d[0] - f[0], t * d[1] - f[1], t * d[2] - f[2]};
    hits.lanes = less_equal(dot3(p, p), radius * radius) & less(F(t_min), t) & less(t, F(t_max));
    t.store(hits.t.data());
  }

  static vec2 parameters(const Pack&, std::size_t, const Ray&, const accel_detail::LaneHits&) {
    return vec2(0);
  }
};

} // namespace primitives

} // namespace candela
