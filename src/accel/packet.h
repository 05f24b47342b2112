#pragma once
// Neighbouring rays, as a camera sends them or as surfaces that it sees send them to a light, share the upper
// part of their way through the tree: it is found once for all of them, with a frustum around them (the entry
// point search of Reshetov, Soupikov and Hurley 2005, "Multi-Level Ray Tracing Algorithm", ACM TOG 24(3);
// here with up to kMaxEntryPoints of them). From there each goes on alone, so that rays that part company
// lose nothing.
//
// Nanoseconds of a ray alone and in a packet, 512 x 512 pixels, at 1 and at 16 samples a pixel:
//
//                               camera rays             their shadow rays
//   Cornell box                 32  19    34  20        26  22     28  23
//   bunny, 69,000 triangles     72  53    56  22        86  79     75  54
//   Sponza, 66,000             114  60   108  33        76  73     66  42
//   sphere, 1.3 million        138 125    64  33       173 178    130  96
//
// The whole render of the Cornell box takes 2 % less time by the camera rays, 1.5 % by the shadow rays.

#include "accel/traversal.h"

#include <algorithm>
#include <optional>
#include <span>

namespace candela::accel_detail {

/// More rays share less of their way, fewer share its cost among fewer: from 64 to 256 hardly any difference.
inline constexpr std::size_t kPacketSize = 64;
/// At 8, rays in Sponza take 1.2 to 1.6 times as long; at 24, what is 5 % faster in Sponza is 5 % slower on
/// the sphere.
inline constexpr std::size_t kMaxEntryPoints = 16;

/// What a packet of rays may pass through: with z the axis along which they advance, all points that lie
/// ahead of their origins, no farther than their ends, between their least and greatest slopes in x and in y.
///
/// Padded for what the triangle test moves vertices by and for the rounding of origins, as BoxRay is, and for
/// its own rounding. That is, for slopes up to 2 in units of eps = 2^-24 of the distance to the farthest
/// corner of the tree: 8 for the triangle test, 1 for the box's side, 2 each for the slope, for the distance
/// along z and for their product.
template <class F>
class PacketFrustum {
public:
  /// Nothing where rays do not share their largest direction component, or nearly, or come from too far away
  /// to compute with.
  static std::optional<PacketFrustum> around(std::span<const Ray* const> rays, const AccelTree& tree) {
    PacketFrustum f;
    const float* d = glm::value_ptr(rays[0]->direction);
    std::size_t& z = f.axis_[2];
    for (std::size_t a = 0; a < 3; ++a)
      if (std::abs(d[a]) > std::abs(d[z])) z = a;
    f.axis_[0] = (z + 1) % 3, f.axis_[1] = (z + 2) % 3;
    f.down_ = d[z] < 0;
    vec2 least_slope(kInfinity), greatest_slope(-kInfinity);
    vec3 least_origin(kInfinity), greatest_origin(-kInfinity);
    float speed = 0; // of the fastest along z, per unit of t
    float range = 0; // of the farthest, along z
    for (const Ray* ray : rays) {
      d = glm::value_ptr(ray->direction);
      const float advance = std::abs(d[z]);
      const vec2 slope = vec2(d[f.axis_[0]], d[f.axis_[1]]) / advance;
      if ((d[z] < 0) != f.down_ || !(std::abs(slope.x) <= 2 && std::abs(slope.y) <= 2)) return std::nullopt;
      least_slope = glm::min(least_slope, slope), greatest_slope = glm::max(greatest_slope, slope);
      least_origin = glm::min(least_origin, ray->origin);
      greatest_origin = glm::max(greatest_origin, ray->origin);
      speed = std::max(speed, advance);
      range = std::max(range, ray->t_max * advance);
    }
    const vec3 reach = glm::max(greatest_origin - tree.bounds.lo, tree.bounds.hi - least_origin);
    const vec3 size = glm::max(glm::abs(least_origin), glm::abs(greatest_origin));
    const float farthest = std::max({reach.x, reach.y, reach.z});
    if (!(farthest < 1e30f)) return std::nullopt;
    const float pad = farthest * 0x1p-19f + std::max({size.x, size.y, size.z}) * 0x1p-21f;
    for (std::size_t i = 0; i < 3; ++i) {
      f.least_[i] = F(glm::value_ptr(least_origin)[f.axis_[i]] - pad);
      f.greatest_[i] = F(glm::value_ptr(greatest_origin)[f.axis_[i]] + pad);
    }
    f.least_slope_ = {F(least_slope.x), F(least_slope.y)};
    f.greatest_slope_ = {F(greatest_slope.x), F(greatest_slope.y)};
    f.range_ = F(range + pad);
    f.t_per_z_ = F((1 - gamma_bound(8)) / speed);
    return f;
  }

