#pragma once
// Tracing a ray through the wide tree. A template over the SIMD implementation: the library instantiates it
// for the best one, the tests also for the portable one.

#include "accel/intersect.h"
#include "accel/layout.h"

namespace candela::accel_detail {

/// A ray prepared for box tests that never miss what the triangle test would hit.
///
/// The triangle test moves vertices, relative to the ray, by up to 6 eps times the distance from the origin
/// to the farthest vertex along any axis (eps = 2^-24: subtraction 1, shear 3, sum 2); hence boxes grow by 8
/// eps of it. The padding rides on the origin, whose own rounding the second term covers. Slab distances have
/// three roundings each, which the factors on the inverse direction cover (pbrt-v4, section 6.8.2; Ize 2013,
/// "Robust BVH Ray Traversal", JCGT 2(2)). So all of this costs nothing per node.
template <class F>
struct BoxRay {
  std::array<F, 3> origin_near, origin_far, inverse_near, inverse_far;
  std::array<std::size_t, 3>
      near_side; ///< index into WideNode::box[axis]: 1 where the ray points down the axis

  BoxRay(const Ray& ray, const Bounds3& bounds) {
    vec3 reach = glm::max(glm::abs(bounds.lo - ray.origin), glm::abs(bounds.hi - ray.origin));
    float pad = max_component(reach) * 0x1p-21f;
    for (std::size_t i = 0; i < 3; ++i) {
      int axis = static_cast<int>(i);
      float o = ray.origin[axis], inverse = 1 / ray.direction[axis];
      bool down = std::signbit(ray.direction[axis]);
      float shift = std::copysign(pad + std::abs(o) * 0x1p-22f, inverse);
      near_side[i] = down;
      origin_near[i] = F(o + shift), origin_far[i] = F(o - shift);
      inverse_near[i] = F(inverse * (1 - gamma_bound(5))), inverse_far[i] = F(inverse * (1 + gamma_bound(5)));
    }
  }

  /// The children whose boxes the ray meets in [t_min, t_max], and where it enters them. With a direction
  /// component of 0 a distance may be 0 * inf = NaN, on the very plane; min and max then take their second
  /// operand, which counts the slab as met.
  simd::LaneMask intersect(const WideNode& node, F t_min, F t_max, F& t_enter) const {
    F enter = t_min, leave = t_max;
    for (std::size_t i = 3; i-- > 0;) {
      F near_plane = F::load(node.box[i][near_side[i]].data());
      F far_plane = F::load(node.box[i][near_side[i] ^ 1].data());
      enter = max((near_plane - origin_near[i]) * inverse_near[i], enter);
      leave = min((far_plane - origin_far[i]) * inverse_far[i], leave);
    }
    t_enter = enter;
    return less_equal(enter, leave);
  }
};

template <class F, bool any_hit>
class Tracer {
public:
  /// Meets what lies in (ray.t_min, ray.t_max). For the closest hit, hit.t and the rest are set.
  static bool trace(const AccelTree& tree, const Ray& ray, Hit& hit) { return Tracer(tree, ray, hit).run(); }

private:
  struct Entry {
    ChildRef ref;
    float t_enter;
  };

  Tracer(const AccelTree& tree, const Ray& ray, Hit& hit)
      : tree_(tree), ray_(ray), hit_(hit), sheared_(ray), t_max_(ray.t_max) {}

  bool run() {
    if (tree_.root.is_leaf()) return meet_leaf(tree_.root);
    // NaN would meet every box and walk the whole tree.
    vec3 sum = ray_.origin + ray_.direction;
    if (!std::isfinite(sum.x + sum.y + sum.z)) return false;
    const BoxRay<F> box_ray(ray_, tree_.bounds);
    const F t_min(ray_.t_min);
    bool found = false;
    std::array<Entry, kStackSize> stack;
    Entry* top = stack.data();
    ChildRef current = tree_.root;
    for (;;) {
      if (current.is_leaf()) {
        if (meet_leaf(current)) {
          if constexpr (any_hit) return true;
          found = true;
        }
      } else {
        const WideNode& node = tree_.nodes[current.index()];
        F t_enter;
        simd::LaneMask lanes = box_ray.intersect(node, t_min, F(t_max_), t_enter);
        if (lanes) {
          alignas(32) std::array<float, kWidth> t;
          t_enter.store(t.data());
          current = push_but_nearest(node, t, lanes, top);
          continue;
        }
      }
      do {
        if (top == stack.data()) return found;
        --top;
      } while (top->t_enter > t_max_);
      current = top->ref;
    }
  }

