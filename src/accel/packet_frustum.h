#pragma once
// A packet of rays as one, and what it may hit.

#include "accel/intersect.h"

#include <algorithm>
#include <optional>
#include <span>

namespace candela::accel_detail {

/// More rays share less of their way, fewer share its cost among fewer: from 64 to 256 hardly any difference.
inline constexpr std::size_t kPacketSize = 64;

/// Up to kPacketSize rays side by side, as ShearedRay has them; z is the axis along which the first one
/// advances most. Places up to the next multiple of eight repeat the last ray.
template <class F>
struct alignas(64) PacketRays {
  using Floats = std::array<float, kPacketSize>; // a multiple of the alignment
  std::array<Floats, 3> origin, direction;
  Floats shear_x, shear_y, scale_z;
  Floats t_min, t_max;
  std::array<std::size_t, 3> axis; ///< of the world: which are x, y and z here
  std::size_t groups = 0;          ///< of eight rays

  /// Whether all advance most along z.
  bool load(std::span<const Ray* const> rays) {
    const std::size_t z = largest_axis(rays[0]->direction);
    axis = {(z + 1) % 3, (z + 2) % 3, z};
    groups = (rays.size() + kWidth - 1) / kWidth;
    bool alike = true;
    for (std::size_t i = 0; i < groups * kWidth; ++i) {
      const Ray& ray = *rays[std::min(i, rays.size() - 1)];
      const float *o = glm::value_ptr(ray.origin), *d = glm::value_ptr(ray.direction);
      for (std::size_t a = 0; a < 3; ++a) origin[a][i] = o[axis[a]], direction[a][i] = d[axis[a]];
      t_min[i] = std::max(ray.t_min, 0.0f), t_max[i] = ray.t_max;
      alike &= largest_axis(ray.direction) == z;
    }
    for (std::size_t i = 0; i < groups * kWidth; i += kWidth) {
      const F scale = F(1.0f) / F::load(&direction[2][i]);
      scale.store(&scale_z[i]);
      (F::load(&direction[0][i]) * scale).store(&shear_x[i]);
      (F::load(&direction[1][i]) * scale).store(&shear_y[i]);
    }
    return alike;
  }

  /// Eight of them, one a lane.
  ShearedRay<F> group(std::size_t g) const {
    const std::size_t i = g * kWidth;
    return {axis[0],
            axis[1],
            axis[2],
            F::load(&origin[0][i]),
            F::load(&origin[1][i]),
            F::load(&origin[2][i]),
            F::load(&shear_x[i]),
            F::load(&shear_y[i]),
            F::load(&scale_z[i])};
  }
};

/// A child of a node, or (null) the root.
struct ChildPlace {
  const WideNode* node;
  std::uint32_t lane;
};

/// Eight rays of a packet and single boxes: bit by bit what BoxRay makes of each ray.
template <class F>
class BoxRays {
public:
  BoxRays(const PacketRays<F>& rays, std::size_t group, const AccelTree& tree) {
    const F zero(0.0f), one(1.0f);
    auto magnitude = [&](F x) { return max(x, zero - x); };
    std::array<F, 3> o, d;
    F reach = zero;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t axis = rays.axis[a];
      o[axis] = F::load(&rays.origin[a][group * kWidth]),
      d[axis] = F::load(&rays.direction[a][group * kWidth]);
      reach =
          max(reach, max(magnitude(F(tree.lower[axis]) - o[axis]), magnitude(F(tree.upper[axis]) - o[axis])));
    }
    const F pad = reach * F(0x1p-21f);
    for (std::size_t a = 0; a < 3; ++a) {
      inverse_[a] = one / d[a]; // of a negative zero, too, with its sign
      const F shift = simd::with_sign_of(pad + magnitude(o[a]) * F(0x1p-22f), inverse_[a]);
      origin_near_[a] = o[a] + shift, origin_far_[a] = o[a] - shift;
      inverse_near_[a] = inverse_[a] * F(1 - gamma_bound(5)),
      inverse_far_[a] = inverse_[a] * F(1 + gamma_bound(5));
    }
  }

  /// Those that hit the box in [t_min, t_max]. The root is hit by all.
  simd::LaneMask intersect(const ChildPlace& place, F t_min, F t_max) const {
    if (place.node == nullptr) return simd::kAllLanes;
    F enter = t_min, leave = t_max;
    for (std::size_t a = 3; a-- > 0;) {
      const F lower(place.node->box[a][0][place.lane]), upper(place.node->box[a][1][place.lane]), zero(0.0f);
      enter = max((select_less(inverse_[a], zero, upper, lower) - origin_near_[a]) * inverse_near_[a], enter);
      leave = min((select_less(inverse_[a], zero, lower, upper) - origin_far_[a]) * inverse_far_[a], leave);
    }
    return less_equal(enter, leave);
  }

private:
  std::array<F, 3> origin_near_, origin_far_, inverse_, inverse_near_, inverse_far_; ///< by axis of the world
};