  /// The children that the packet may meet, and a lower bound of where it enters them.
  simd::LaneMask intersect(const WideNode& node, F& t_enter) const {
    const F zero(0.0f);
    const auto& side = node.box[axis_[2]];
    const F near = ahead(side, down_, down_ ? least_[2] : greatest_[2]);
    const F far = ahead(side, !down_, down_ ? greatest_[2] : least_[2]);
    simd::LaneMask outside = less(far, zero) | less(range_, near);
    const F z = max(near, zero);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& across = node.box[axis_[i]];
      const F lower = F::load(across[0].data()) - greatest_[i], upper = F::load(across[1].data()) - least_[i];
      outside |= less(max(greatest_slope_[i] * z, greatest_slope_[i] * far), lower);
      outside |= less(upper, min(least_slope_[i] * z, least_slope_[i] * far));
    }
    t_enter = z * t_per_z_;
    return ~outside & simd::kAllLanes;
  }

private:
  PacketFrustum() = default;

  /// How far a side of the boxes lies ahead of an origin.
  F ahead(const std::array<std::array<float, kWidth>, 2>& sides, bool upper, F origin) const {
    const F side = F::load(sides[upper].data());
    return down_ ? origin - side : side - origin;
  }

  std::array<std::size_t, 3> axis_{}; ///< which axes x, y and z are
  bool down_ = false;                 ///< towards lower z
  std::array<F, 3> least_, greatest_; ///< origins
  std::array<F, 2> least_slope_, greatest_slope_;
  F range_, t_per_z_;
};

/// Subtrees and leaves that hold all that the rays of a packet can meet, the one to enter first last.
struct EntryPoints {
  std::array<Waiting, kMaxEntryPoints> at;
  std::size_t count = 0;
  bool only_leaves = true;

  std::span<const Waiting> span() const { return {at.data(), count}; }
};

template <class F>
EntryPoints find_entry_points(const AccelTree& tree, std::span<const Ray* const> rays) {
  EntryPoints points;
  points.at[points.count++] = {tree.root, 0};
  const auto frustum = PacketFrustum<F>::around(rays, tree);
  if (!frustum) {
    points.only_leaves = tree.root.is_leaf();
    return points;
  }
  for (std::size_t i = 0; i < points.count;) {
    const ChildRef ref = points.at[i].value;
    if (ref.is_leaf()) {
      ++i;
      continue;
    }
    const WideNode& node = tree.nodes[ref.index()];
    F t_enter;
    const simd::LaneMask met = frustum->intersect(node, t_enter);
    if (points.count - 1 + static_cast<std::size_t>(std::popcount(met)) > kMaxEntryPoints) {
      points.only_leaves = false;
      ++i;
      continue;
    }
    points.at[i] = points.at[--points.count]; // its children instead
    alignas(32) std::array<float, kWidth> key;
    t_enter.store(key.data());
    simd::for_each_lane(met, [&](int lane) {
      const auto k = static_cast<std::size_t>(lane);
      points.at[points.count++] = {node.child[k], key[k]};
    });
  }
  std::sort(points.at.begin(), points.at.begin() + static_cast<std::ptrdiff_t>(points.count),
            [](const Waiting& a, const Waiting& b) { return a.key > b.key; });
  return points;
}

/// As trace, for a ray of the packet.
template <class F, bool any_hit>
bool trace_from(const AccelTree& tree, const EntryPoints& points, const Ray& ray, Hit& hit) {
  NoCost free_of_charge;
  if (points.only_leaves)
    return trace_subtrees<F, any_hit, true>(tree, points.span(), ray, hit, free_of_charge);
  return trace_subtrees<F, any_hit, false>(tree, points.span(), ray, hit, free_of_charge);
}

} // namespace candela::accel_detail