  static ChildRef push_but_nearest(const WideNode& node, const std::array<float, kWidth>& t,
                                   simd::LaneMask lanes, Entry*& top) {
    auto entry = [&](int lane) {
      auto i = static_cast<std::size_t>(lane);
      return Entry{node.child[i], t[i]};
    };
    Entry nearest = entry(std::countr_zero(lanes));
    Entry* base = top;
    simd::for_each_lane(lanes & (lanes - 1), [&](int lane) {
      Entry e = entry(lane);
      if (e.t_enter < nearest.t_enter) std::swap(e, nearest);
      // Insertion keeps the waiting ones sorted, the farthest lowest.
      Entry* at = top++;
      for (; at != base && (at - 1)->t_enter < e.t_enter; --at) *at = *(at - 1);
      *at = e;
    });
    return nearest.ref;
  }

  bool meet_leaf(ChildRef leaf) {
    switch (leaf.kind()) {
    case LeafKind::triangles: return meet_triangles(tree_.triangles[leaf.index()]);
    case LeafKind::spheres: {
      LaneHits lanes;
      const SpherePack& pack = tree_.spheres[leaf.index()];
      intersect_spheres<F>(pack, ray_, ray_.t_min, t_max_, lanes);
      return accept(pack.primitive, PrimitiveKind::sphere, lanes);
    }
    case LeafKind::discs: {
      LaneHits lanes;
      const DiscPack& pack = tree_.discs[leaf.index()];
      intersect_discs<F>(pack, ray_, ray_.t_min, t_max_, lanes);
      return accept(pack.primitive, PrimitiveKind::disc, lanes);
    }
    case LeafKind::instance: return meet_instance(tree_.instances[leaf.index()]);
    }
    return false;
  }

  bool meet_triangles(const TrianglePack& pack) {
    TriangleHits lanes;
    intersect_triangles(pack, sheared_, ray_.t_min, t_max_, lanes);
    if (!lanes.lanes) return false;
    if constexpr (any_hit) return true;
    auto lane = static_cast<std::size_t>(closest_lane(lanes));
    t_max_ = lanes.t[lane];
    float inverse = 1 / lanes.determinant[lane];
    hit_ = {t_max_,      lanes.edge_v[lane] * inverse, lanes.edge_w[lane] * inverse, pack.primitive[lane],
            kNoInstance, PrimitiveKind::triangle};
    return true;
  }

  bool accept(const std::array<std::uint32_t, kWidth>& primitive, PrimitiveKind kind, const LaneHits& lanes) {
    if (!lanes.lanes) return false;
    if constexpr (any_hit) return true;
    auto lane = static_cast<std::size_t>(closest_lane(lanes));
    t_max_ = lanes.t[lane];
    hit_ = {t_max_, 0, 0, primitive[lane], kNoInstance, kind};
    return true;
  }

  /// In the object's space t stays the same, for the direction is not renormalised.
  bool meet_instance(const InstanceRecord& instance) {
    const auto& m = instance.object_from_world;
    Ray local{m * vec4(ray_.origin, 1), ray_.t_min, m * vec4(ray_.direction, 0), t_max_};
    if (!trace(*instance.object, local, hit_)) return false;
    if constexpr (any_hit) return true;
    t_max_ = hit_.t;
    hit_.instance = instance.index;
    return true;
  }

  const AccelTree& tree_;
  const Ray& ray_;
  Hit& hit_;
  ShearedRay<F> sheared_;
  float t_max_;
};

} // namespace candela::accel_detail