/// What a packet of rays may pass through: all points that lie ahead of their origins along z, no farther
/// than their ends, between their least and greatest slopes in x and in y.
///
/// Padded for what the triangle test moves vertices by and for the rounding of origins, as BoxRay is, and for
/// its own rounding. That is, for slopes up to 2 in units of eps = 2^-24 of the distance to the farthest
/// corner of the tree: 8 for the triangle test, 1 for the side of the box, 2 each for the slope, the distance
/// along z and their product.
template <class F>
class PacketFrustum {
public:
  /// Nothing where rays do not advance along the axis, or hardly, or come from too far away to compute with.
  static std::optional<PacketFrustum> around(const PacketRays<F>& rays, const AccelTree& tree) {
    struct Extent {
      F least{kInfinity}, greatest{-kInfinity};
      void grow(F x) { least = min(x, least), greatest = max(x, greatest); }
    };
    PacketFrustum f;
    f.axis_ = rays.axis;
    f.down_ = rays.direction[2][0] < 0;
    std::array<Extent, 3> origin;
    std::array<Extent, 2> slope;
    Extent advance, range; // along z, per unit of t and at the end
    const F sign(f.down_ ? -1.0f : 1.0f), far_away(1e30f), steepest(2.0f);
    simd::LaneMask sane = simd::kAllLanes;
    for (std::size_t i = 0; i < rays.groups * kWidth; i += kWidth) {
      for (std::size_t a = 0; a < 3; ++a) {
        const F x = F::load(&rays.origin[a][i]);
        sane &= less(x, far_away) & less(F(0.0f) - x, far_away);
        origin[a].grow(x);
      }
      const std::array<F, 2> s{F::load(&rays.shear_x[i]) * sign, F::load(&rays.shear_y[i]) * sign};
      for (std::size_t a = 0; a < 2; ++a) {
        sane &= less_equal(s[a], steepest) & less_equal(F(0.0f) - s[a], steepest);
        slope[a].grow(s[a]);
      }
      const F speed = F::load(&rays.direction[2][i]) * sign;
      sane &= less(F(0.0f), speed) & less(speed, far_away);
      advance.grow(speed);
      range.grow(F::load(&rays.t_max[i]) * speed);
    }
    if (sane != simd::kAllLanes) return std::nullopt;
    float reach = 0, size = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const float lo = lowest(origin[a].least), hi = highest(origin[a].greatest);
      reach = std::max({reach, hi - glm::value_ptr(tree.bounds.lo)[f.axis_[a]],
                        glm::value_ptr(tree.bounds.hi)[f.axis_[a]] - lo});
      size = std::max({size, std::abs(lo), std::abs(hi)});
    }
    const float pad = reach * 0x1p-19f + size * 0x1p-21f;
    for (std::size_t a = 0; a < 3; ++a) {
      f.least_[a] = F(lowest(origin[a].least) - pad);
      f.greatest_[a] = F(highest(origin[a].greatest) + pad);
    }
    for (std::size_t a = 0; a < 2; ++a) {
      f.least_slope_[a] = F(lowest(slope[a].least));
      f.greatest_slope_[a] = F(highest(slope[a].greatest));
    }
    f.range_ = F(highest(range.greatest) + pad);
    f.t_per_z_ = F((1 - gamma_bound(8)) / highest(advance.greatest));
    return f;
  }

  /// The children that the packet may hit, and a lower bound of where it enters them.
  simd::LaneMask intersect(const WideNode& node, F& t_enter) const {
    const auto& side = node.box[axis_[2]];
    const F near = nearest(F::load(side[down_].data())), far = farthest(F::load(side[!down_].data()));
    const F z = max(near, F(0.0f));
    simd::LaneMask outside = less(far, F(0.0f)) | less(range_, near);
    for (std::size_t a = 0; a < 2; ++a) {
      const auto& across = node.box[axis_[a]];
      outside |= above(a, F::load(across[0].data()), z, far) | below(a, F::load(across[1].data()), z, far);
    }
    t_enter = z * t_per_z_;
    return ~outside & simd::kAllLanes;
  }

  /// The triangles that the packet may hit: none of the frustum's planes has all vertices outside.
  simd::LaneMask intersect(const TrianglePack& pack) const {
    simd::LaneMask left = simd::kAllLanes, right = left, under = left, over = left, behind = left,
                   beyond = left, unused = 0;
    for (const auto& vertex : pack.vertex) {
      const F z = F::load(vertex[axis_[2]].data()), near = nearest(z), far = farthest(z);
      const F x = F::load(vertex[axis_[0]].data()), y = F::load(vertex[axis_[1]].data());
      right &= above(0, x, near, far), left &= below(0, x, near, far);
      over &= above(1, y, near, far), under &= below(1, y, near, far);
      behind &= less(far, F(0.0f)), beyond &= less(range_, near);
      unused |= equal(z, F(kInfinity));
    }
    return ~(left | right | under | over | behind | beyond | unused) & simd::kAllLanes;
  }

private:
  PacketFrustum() = default;

  static float lowest(F x) {
    alignas(32) std::array<float, kWidth> lanes;
    x.store(lanes.data());
    return *std::min_element(lanes.begin(), lanes.end());
  }
  static float highest(F x) {
    alignas(32) std::array<float, kWidth> lanes;
    x.store(lanes.data());
    return *std::max_element(lanes.begin(), lanes.end());
  }

  /// How far a coordinate z lies ahead of the rays' origins, at least and at most.
  F nearest(F z) const { return down_ ? least_[2] - z : z - greatest_[2]; }
  F farthest(F z) const { return down_ ? greatest_[2] - z : z - least_[2]; }
  /// Whether a coordinate x (axis 0) or y (1) is greater than any that rays reach between near and far.
  simd::LaneMask above(std::size_t a, F x, F near, F far) const {
    return less(max(greatest_slope_[a] * near, greatest_slope_[a] * far), x - greatest_[a]);
  }
  simd::LaneMask below(std::size_t a, F x, F near, F far) const {
    return less(x - least_[a], min(least_slope_[a] * near, least_slope_[a] * far));
  }

  std::array<std::size_t, 3> axis_{}; ///< as of PacketRays
  bool down_ = false;                 ///< towards lower z
  std::array<F, 3> least_, greatest_; ///< origins
  std::array<F, 2> least_slope_, greatest_slope_;
  F range_, t_per_z_;
};

} // namespace candela::accel_detail
